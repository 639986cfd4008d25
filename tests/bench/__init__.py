"""Benchmarks: run time against error, and numerical stress; not used by a design's computation.

Methods, subjects and machines are in registries, one line each.
"""
