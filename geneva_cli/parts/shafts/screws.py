"""Screws with metric threads: the holes that they need, and the force that they hold with."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.spec.tables import Size


class Screw(NamedTuple):
    """A metric screw: thread, pitch, hole that it passes, and its head's diameter, mm."""

    thread: float
    pitch: float
    through: float
    head: float

    @property
    def core(self) -> float:
        """Diameter of the hole before its thread is cut: thread minus pitch (ISO 2306)."""
        return self.thread - self.pitch

    @property
    def stressed_mm2(self) -> float:
        """Area of the thread's stressed section (ISO 898-1), between pitch and core diameter."""
        return 0.25 * math.pi * (self.thread - 0.9382 * self.pitch) ** 2


# Sizes by ISO 262, coarse pitches by ISO 261, clearance holes by ISO 273 (medium), cylindrical
# heads by ISO 4762.
SCREWS = [
    Screw(*row)
    for row in (
        (1.6, 0.35, 1.8, 3.0),
        (2, 0.4, 2.4, 3.8),
        (2.5, 0.45, 2.9, 4.5),
        (3, 0.5, 3.4, 5.5),
        (4, 0.7, 4.5, 7.0),
        (5, 0.8, 5.5, 8.5),
        (6, 1.0, 6.6, 10.0),
        (8, 1.25, 9.0, 13.0),
        (10, 1.5, 11.0, 16.0),
        (12, 1.75, 13.5, 18.0),
        (16, 2.0, 17.5, 24.0),
        (20, 2.5, 22.0, 30.0),
        (24, 3.0, 26.0, 36.0),
        (30, 3.5, 33.0, 45.0),
        (36, 4.0, 39.0, 54.0),
        (42, 4.5, 45.0, 63.0),
        (48, 5.0, 52.0, 72.0),
        (56, 5.5, 62.0, 84.0),
        (64, 6.0, 70.0, 96.0),
    )
]


def screw(key: str, thread: float) -> Screw:
    """Return the screw with a thread's diameter, mm; raises GenevaError, naming the key.

    >>> screw("wheel_screw_mm", 4.0).core
    3.3
    """
    for row in SCREWS:
        if row.thread == thread:
            return row
    nearest = min(SCREWS, key=lambda row: abs(row.thread - thread)).thread
    raise GenevaError(
        f"{key} = {thread:g}: there is no such metric screw; use {nearest:g}", ("size", key)
    )


def change_for_hub(size: Size, part: str) -> str:
    """Return the change of the spec that gives a part, "wheel" or "crank", a hub with a bore.

    >>> change_for_hub(Size(crank_hub_mm=20.0), "crank")
    'set crank_bore_mm'
    >>> change_for_hub(Size(crank_hub_mm=20.0, crank_bore_mm=10.0), "crank")
    'set a greater crank_hub_length_mm'
    """
    values = vars(size)
    hub, bore, length = (f"{part}_{name}_mm" for name in ("hub", "bore", "hub_length"))
    missing = [hub] if values[hub] is None and values[length] is None else []
    missing += [] if values[bore] else [bore]
    if missing:
        return f"set {' and '.join(missing)}"
    if values[hub] is not None and values[hub] <= values[bore]:
        return f"set {hub} above {bore}"
    return f"set a greater {length}"  # the hub does not reach past what it stands on
