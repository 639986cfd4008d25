"""Shafts and pivots, the crank's hub, and bores of parts on a shaft.

Shafts end in the frame's lower face, and above with the part that they carry. A wheel with
``wheel_hub_mm = 0`` has its shaft only above it, unless that carries a gear below.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, Point
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import assembly, links_at, same
from geneva_cli.parts.outlines.crank_outline import crank_bore, is_whole, keyway_direction
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.bores import Bore, ShaftBore, bore_of, has_shape, round_bore
from geneva_cli.spec.tables import Size


class Shaft(NamedTuple):
    """A shaft or pivot; heights are along its axis, and angles in radians."""

    name: str
    part: str  # whose keys of [size] set its ends
    bore: Bore  # of the parts on it
    low: float
    high: float
    at: Point
    direction: float = 0.0  # of the bore's keyway or flat
    turn: float = 0.0
    turns: bool = True  # in a bearing of the frame

    @property
    def member(self) -> Member:
        """The shaft in the machine."""
        if not self.low < self.high:
            key = f"{self.part}_shaft_low_mm"
            raise GenevaError(
                f"{key}: the {self.part}'s shaft would reach from {self.low:g} up to {self.high:g} "
                f"mm (0 is the wheel's lower face); reduce {key} or increase "
                f"{self.part}_shaft_high_mm",
                ("size", key),
            )
        section = self.bore.shape("SHAFT", self.direction, shaft=True)
        plate = Plate(self.name, "SHAFT", section, (), self.low, self.high)
        return Member(plate, self.at, self.turn)


def shaft_ends(size: Size, part: str, low: float, high: float) -> tuple[float, float]:
    """Return the ends of a part's shaft: those of the spec, or else the heights low and high."""
    values = vars(size)
    ends = values.get(f"{part}_shaft_low_mm"), values.get(f"{part}_shaft_high_mm")
    return low if ends[0] is None else ends[0], high if ends[1] is None else ends[1]


def crank_hub(parts: Outlines) -> Plate | None:
    """Return the crank's hub above the locking disc or the arm; None if omitted or not higher."""
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    if not (size.has_hub("crank") and sizes.crank_hub > sizes.crank_bore):
        return None
    low = 0.0 - size.allowances.pin_gap_mm  # no -0.0
    high = sizes.wheel_thickness
    if size.crank_hub_length_mm is not None:
        high = low + size.crank_hub_length_mm
    if parts.crank and is_whole(parts.assembly, sizes):
        low += sizes.lock_thickness
    elif not parts.has_arm:
        key = "crank_hub_length_mm" if size.crank_hub_mm is None else "crank_hub_mm"
        raise GenevaError(
            f"{key}: a hub needs the locking disc or the crank arm to stand on, and there is "
            "neither; remove it",
            ("size", key),
        )
    if high <= low:
        return None
    bores, outline = crank_bore(parts.assembly, sizes), Circle("HUB", ORIGIN, sizes.crank_hub)
    return Plate("crank's hub", "HUB", outline, bores, low, high)


def shafts(parts: Outlines, lowest: float, stop: float | None) -> Iterator[Shaft]:
    """Yield the shafts of wheel and crank, from the frame's lower face, ``lowest``, up.

    The crank's shaft ends at ``stop`` if links block it.
    """
    assembly, sizes, still = parts.assembly, parts.sizes, np.zeros(1)
    size = assembly.mechanism.spec.size
    if sizes.wheel_bore:
        bore = bore_of(size, "wheel", sizes.wheel_bore)
        ends = wheel_shaft_ends(parts, lowest)
        turn = 0.0 if bore.is_plain else float(assembly.wheel(still)[0])
        yield Shaft("wheel's shaft", "wheel", bore, *ends, ORIGIN, assembly.rests[0], turn)
    radius = sizes.arm_bore if parts.has_arm else sizes.crank_bore
    if radius:
        bore, at = bore_of(size, "crank", radius), (assembly.L, 0.0)
        # what it carries ends in the arm, or in a bored locking disc or its hub
        top = 0.0 - size.allowances.pin_gap_mm  # no -0.0
        if sizes.crank_bore:
            on_disc = crank_hub(parts)
            top = on_disc.high if on_disc else top + sizes.lock_thickness
        ends = shaft_ends(size, "crank", lowest if stop is None else stop, top)
        turn = 0.0 if bore.is_plain else float(assembly.crank(still)[0])
        direction = keyway_direction(assembly)
        yield Shaft("crank's shaft", "crank", bore, *ends, at, direction, turn)


def wheel_shaft_ends(parts: Outlines, lowest: float) -> tuple[float, float]:
    """Return the ends of the wheel's shaft along the axis."""
    sizes, near = parts.sizes, SAME_LENGTH * parts.assembly.L
    geared = False
    for link in links_at(parts.assembly.full, np.zeros(1)):
        for x, y in link.joints if link.radius_mm else ():
            geared = geared or math.hypot(float(x[0]), float(y[0])) < near
    low = lowest if sizes.wheel_hub or geared else 0.0
    return shaft_ends(parts.assembly.mechanism.spec.size, "wheel", low, sizes.wheel_thickness)


def bore_at(mechanism: Mechanism, at: Point, radius: float) -> ShaftBore:
    """Return the bore of what is on the shaft at a point: as in wheel or crank, or a round one."""
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    part = "crank" if same(at, (L, 0.0), L) else "wheel" if same(at, ORIGIN, L) else ""
    if not (part and has_shape(size, part)):
        return ShaftBore(round_bore(size, radius))
    own, still = assembly(mechanism, flat=False), np.zeros(1)
    if part == "wheel":
        direction, turn = own.rests[0], own.wheel(still)
    else:
        direction, turn = keyway_direction(own), own.crank(still)
    return ShaftBore(bore_of(size, part, radius), direction + float(turn[0]))
