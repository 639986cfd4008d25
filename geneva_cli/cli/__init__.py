"""The command line: the program and its commands."""
