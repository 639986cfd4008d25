"""Standard parts on shafts: deep groove ball bearings, and circlips."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.spec.tables import Size


class Bearing(NamedTuple):
    """A deep groove ball bearing: bore, outside diameter and width, mm."""

    name: str
    bore: float
    outside: float
    width: float

    @property
    def shoulder(self) -> float:
        """Diameter of the shaft's shoulder: at least the abutment of DIN 5418 for this series."""
        return max(1.25 * self.bore, self.bore + 2.0)


# ISO 15:2017, dimension series 10, which makers call 60.
# fmt: off
SERIES_60 = [Bearing(*row) for row in (
    ("604", 4, 12, 4), ("605", 5, 14, 5), ("606", 6, 17, 6), ("607", 7, 19, 6), ("608", 8, 22, 7),
    ("609", 9, 24, 7), ("6000", 10, 26, 8), ("6001", 12, 28, 8), ("6002", 15, 32, 9),
    ("6003", 17, 35, 10), ("6004", 20, 42, 12), ("6005", 25, 47, 12), ("6006", 30, 55, 13),
    ("6007", 35, 62, 14), ("6008", 40, 68, 15), ("6009", 45, 75, 16), ("6010", 50, 80, 16),
    ("6011", 55, 90, 18), ("6012", 60, 95, 18), ("6013", 65, 100, 18), ("6014", 70, 110, 20),
    ("6015", 75, 115, 20), ("6016", 80, 125, 22), ("6017", 85, 130, 22), ("6018", 90, 140, 24),
    ("6019", 95, 145, 24), ("6020", 100, 150, 24),
)]
# fmt: on


class Circlip(NamedTuple):
    """A circlip for a shaft, and its groove, mm."""

    shaft: float  # d1, its nominal diameter
    groove: float  # d2, diameter of the groove
    width: float  # m, of the groove

    @property
    def edge(self) -> float:
        """Least distance n from the groove to the shaft's end: three times the groove's depth."""
        return 1.5 * (self.shaft - self.groove)


# DIN 471:1981, normal type.
# fmt: off
DIN_471 = [Circlip(*row) for row in (
    (3, 2.8, 0.5), (4, 3.8, 0.5), (5, 4.8, 0.7), (6, 5.7, 0.8), (7, 6.7, 0.9), (8, 7.6, 0.9),
    (9, 8.6, 1.1), (10, 9.6, 1.1), (11, 10.5, 1.1), (12, 11.5, 1.1), (13, 12.4, 1.1),
    (14, 13.4, 1.1), (15, 14.3, 1.1), (16, 15.2, 1.1), (17, 16.2, 1.1), (18, 17.0, 1.3),
    (19, 18.0, 1.3), (20, 19.0, 1.3), (22, 21.0, 1.3), (24, 22.9, 1.3), (25, 23.9, 1.3),
    (28, 26.6, 1.6), (30, 28.6, 1.6), (32, 30.3, 1.6), (35, 33.0, 1.6), (38, 36.0, 1.85),
    (40, 37.5, 1.85), (42, 39.5, 1.85), (45, 42.5, 1.85), (48, 45.5, 1.85), (50, 47.0, 2.15),
    (55, 52.0, 2.15), (60, 57.0, 2.15), (65, 62.0, 2.65), (70, 67.0, 2.65), (75, 72.0, 2.65),
    (80, 76.5, 2.65), (85, 81.5, 3.15), (90, 86.5, 3.15), (95, 91.5, 3.15), (100, 96.5, 3.15),
)]
# fmt: on


def bearing_up_to(diameter: float, shaft: str, key: str) -> Bearing:
    """Return the largest bearing whose bore is no wider than a shaft, mm.

    Raises GenevaError, naming the key of its bore, for a shaft below the smallest one.

    >>> bearing_up_to(16.0, "wheel's shaft", "wheel_bore_mm").name
    '6002'
    """
    bearing = bearing_within(diameter)
    if bearing is None:
        raise GenevaError(
            f'shafts = "turned": the {shaft} of {diameter:.4g} mm is too thin for a ball bearing; '
            f"set {key} to at least {SERIES_60[0].bore:g}",
            ("size", "shafts"),
        )
    return bearing


def bearing_within(diameter: float) -> Bearing | None:
    """Return the largest bearing whose bore is no wider than a diameter; None if all are wider."""
    return next((one for one in reversed(SERIES_60) if one.bore <= diameter), None)


def shoulder_length(size: Size, L: float) -> float:
    """Return the least length of a turned shaft's shoulder above its bearing; 0 for plain ones."""
    return L / 50.0 if size.shafts == "turned" else 0.0


def circlip_up_to(diameter: float) -> Circlip:
    """Return the largest circlip for a shaft up to a diameter of at least 3 mm.

    >>> circlip_up_to(9.6)
    Circlip(shaft=9, groove=8.6, width=1.1)
    """
    return [one for one in DIN_471 if one.shaft <= diameter][-1]
