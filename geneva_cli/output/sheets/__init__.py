"""Drawing sheets as files: a format each, which knows lines and texts and no machine."""
