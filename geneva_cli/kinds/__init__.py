"""Kinds of machines that only some users need, a folder each."""
