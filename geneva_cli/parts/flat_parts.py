"""All parts of a flat machine at their positions, at input angle 0.

The wheel's axis is the origin, and the crank's is on the x axis. Each part is built once, on first
use. Drawing, solid, list of parts, sheet and the checks of shafts are projections of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NoReturn, Self, cast

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Member, Plate
from geneva_cli.geometry.shapes import Contour, Point
from geneva_cli.kept import cached_property
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Dimension
from geneva_cli.motion.records import thing
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.edged_parts import EdgedParts
from geneva_cli.parts.links.link_shafts import links_to_fix
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.outlines.reliefs import is_whole
from geneva_cli.parts.outlines.wheel_outline import slot_walls, wheel_contour
from geneva_cli.parts.parts import NamedBuilds
from geneva_cli.parts.sizes import Sizes, drawn_thicknesses, pin_radius
from geneva_cli.parts.slots.roller_paths import roller_centres

if TYPE_CHECKING:
    from geneva_cli.parts.arm import CrankArm
    from geneva_cli.parts.gears.gear_blanks import Gear
    from geneva_cli.parts.links.links import Links
    from geneva_cli.parts.mounted_plate import FrameAndShafts
    from geneva_cli.parts.projection import NamedParts
    from geneva_cli.parts.shafts.screws import Screws
    from geneva_cli.parts.turn.bounds import FlatPairs
    from geneva_cli.parts.turn.gaps import Gaps


class FlatParts(EdgedParts):
    """The parts of a flat machine in the wheel's frame.

    A part that the sizes leave no place for raises GenevaError, naming the key. A wheel with too
    many slots is not drawn: then there are links and gears, with shafts and frame, and the rollers
    on links.
    """

    @cached_property
    def _shape(self) -> Outlines:
        return drawn(*machine_sizes(self.mechanism))

    @property
    def outlines(self) -> Outlines:
        """The outlines of wheel and crank; raises GenevaError for a wheel that is not drawn."""
        return self._shape

    @property
    def sizes(self) -> Sizes:
        """The lengths of the parts."""
        return self._shape.sizes

    @property
    def close(self) -> float:
        """The overlap, mm, that counts as rounding or as the walls' tolerance."""
        return self._shape.close

    @property
    def drawn(self) -> Outlines | None:
        """The outlines of wheel and crank; None for a wheel that is not drawn."""
        return self.outlines if self.mechanism.spec.is_flat else None

    @property
    def built(self) -> Self:
        """These parts. Raises GenevaError where the sizes leave no wheel or no crank."""
        _ = self.drawn
        return self

    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far a motion's roller is in its slot, beyond the mouth's corners, mm, (n,)."""
        # the corners are on the rim, half a slot's width from the slot's middle
        level = math.sqrt(max(self.sizes.rim**2 - self.sizes.half_width**2, 0.0))
        far = np.hypot(*self.assembly.driving(motion, at).T)
        return self.assembly.sign * (level - far)

    def pairs(self, target: float) -> FlatPairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""
        from geneva_cli.geometry.distance import farthest
        from geneva_cli.parts.turn.bounds import FlatPairs

        gaps, axis = cast("Gaps", self.outlines.gaps), np.zeros((1, 2))
        outside = self.assembly.sign > 0.0
        rim = float(farthest(gaps.wheel, 0.0, 0.0).max() if outside else gaps.wheel.signed(axis)[0])
        return FlatPairs(gaps, self.outlines.crank, target, rim)

    def _has_sizes_of(self, mechanism: Mechanism) -> bool:
        try:
            return machine_sizes(mechanism)[1] == self.sizes
        except GenevaError:
            return False

    def walls(self, slot: Engagement) -> Contour:
        """Return the walls of a slot in the wheel's frame, with that slot ahead."""
        parts = self.outlines
        if self.tolerance is None:
            return parts.slots[slot]
        return slot_walls(parts.assembly, parts.sizes, slot, self.tolerance, self.curves)

    @cached_property
    def wheel(self) -> Member:
        """The wheel, with its hub below it if the spec has one."""
        from geneva_cli.parts.outlines.wheel_circles import wheel_part

        parts = self.outlines
        walls = {slot: self.walls(slot) for slot in parts.slots}
        contour = parts.wheel
        if walls != parts.slots:
            stopped = self.mechanism.spec.wheel.stopped
            contour = wheel_contour(parts.assembly, parts.sizes, walls, stopped)
        turn = float(parts.assembly.wheel(np.zeros(1))[0])
        return self._edged([Member(wheel_part(parts.assembly, parts.sizes, contour), turn=turn)])[0]

    @cached_property
    def orbiting(self) -> tuple[Member, ...]:
        """The wheels behind the first on a carrier, which rest."""
        half = self.mechanism.engagements[0].half_step
        _, *others = self.mechanism.wheel_places
        return tuple(Member(self.wheel.part, one.at, one.turn - half) for one in others)

    @cached_property
    def links(self) -> Links:
        """The links of the drive, with the pins and rollers between them, and round gears."""
        from geneva_cli.parts.links.links import drawn_links

        links = drawn_links(self.mechanism, self.drawn)
        return links._replace(cut=self._edged(links.cut), joined=self._edged(links.joined))

    @cached_property
    def arm(self) -> CrankArm | None:
        """The crank arm; None without a crank, or without pins for the rollers."""
        from geneva_cli.parts.arm import crank_arm

        return crank_arm(self.outlines) if self.outlines.has_arm else None

    @cached_property
    def arm_plate(self) -> Plate | None:
        """The crank arm as a plate."""
        from geneva_cli.parts.arm import arm_plate

        return self._plate(arm_plate(self.outlines, self.arm)) if self.arm else None

    @cached_property
    def locking(self) -> tuple[Plate, ...]:
        """The locking disc, or its sectors."""
        from geneva_cli.parts.arm import locking_plates

        return tuple(map(self._plate, locking_plates(self.outlines)))

    @cached_property
    def rollers(self) -> tuple[Member, ...]:
        """The rollers with their pins, which stand in the arm or in a link.

        They are in the crank's frame. Of a wheel that is not drawn, they are those on links.
        """
        from geneva_cli.parts.arm import roller_plates

        mechanism, low = self.mechanism, self.links.pin_low
        size, r = mechanism.spec.size, mechanism.roller_radius_mm
        sizes = self.drawn.sizes if self.drawn else None
        thick = drawn_thicknesses(size, mechanism.center_distance_mm, sizes)
        if low is None:
            low = -size.allowances.pin_gap_mm - (
                thick.arm if self.drawn and self.drawn.has_arm else 0.0
            )
        plates = roller_plates(
            r, pin_radius(size, r, sizes), low, thick.wheel, size.allowances.shaft_fit_mm
        )
        centres = roller_centres(self.drawn.assembly) if self.drawn else self._on_links()
        return self._edged(Member(plate, centre) for centre in centres for plate in plates)

    def _on_links(self) -> tuple[Point, ...]:
        """Return the centres of rollers on links in the plane below the wheel."""
        from geneva_cli.parts.links.link_sizes import roller_pins

        return tuple(at for link, at in roller_pins(self.mechanism) if link.plane == 1)

    @cached_property
    def crank_hub(self) -> Plate | None:
        """The crank's hub above the disc or the arm, if the spec has one."""
        from geneva_cli.parts.shafts.hub_and_shafts import crank_hub

        hub = crank_hub(self.outlines)
        return self._plate(hub) if hub else None

    @property
    def horn_mm(self) -> float | None:
        """Thickness of the horns between slots and recesses; None without a lock."""
        return self.outlines.sizes.horn if self.outlines.crank else None

    def hub_radii(self, part: str) -> tuple[float, float]:
        """Return the radii of the bore and the hub of a part, "wheel" or "crank", mm."""
        sizes = self.outlines.sizes
        radii = {
            "wheel": (sizes.wheel_bore, sizes.wheel_hub),
            "crank": (sizes.crank_bore, sizes.crank_hub),
        }
        return radii[part]

    def axle_radius(self, part: str) -> float:
        """Return the radius of a part's shaft, or of its hub if the spec has one, mm; 0 if none."""
        bore, hub = self.hub_radii(part)
        return max(bore, hub) if self.mechanism.spec.size.has_hub(part) else bore

    @cached_property
    def crank(self) -> Member:
        """The crank: locking disc or sectors, arm, rollers on their pins, hub."""
        return self._crank(self.arm_plate)

    @cached_property
    def crank_without_arm(self) -> Member:
        """The crank as it lies in the wheel's plane."""
        return self._crank(None)

    def about_wheel(self, crank: Member) -> tuple[Member, ...]:
        """Return the first crank, or a part of it, and its copies on all cranks about the wheel."""
        places = self.mechanism.crank_places
        before = np.array([-place.behind_deg for place in places])
        turns = self.outlines.assembly.crank(before) - self.outlines.assembly.crank(np.zeros(1))
        return tuple(
            crank._replace(at=place.at, turn=crank.turn + place.turn + float(turn))
            if place.number > 1
            else crank
            for place, turn in zip(places, turns, strict=True)
        )

    @cached_property
    def cranks(self) -> tuple[Member, ...]:
        """All cranks about the wheel."""
        return self.about_wheel(self.crank)

    def _crank(self, arm: Plate | None) -> Member:
        hub, assembly = self.crank_hub, self.outlines.assembly
        below = (Member(plate) for plate in (*self.locking, *([arm] if arm else [])))
        group = Group("crank", (*below, *self.rollers, *([Member(hub)] if hub else [])))
        return Member(group, (assembly.L, 0.0), float(assembly.crank(np.zeros(1))[0]))

    @cached_property
    def front(self) -> FlatParts:
        """The parts of the first of two wheels in series. Raises GenevaError without a second."""
        from geneva_cli.parts.first_pair import first_pair

        return FlatParts(first_pair(self.mechanism, self.drawn))

    @property
    def in_front(self) -> tuple[FlatParts, ...]:
        """Those parts; none without a second wheel, or for a wheel that is not drawn."""
        return (self.front,) if self.drawn and self.mechanism.first_wheel else ()

    @cached_property
    def first(self) -> tuple[Member, ...]:
        """Of two wheels in series, the first and its locking disc."""
        if not self.in_front:
            return ()
        from geneva_cli.parts.first_pair import in_front

        L = self.mechanism.center_distance_mm
        return self._edged(in_front(self.front.outlines, self.links, L))

    @cached_property
    def toothed(self) -> tuple[Gear, ...]:
        """Gears with round pitch circles, with teeth if they have a module; no first wheel."""
        if self.first or not self.links.gears:
            return ()
        from geneva_cli.parts.gears.gear_pair import FINE

        write = self.writer(FINE["cubics"] * self.mechanism.center_distance_mm)
        return tuple(gear.with_teeth(write) for gear in self.links.gears)

    @property
    def tooth_dimensions(self) -> tuple[Dimension, ...]:
        """Dimensions of the gears' teeth; none without teeth."""
        from geneva_cli.parts.gears.pair_teeth import pair_teeth

        teeth = pair_teeth(self.mechanism.spec.gears, self.mechanism.spec.size)
        meshes = (teeth, self.links.mesh)
        return tuple(one for mesh in meshes if mesh for one in mesh.layout)

    @cached_property
    def gear_pair(self) -> tuple[Member, ...]:
        """The noncircular gears in front of a crank, with teeth or up to their pitch curves."""
        if self.mechanism.spec.gears is None:
            return ()
        from geneva_cli.parts.gears.gear_pair import gear_pair

        return gear_pair(self.mechanism, self.drawn, self.writer)

    @cached_property
    def _base(self) -> Plate | None:
        if self.drawn is None or self.drawn.assembly.rollers[0][0].groove is None:
            return None
        from geneva_cli.parts.slots.groove_plate import groove_base

        return groove_base(self.drawn, self.links)

    @cached_property
    def groove(self) -> tuple[Contour, Contour, Contour]:
        """The flanks of a cam's groove and its pitch curve; raises GenevaError without a groove."""
        from geneva_cli.parts.slots.groove_plate import groove_lines

        return groove_lines(self.outlines, self.tolerance, self.curves)

    @cached_property
    def groove_plate(self) -> tuple[Member, ...]:
        """The plates with a cam's groove: base, ring and island."""
        if self._base is None:
            return ()
        from geneva_cli.parts.slots.groove_plate import groove_stack

        stack = groove_stack(self._base, self.links, self.groove[:2])
        return self._edged(Member(plate, (self.outlines.assembly.L, 0.0)) for plate in stack)

    @cached_property
    def _framed(self) -> FrameAndShafts:
        framed: Callable[..., FrameAndShafts] | None
        framed = thing(self.mechanism.spec.wheel.NAME, "frame")
        if framed is None:
            raise GenevaError(
                f'--part frame: the shafts of gearing = "{self.mechanism.spec.wheel.NAME}" are not '
                "parallel, so one plate cannot hold them"
            )
        return framed(self.mechanism, self.drawn, self.links, self._base, self.first)

    @cached_property
    def spacers(self) -> tuple[Member, ...]:
        """The rings between the frame and parts that are screwed to it."""
        return self._edged(self._framed.spacers)

    @cached_property
    def bridge(self) -> tuple[Member, ...]:
        """The bridge that bears a crank's shaft from above; none where the frame bears it."""
        return self._edged([self._framed.bridge] if self._framed.bridge else [])

    @property
    def standing(self) -> tuple[Member, ...]:
        """The parts that stand still: a cam's groove plate, the frame, and what is on it."""
        return (*self.groove_plate, *self.spacers, *self.bridge, self.frame)

    @property
    def screws(self) -> tuple[Screws, ...]:
        """The screws of dial, locking disc, and what is fixed to the frame."""
        framed = self.frame_screws
        if not self.drawn:
            return framed
        from geneva_cli.parts.arm import bolts
        from geneva_cli.parts.outlines.wheel_circles import dial_bolts
        from geneva_cli.parts.shafts.screws import Screws

        own = []
        for fixed, holes, thread in (
            ("dial", dial_bolts(self.drawn.assembly, self.drawn.sizes), "the dial"),
            (self.locking[0].name, bolts(self.drawn), "the arm") if self.locking else ("", [], ""),
        ):
            if holes:
                own.append(Screws(fixed, len(holes), 2.0 * holes[0].radius, thread))
        return (*own, *framed)

    @property
    def required(self) -> tuple[Member, ...]:
        """Wheel, crank, links and frame, whose curves need not be fitted."""
        turning = (self.wheel, self.crank) if self.drawn else ()
        return (*turning, *self.links.cut, self.frame)

    def require(self) -> None:
        """Raise GenevaError for a part that cannot be built."""
        super().require()
        if self.mechanism.spec.gears is not None:
            from geneva_cli.parts.gears.gear_pair import pair_with_teeth

            pair_with_teeth(self.mechanism)

    @property
    def to_fix(self) -> tuple[str, ...]:
        """Names of the parts that turn with a shaft in a round bore, which holds nothing."""
        links = {plate.name: [plate.name] for plate in self.links.plates}
        named = {**links, "crank": [*links.get("crank", []), *self._on_crank_shaft()]}
        return tuple(one for name in self._framed.to_fix for one in named.get(name, [name]))

    def _on_crank_shaft(self) -> Iterator[str]:
        """Yield the names of the crank's parts about its shaft; bolts fix the disc to the arm."""
        if self.drawn is None:
            return
        if self.arm:
            yield "arm"
        sizes = self.outlines.sizes
        bored = sizes.crank_bore > 0.0 and is_whole(self.outlines.assembly, sizes)
        if self.locking and bored and not (self.arm and self.arm.bolts):
            yield "locking disc"

    @property
    def linked(self) -> tuple[Member, ...]:
        """The links, with the pins and rollers between and on them."""
        own = *self.links.cut, *self.links.joined
        return own if self.drawn else (*own, *self.rollers)

    @property
    def members(self) -> tuple[Member, ...]:
        """All parts."""
        turning = (self.wheel, *self.orbiting, *self.cranks) if self.drawn else ()
        moved = *turning, *self.linked, *self.round_gears, *self.gear_pair, *self.first
        return (*moved, *self.shafts, *self.standing)

    def by_name(self) -> Iterator[NamedParts]:
        """Yield all parts in the order of a list, as names and functions that build them."""
        if self.mechanism.spec.is_flat:
            yield "wheel", lambda: [one.part for one in (self.wheel, *self.orbiting)]
            each = len(self.mechanism.crank_places)
            yield "locking disc", lambda: each * self.locking
            yield "arm", lambda: each * [self.arm_plate] if self.arm_plate else []
            yield "rollers", lambda: each * [one.part for one in self.rollers]
            yield "crank's hub", lambda: each * [self.crank_hub] if self.crank_hub else []
        yield "links", lambda: [one.part for one in self.linked]
        yield "gears", lambda: [one.part for one in (*self.round_gears, *self.gear_pair)]
        yield "first wheel", lambda: [one.part for one in self.first]
        yield "shafts", lambda: [one.part for one in self.shafts]
        yield "groove plate", lambda: [one.part for one in self.groove_plate]
        yield "frame", lambda: [one.part for one in (*self.spacers, *self.bridge, self.frame)]


class FrontParts(FlatParts):
    """Links and gears without frame and shafts; all parts of a machine with no others."""

    @property
    def built(self) -> NoReturn:
        """Raise GenevaError with the reason why wheel and crank have no parts."""
        raise GenevaError(self.mechanism.spec.no_parts, ("wheel", "gearing"))

    @property
    def flat(self) -> Self:
        """These parts."""
        return self

    @property
    def all_built(self) -> NamedBuilds:
        """Name and function of links and gears."""
        return [("all parts", lambda: self)]

    @property
    def screws(self) -> tuple[Screws, ...]:
        """The screws between the parts; none."""
        return ()

    @property
    def to_fix(self) -> tuple[str, ...]:
        """Names of the parts that turn with a shaft in a round bore, which holds nothing."""
        return tuple(links_to_fix(self.links, self.mechanism))

    @property
    def members(self) -> tuple[Member, ...]:
        """Links and gears."""
        return (*self.linked, *self.round_gears, *self.gear_pair)

    def by_name(self) -> Iterator[NamedParts]:
        """Yield links and gears in the order of a list, as names and functions that build them."""
        yield "links", lambda: [one.part for one in self.linked]
        yield "gears", lambda: [one.part for one in (*self.round_gears, *self.gear_pair)]
