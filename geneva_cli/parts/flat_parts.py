"""All parts of a flat machine at their positions, at input angle 0, each built on first use.

The wheel's axis is the origin, and the crank's is on the x axis.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from operator import attrgetter
from typing import TYPE_CHECKING, NoReturn, Self

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Member, Plate
from geneva_cli.geometry.shapes import Contour
from geneva_cli.kept import cached_property
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, value_or
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.frame import framed
from geneva_cli.parts.links.links import Links, roller_pins
from geneva_cli.parts.machine_sizes import machine_sizes, refuse_unfit, unloaded
from geneva_cli.parts.outlines.crank_outline import crank_bore, is_whole
from geneva_cli.parts.outlines.cut_outlines import drawn, slot_walls, wheel_contour
from geneva_cli.parts.outlines.outlines import Outlines, dial_circle, wheel_hub, wheel_plate
from geneva_cli.parts.parts import EdgedParts, FrameAndShafts, NamedBuilds, Parts, parts_of
from geneva_cli.parts.shafts.arm_and_shafts import CrankArm, bolts, crank_arm, crank_hub, rollers
from geneva_cli.parts.shafts.bores import Screwed
from geneva_cli.parts.sizes import drawn_thicknesses, pin_radius
from geneva_cli.parts.slots.roller_paths import roller_centres

if TYPE_CHECKING:
    from geneva_cli.parts.projection import NamedParts
    from geneva_cli.parts.turn.turn_certificate import FlatPairs


class FlatParts(EdgedParts):
    """The parts of a flat machine in the wheel's frame."""

    @cached_property
    def shape(self) -> Outlines:
        """Wheel and crank as they are turned. Raises GenevaError where the sizes leave none.

        No outline depends on a size that the load chooses.
        """
        layout = unloaded(self.mechanism)
        try:
            refuse_unfit(*layout)
        except GenevaError:  # unless the load chooses sizes that fit
            layout = machine_sizes(self.mechanism)
        return drawn(*layout)

    @cached_property
    def outlines(self) -> Outlines:
        """The outlines of wheel and crank; raises GenevaError for a wheel that is not drawn."""
        _, sizes = machine_sizes(self.mechanism)
        return self.shape._replace(sizes=sizes)

    @property
    def built(self) -> Self:
        """These parts. Raises GenevaError where the sizes leave no wheel or no crank."""
        _ = self.outlines
        return self

    @property
    def close(self) -> float:
        """The overlap, mm, that counts as rounding or as the walls' tolerance."""
        return self.shape.close

    @property
    def drawn(self) -> Outlines | None:
        """The outlines of wheel and crank; None for links and gears alone."""
        return self.outlines

    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far a motion's roller is in its slot, beyond the mouth's corners, mm, (n,)."""
        own, sizes = self.shape, self.shape.sizes
        # the corners are on the rim, half a slot's width from the slot's middle
        level = math.sqrt(max(sizes.rim**2 - sizes.half_width**2, 0.0))
        lost = self.wall_lost if sizes.mouth_radius or sizes.horn_tip else 0.0
        far = np.hypot(*own.assembly.pin(motion, at, drives=True).T)
        return own.assembly.sign * (level - far) - lost

    @cached_property
    def wall_lost(self) -> float:
        """By how much the walls of straight slots end deeper than at sharp mouths, mm."""
        own, lost = self.shape, 0.0
        for (kind, _), cut in zip(own.assembly.slots, own.cut, strict=True):
            for sharp, piece in zip(own.slots[kind].segments, cut.segments, strict=True):
                lost = max(lost, math.dist(*sharp[:2]) - math.dist(*piece[:2]))
        return lost

    def pairs(self, target: float) -> FlatPairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""
        from geneva_cli.parts.turn.turn_certificate import FlatPairs

        gaps, axis = self.outlines.gaps, np.zeros((1, 2))
        outside = self.assembly.sign > 0.0
        rim = float(gaps.wheel.farthest(axis).max() if outside else gaps.wheel.signed(axis)[0])
        return FlatPairs(gaps, self.outlines.crank, target, rim)

    def following(self, mechanism: Mechanism) -> Parts:
        """Return the parts of the next design, with this turn if it is the same.

        It is if wheel, drive, motion and ``[size]`` are equal, but for the speed.
        """
        parts, computed = parts_of(mechanism), vars(self)
        own, other = self.mechanism.spec, mechanism.spec
        keys = attrgetter("wheel", "motion", "size")
        alike = own.drive.replace(n_rpm=1.0) == other.drive.replace(n_rpm=1.0)
        if alike and "shape" in computed and keys(own) == keys(other):
            assembly = self.assembly._replace(full=mechanism)
            vars(parts)["shape"] = self.shape._replace(assembly=assembly)
            vars(parts).update({"turn": self.turn} if "turn" in computed else {})
        return parts

    def walls(self, slot: Engagement) -> Contour:
        """Return the walls of a slot in the wheel's frame, with that slot ahead."""
        parts = self.outlines
        if self.tolerance is None:
            return parts.slots[slot]
        return slot_walls(parts.assembly, parts.sizes, slot, self.tolerance, self.curves)

    @cached_property
    def wheel(self) -> Member:
        """The wheel, with its hub below it if the spec has one."""
        parts = self.outlines
        contour, where, sizes = parts.wheel, parts.assembly, parts.sizes
        if self.tolerance is not None:
            walls = {slot: self.walls(slot) for slot in parts.slots}
            if walls != parts.slots:
                contour, _ = wheel_contour(where, sizes, walls, where.full.spec.wheel.stopped)
        turn, plate = float(where.wheel(np.zeros(1))[0]), wheel_plate(where, sizes, contour)
        hub = wheel_hub(where, sizes)
        return Member(Group(plate.name, (Member(plate), Member(hub))) if hub else plate, turn=turn)

    @cached_property
    def orbiting(self) -> tuple[Member, ...]:
        """The wheels behind the first on a carrier, which rest."""
        half = self.mechanism.engagements[0].half_step
        _, *others = self.mechanism.wheel_places
        return tuple(Member(self.wheel.part, one.at, one.turn - half) for one in others)

    @cached_property
    def links(self) -> Links:
        """The links of the drive, with the pins and rollers between them, and round gears."""
        if not links_at(self.mechanism, np.zeros(1)):
            return Links()
        from geneva_cli.parts.links.link_plates import drawn_links

        return drawn_links(self.mechanism, self.drawn)

    @cached_property
    def arm(self) -> CrankArm | None:
        """The crank arm; None without a crank, or without pins for the rollers."""
        return crank_arm(self.outlines) if self.outlines.has_arm else None

    @cached_property
    def arm_plate(self) -> Plate | None:
        """The crank arm as a plate below the wheel, at a distance of ``pin_gap_mm``."""
        arm, high = self.arm, -self.mechanism.spec.size.allowances.pin_gap_mm
        if arm is None:
            return None
        low, holes = high - self.outlines.sizes.arm_thickness, (arm.bore, *arm.pins, *arm.bolts)
        return Plate("arm", arm.outline.layer, arm.outline, holes, low, high)

    @cached_property
    def locking(self) -> tuple[Plate, ...]:
        """The locking disc, or its sectors, with bolts and bore."""
        parts, screwed = self.outlines, bolts(self.outlines)
        whole = is_whole(parts.assembly, parts.sizes)
        low = -self.mechanism.spec.size.allowances.pin_gap_mm  # it stands on the arm
        high, name = low + parts.sizes.lock_thickness, "locking disc" if whole else "locking sector"
        bore = crank_bore(parts.assembly, parts.sizes) if whole else ()
        each, plates = len(screwed) // max(1, len(parts.crank)), list[Plate]()
        for k, contour in enumerate(parts.crank):
            holes = (*bore, *screwed[k * each : (k + 1) * each])
            plates.append(Plate(name, contour.layer, contour, holes, low, high))
        return tuple(plates)

    @cached_property
    def rollers(self) -> tuple[Member, ...]:
        """The rollers with their pins in the arm or in a link; in the crank's frame."""
        drawn, low = self.outlines, self.links.pin_low
        if low is None:
            arm = drawn.sizes.arm_thickness if drawn.has_arm else 0.0
            low = -self.mechanism.spec.size.allowances.pin_gap_mm - arm
        centres, sizes = roller_centres(drawn.assembly), drawn.sizes
        return rollers(self.mechanism, centres, sizes.pin, low, sizes.wheel_thickness)

    def axle_radius(self, part: str) -> float:
        """Return the radius of a part's shaft, or of its hub if the spec has one, mm; 0 if none."""
        sizes = self.outlines.sizes
        bore = sizes.wheel_bore if part == "wheel" else sizes.crank_bore
        hub = sizes.wheel_hub if part == "wheel" else sizes.crank_hub
        return max(bore, hub) if self.mechanism.spec.size.has_hub(part) else bore

    def crank_with(self, arm: bool) -> Member:
        """Return the crank in the machine; without its arm as it lies in the wheel's plane."""
        assembly, below = self.outlines.assembly, self.arm_plate if arm else None
        plates = filter(None, (*self.locking, below, crank_hub(self.outlines)))
        turn = float(assembly.crank(np.zeros(1))[0])
        group = Group("crank", (*map(Member, plates), *self.rollers))
        return Member(group, (assembly.L, 0.0), turn)

    def about_wheel(self, crank: Member) -> tuple[Member, ...]:
        """Return the first crank, or a part of it, and its copies on all cranks about the wheel."""
        out = []
        for place in self.mechanism.crank_places:
            turn = float(self.outlines.assembly.crank(np.array([-place.behind_deg]))[0])
            out.append(crank._replace(at=place.at, turn=place.turn + turn))
        return tuple(out)

    @cached_property
    def cranks(self) -> tuple[Member, ...]:
        """All cranks about the wheel."""
        return self.about_wheel(self.crank)

    @cached_property
    def front(self) -> FlatParts:
        """The parts of the first of two wheels in series. Raises GenevaError without a second."""
        from geneva_cli.parts.first_wheel import first_pair

        return FlatParts(first_pair(self.mechanism, self.drawn))

    @property
    def in_front(self) -> tuple[FlatParts, ...]:
        """Those parts; none without a second wheel."""
        return (self.front,) if self.mechanism.first_wheel and self.drawn else ()

    @cached_property
    def first(self) -> tuple[Member, ...]:
        """Of two wheels in series, the first and its locking disc."""
        if not self.in_front:
            return ()
        first, L = self.front.outlines, self.mechanism.center_distance_mm
        # the first wheel lies two planes below the wheel
        low, high = self.links.sizes.span(2)
        # at mid-motion the first slot of the first wheel's frame points at the first crank
        wheel = wheel_plate(first.assembly, first.sizes, first.wheel), L, 0.0
        discs = ((plate, L + first.assembly.L, math.pi) for plate in self.front.locking)
        return tuple(
            Member(plate._replace(name=f"first {plate.name}", low=low, high=high), (x, 0.0), turn)
            for plate, x, turn in (wheel, *discs)
        )

    @property
    def round_gears(self) -> tuple[Member, ...]:
        """Gears with round pitch circles; a first wheel is none."""
        return () if self.first else self.links.gears

    @cached_property
    def gear_pair(self) -> tuple[Member, ...]:
        """The noncircular gears in front of a crank, up to their pitch curves."""
        if self.mechanism.spec.gears is None:
            return ()
        from geneva_cli.parts.gears.gear_pair import gear_pair

        return gear_pair(self, self.drawn)

    @cached_property
    def _base(self) -> Plate | None:
        if self.outlines.assembly.rollers[0][0].groove is None:
            return None
        from geneva_cli.parts.slots.groove import groove_base

        return groove_base(self.outlines, self.links)

    @cached_property
    def groove(self) -> tuple[Contour, ...]:
        """The flanks of a cam's groove and its pitch curve; raises GenevaError without a groove."""
        from geneva_cli.parts.slots.groove import groove_lines

        return groove_lines(self.outlines, self.tolerance, self.curves)

    @cached_property
    def groove_plate(self) -> tuple[Member, ...]:
        """The plates with a cam's groove: base, ring and island."""
        if self._base is None:
            return ()
        from geneva_cli.parts.slots.groove import groove_stack

        stack = groove_stack(self._base, self.links, self.groove[:2])
        return tuple(Member(plate, (self.outlines.assembly.L, 0.0)) for plate in stack)

    @cached_property
    def framed(self) -> FrameAndShafts:
        """The frame, what is on it, and the shafts."""
        parts = self.outlines
        arm = parts.sizes.arm_thickness if parts.has_arm else 0.0
        plates = self._base, wheel_hub(parts.assembly, parts.sizes)
        lows = [*map(attrgetter("low"), filter(None, plates))]
        lows.append(-self.mechanism.spec.size.allowances.pin_gap_mm - arm)
        lows += map(attrgetter("part.low"), (*self.linked, *self.links.gears, *self.first))
        if self.mechanism.spec.gears:
            from geneva_cli.parts.gears.gear_pair import gear_span

            lows.append(gear_span(self.mechanism, parts)[0])
        return framed(parts, self.links, self._base, self.first, min(lows))

    @property
    def standing(self) -> tuple[Member, ...]:
        """The parts that stand still: a cam's groove plate, the frame, and what is on it."""
        return (*self.groove_plate, *self.framed.on_it, self.frame)

    @property
    def screws(self) -> tuple[Screwed, ...]:
        """The screws of dial, locking disc, and what is fixed to the frame."""
        drawn = self.outlines
        holes = dial_circle(drawn.assembly, drawn.sizes).holes
        own = [("dial", "the dial", hole) for hole in holes]
        for disc in self.locking[:1]:  # or the first of its sectors
            own += [(disc.name, "the arm", hole) for hole in bolts(drawn)]
        return (*own, *self.framed.screws)

    @property
    def required(self) -> tuple[Member, ...]:
        """Wheel, crank, links and frame, whose curves need not be fitted."""
        return (self.wheel, self.crank, *self.links.cut, self.frame)

    @property
    def linked(self) -> tuple[Member, ...]:
        """The links, with the pins and rollers between them."""
        return *self.links.cut, *self.links.joined

    @property
    def _in_front(self) -> tuple[Member, ...]:
        return (*self.linked, *self.round_gears, *self.gear_pair)

    @property
    def members(self) -> tuple[Member, ...]:
        """All parts."""
        turning = self.wheel, *self.orbiting, *self.cranks
        return (*turning, *self._in_front, *self.first, *self.shafts, *self.standing)

    def _links_and_gears(self) -> Iterator[NamedParts]:
        yield "links", lambda: [one.part for one in self.linked]
        yield "gears", lambda: [one.part for one in (*self.round_gears, *self.gear_pair)]

    def by_name(self) -> Iterator[NamedParts]:
        """Yield all parts in the order of a list, as names and functions that build them."""
        each = len(self.mechanism.crank_places)
        yield "wheel", lambda: [one.part for one in (self.wheel, *self.orbiting)]
        yield "locking disc", lambda: each * self.locking
        yield "arm", lambda: each * [self.arm_plate] if self.arm_plate else []
        yield "rollers", lambda: each * [one.part for one in self.rollers]
        yield "crank's hub", lambda: each * [hub] if (hub := crank_hub(self.outlines)) else []
        yield from self._links_and_gears()
        yield "first wheel", lambda: [one.part for one in self.first]
        yield "shafts", lambda: [one.part for one in self.shafts]
        yield "groove plate", lambda: [one.part for one in self.groove_plate]
        yield "frame", lambda: [one.part for one in (*self.framed.on_it, self.frame)]


class FrontParts(FlatParts):
    """Links and gears without frame and shafts; all parts of a machine with no others."""

    @property
    def drawn(self) -> None:
        """None: wheel and crank are not drawn."""
        return None

    @property
    def flat(self) -> Self:
        """These parts."""
        return self

    @property
    def framed(self) -> NoReturn:
        """Raise GenevaError: the frame is of all parts."""
        raise GenevaError("--part frame: no plate holds the shafts of a machine without its parts")

    @property
    def all_built(self) -> NamedBuilds:
        """Name and function of links and gears."""
        return [("all parts", lambda: self)]

    @property
    def linked(self) -> tuple[Member, ...]:
        """The links, with the pins and rollers between and on them."""
        mechanism, links = self.mechanism, self.links
        size, pin = mechanism.spec.size, pin_radius(mechanism.spec.size, mechanism.roller_radius_mm)
        centres = [at for link, at in roller_pins(mechanism) if link.plane == 1]
        high = drawn_thicknesses(size, mechanism.center_distance_mm).wheel
        low = value_or(links.pin_low, -size.allowances.pin_gap_mm)
        own = *links.cut, *links.joined
        return (*own, *rollers(mechanism, centres, pin, low, high))

    @property
    def members(self) -> tuple[Member, ...]:
        """Links and gears."""
        return self._in_front

    def by_name(self) -> Iterator[NamedParts]:
        """Yield links and gears in the order of a list, as names and functions that build them."""
        return self._links_and_gears()
