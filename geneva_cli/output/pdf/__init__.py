"""PDF files: their objects, pages of text, and drawings on them."""
