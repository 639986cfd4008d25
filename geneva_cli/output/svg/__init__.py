"""Drawings and scenes as SVG."""
