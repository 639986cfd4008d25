"""Sampled paths of rollers, and pairs of their points that a wheel could join."""
