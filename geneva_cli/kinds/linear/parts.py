"""All parts of a rack's machine at their positions, at input angle 0.

In the machine's frame the rack's slots run along x, the roller is at the origin, and the crank's
axis is at (R, 0).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Self

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Member, Plate, least_wall
from geneva_cli.geometry.shapes import Point
from geneva_cli.geometry.sheet import rectangle
from geneva_cli.kept import cached_property
from geneva_cli.kinds.linear.frame import bar_bolts, guide, rack_frame, shafts_and_frame
from geneva_cli.kinds.linear.outlines import RackOutlines, turned_rack
from geneva_cli.kinds.linear.rack import (
    RackSizes,
    crank_arm,
    lock_bolts,
    locking_sector,
    rack_bore,
    rack_contour,
    rack_ends,
    rack_sizes,
)
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.assembly import assembly
from geneva_cli.parts.gears.gear_pair import gear_pair
from geneva_cli.parts.parts import EdgedParts, FrameAndShafts, NamedBuilds
from geneva_cli.parts.projection import NamedParts
from geneva_cli.parts.shafts.arm_and_shafts import roller_plates
from geneva_cli.parts.shafts.bores import Screws
from geneva_cli.parts.sizes import drawn_thicknesses, pin_radius
from geneva_cli.parts.turn.turn_certificate import FlatPairs
from geneva_cli.spec.defaults import wall_min


class RackParts(EdgedParts):
    """The parts of a machine, in its frame."""

    @cached_property
    def _shape(self) -> RackOutlines:
        return turned_rack(assembly(self.mechanism, flat=False), self.sizes)

    @cached_property
    def sizes(self) -> RackSizes:
        """The sizes of rack and locking sector."""
        return rack_sizes(self.mechanism)

    @property
    def built(self) -> Self:
        """These parts."""
        return self

    @property
    def all_built(self) -> NamedBuilds:
        """Names and functions of all parts; its frame holds its gears, but not links."""
        framed = self.mechanism.spec.has_parts
        return [("all parts", lambda: self)] if framed else super().all_built

    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far the roller is in its slot, beyond the rack's edge, mm, (n,)."""
        return self.sizes.edge - self.assembly.pin(motion, at, drives=True)[:, 0]

    def pairs(self, target: float) -> FlatPairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""
        return FlatPairs(self._shape.gaps, self._shape.crank, target, self.sizes.edge)

    @property
    def axis(self) -> Point:
        """The crank's axis."""
        return self.sizes.arm, 0.0

    @cached_property
    def wheel(self) -> Member:
        """The rack, with holes for the bolts of its guide bar."""
        count, sizes = self.mechanism.spec.wheel.z, self.sizes
        high = drawn_thicknesses(self.mechanism.spec.size, sizes.arm).wheel
        outline, holes = rack_contour(sizes, count), bar_bolts(sizes, count)
        return Member(Plate("rack", "WHEEL", outline, holes, 0.0, high))

    @cached_property
    def bar(self) -> Member:
        """The bar under the rack's back; half the height under it is free."""
        count, sizes, x = self.mechanism.spec.wheel.z, self.sizes, self.sizes.guide.back
        low, high = rack_ends(sizes, count)
        outline = rectangle("LINK", x, low, x + sizes.guide.bar, high)
        under = 0.5 * rack_frame(self.mechanism).top
        return Member(Plate("guide bar", "LINK", outline, bar_bolts(sizes, count), under, 0.0))

    @cached_property
    def arm(self) -> Plate | None:
        """The crank's arm, x to the roller; None without a pin for the roller."""
        return self.required_arm if rack_bore(self.mechanism) else None

    @property
    def required_arm(self) -> Plate:
        """The arm. Raises GenevaError, naming the key, where the sizes leave none."""
        size, R, arm = self.mechanism.spec.size, self.sizes.arm, crank_arm(self.mechanism)
        holes = (arm.bore, *arm.pins, *arm.bolts)
        least, needed = least_wall(holes, [arm.outline]), wall_min(size, R)
        if least < needed:
            raise GenevaError(
                f"--part arm: the least wall around the arm's holes is {least:.4g} mm, below "
                f"{needed:g}; use a larger arm_eye_mm or arm_hub_mm, or a smaller arm_bore_mm, "
                "pin_mm or lock_bolt_mm",
                ("size", "arm_bore_mm"),
            )
        high = -size.allowances.pin_gap_mm
        thick = drawn_thicknesses(size, R).arm
        return Plate("arm", "ARM", arm.outline, holes, high - thick, high)

    @cached_property
    def crank_without_arm(self) -> Member:
        """Locking sector, roller and pin, as they lie in the rack's plane."""
        return self._crank(None)

    @cached_property
    def crank(self) -> Member:
        """The crank: arm, locking sector, roller on its pin."""
        return self._crank(self.arm)

    def _crank(self, arm: Plate | None) -> Member:
        """The crank's parts in the arm's frame; the locking sector stands on the arm."""
        size, sizes = self.mechanism.spec.size, self.sizes
        thick, stands = drawn_thicknesses(size, sizes.arm), -size.allowances.pin_gap_mm
        pin, fit = pin_radius(size, sizes.roller), size.allowances.shaft_fit_mm
        turned = roller_plates(sizes.roller, pin, stands - thick.arm, thick.wheel, fit)
        members = [Member(arm)] if arm else []
        members += [Member(one, (sizes.arm, 0.0)) for one in turned]
        sector = locking_sector(sizes)
        if sector is not None:
            holes, high = tuple(lock_bolts(self.mechanism)), stands + thick.lock
            members.append(Member(Plate("locking sector", "CRANK", sector, holes, stands, high)))
        # the roller is on the rack's side
        return Member(Group("crank", tuple(members)), self.axis, math.pi)

    @cached_property
    def gear_pair(self) -> tuple[Member, ...]:
        """The noncircular gears that turn the crank, up to their pitch curves."""
        return gear_pair(self.mechanism, None, self.writer, rack_bore(self.mechanism))

    @cached_property
    def guide(self) -> tuple[Member, ...]:
        """Rail, wall and cover of the guide."""
        self._require_built()
        return tuple(Member(plate) for plate in guide(self.mechanism))

    @cached_property
    def framed(self) -> FrameAndShafts:
        """The frame and the shafts."""
        self._require_built()
        return shafts_and_frame(self.mechanism)

    def _require_built(self) -> None:
        """Raise GenevaError where the crank's shaft has no bearing in the frame."""
        if reason := self.mechanism.spec.no_parts:
            raise GenevaError(reason, ("drive", "kind"))

    @property
    def horn_mm(self) -> float | None:
        """Thickness of the horns between slots and recesses; None without a lock."""
        return self.sizes.horn if self.sizes.lock else None

    @property
    def screws(self) -> tuple[Screws, ...]:
        """The screws of locking sector, guide bar, and what is fixed to the frame."""
        count = self.mechanism.spec.wheel.z
        own = [
            Screws(fixed, len(holes), 2.0 * holes[0].radius, thread)
            for fixed, holes, thread in (
                ("locking sector", lock_bolts(self.mechanism) if self.arm else [], "the arm"),
                ("rack", bar_bolts(self.sizes, count), "nuts under the guide bar"),
            )
            if holes
        ]
        return (*own, *(self.framed.screws if self.mechanism.spec.has_parts else ()))

    @property
    def standing(self) -> tuple[Member, ...]:
        """The parts that stand still."""
        return (*self.guide, self.frame)

    @property
    def members(self) -> tuple[Member, ...]:
        """All parts; behind links those that move."""
        moving = self.wheel, self.bar, self.crank
        framed = self.mechanism.spec.has_parts
        return (*moving, *self.gear_pair, *self.shafts, *self.standing) if framed else moving

    def by_name(self) -> Iterator[NamedParts]:
        """Yield all parts in the order of a list, as names and functions that build them."""
        yield "rack", lambda: [self.wheel.part]
        yield "guide bar", lambda: [self.bar.part]
        yield "crank", lambda: [self.crank.part]
        yield "gears", lambda: [one.part for one in self.gear_pair if self.mechanism.spec.has_parts]
        yield "shafts", lambda: [one.part for one in self.shafts]
        yield "guide", lambda: [one.part for one in self.guide]
        yield "frame", lambda: [self.frame.part]
