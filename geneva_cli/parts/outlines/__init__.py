"""Outlines of wheel and crank."""
