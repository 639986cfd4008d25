"""Dimensioned drawing sheets of a machine's parts."""
