"""Subjects of the bench, one file each."""
