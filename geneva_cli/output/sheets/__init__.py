"""Drawing sheets as files: one module for each format, with lines and texts."""
