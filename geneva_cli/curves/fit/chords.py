"""A curve as straight chords, in as few as there can be: each as long as the tolerance allows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.curves.fit.balance import balanced
from geneva_cli.curves.fit.path import Path, inside, peaks, points_of
from geneva_cli.curves.shapes import Line

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

SAMPLES = 8  # in a chord, while searching: a parabola's top is found from any three
DENSE = 32  # in a chord, for the verdict: a lobe of half of it is seen to 0.5 %
ORDER = 2.0


def fitted_chords(path: Path) -> list[Line]:
    """Chords along a path, their ends on it."""

    def errors(places: Array) -> Array:
        return peaks(_misses(path, places, SAMPLES))

    def proof(places: Array) -> list[Line] | None:
        if not peaks(_misses(path, places, DENSE)).max() <= path.tolerance:
            return None
        points = points_of(path.at(places)[0])
        return [Line(*ends) for ends in zip(points, points[1:], strict=False)]

    # A chord of length h on a curve of curvature k misses it by k h² / 8.
    return balanced(path, errors, proof, ORDER, np.sqrt(np.abs(path.turn) * path.step))


def _misses(path: Path, places: Array, samples: int) -> Array:
    """How far samples of the curve lie from the chords between their ends, mm."""
    z, _ = path.at(inside(places, samples))
    chord = z[:, -1:] - z[:, :1]
    seen = (z - z[:, :1]) * (chord.conj() / np.abs(chord))
    past = seen.real - np.clip(seen.real, 0.0, np.abs(chord))
    found: Array = np.hypot(past, seen.imag)
    return found
