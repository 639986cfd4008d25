"""Answers that not every user needs, a folder each."""
