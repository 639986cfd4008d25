"""Summaries: what a designer tells a colleague about a design, in three to six lines."""
