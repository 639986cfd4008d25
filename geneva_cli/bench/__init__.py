"""Proof: run time against error, and numerical stress. No part of a design's own computation.

Everything is a registry: a method, a subject or a machine enters by one line.
"""
