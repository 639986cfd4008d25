"""Motion laws s(u), one class a law."""
