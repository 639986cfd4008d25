"""Tables, summaries and pages of the manual in a terminal's window."""
