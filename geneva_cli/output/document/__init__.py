"""Documents as pages: one module for each format, with headings, tables and figures."""
