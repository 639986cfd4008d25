"""Outlines of wheel and crank, and the certificate of their turn."""
