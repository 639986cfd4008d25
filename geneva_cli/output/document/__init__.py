"""A document as pages: a format each, which knows headings, tables and figures and no machine."""
