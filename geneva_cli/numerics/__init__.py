"""Numerics: jets, roots, extremes, quadrature, angles and tolerances."""
