"""Families of machines that may meet a requirement, each with one free number or none."""
