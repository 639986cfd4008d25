"""Summaries of designs in three to six lines."""
