"""All parts of a rack's machine at their positions, at input angle 0.

In the machine's frame the rack's slots run along x, the roller is at the origin, and the crank's
axis is at (R, 0). A bar under the rack's back slides between a rail, on which the rack lies, and a
wall with a cover, beyond the sweep of the crank's arm. They are screwed to the frame.
"""

import math
from collections.abc import Iterator

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.geometry.plates import Group, Member, NamedParts, Plate, least_wall
from geneva_cli.geometry.shapes import Circle
from geneva_cli.geometry.sheet import rectangle
from geneva_cli.kept import cached_property
from geneva_cli.kinds.linear import rack
from geneva_cli.kinds.linear.outlines import turned_rack
from geneva_cli.loads.strength.pin_arm_key import NO_ARM, NO_KEY, ArmDimensions
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, value_or
from geneva_cli.parts.assembly import assembly
from geneva_cli.parts.frame import hole_without_shaft, mounted_plate, shaft_holes
from geneva_cli.parts.gears.gear_pair import gear_pair, gear_shafts, gear_span
from geneva_cli.parts.parts import EdgedParts, FrameAndShafts, NamedBuilds
from geneva_cli.parts.shafts.arm_and_shafts import Shaft, rollers, shaft_ends
from geneva_cli.parts.shafts.bores import Screwed, bolt_radius, bore_of, reach_or_bore, tapped
from geneva_cli.parts.sized_by_load import ShaftSize, Stressed, key_of, shaft_of
from geneva_cli.parts.turn.turn_certificate import FlatPairs
from geneva_cli.parts.turn.turned_parts import TurnedShape
from geneva_cli.spec.defaults import wall_min


class RackParts(EdgedParts):
    """The parts of a machine, in its frame."""

    @cached_property
    def shape(self) -> TurnedShape:
        """Rack and crank as they are turned."""
        return turned_rack(assembly(self.mechanism, flat=False), self.sizes)

    @cached_property
    def sizes(self) -> rack.RackSizes:
        """The sizes of rack and locking sector."""
        return rack.rack_sizes(self.mechanism)

    @property
    def all_built(self) -> NamedBuilds:
        """Names and functions of all parts; its frame holds its gears, but not links."""
        framed = not self.mechanism.spec.no_parts
        return [("all parts", lambda: self)] if framed else super().all_built

    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far the roller is in its slot, beyond the rack's edge, mm, (n,)."""
        return self.sizes.rim - self.assembly.pin(motion, at, drives=True)[:, 0]

    def pairs(self, target: float) -> FlatPairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""
        return FlatPairs(self.shape.gaps, self.shape.crank, target, self.sizes.rim)

    @cached_property
    def _bar_bolts(self) -> tuple[Circle, ...]:
        """The holes that fix the guide's bar to the rack, behind each of its slots."""
        sizes, r = self.sizes, _bolt(self.sizes)
        places = rack.slot_places(sizes, self.mechanism.spec.wheel.z) if r else ()
        return tuple(Circle("BORE", (sizes.guide.middle, y), r) for y in places)

    @cached_property
    def wheel(self) -> Member:
        """The rack, with holes for the bolts of its guide bar."""
        outline = rack.rack_contour(self.sizes, self.mechanism.spec.wheel.z)
        return Member(Plate("rack", "WHEEL", outline, self._bar_bolts, 0.0, self.sizes.thick.wheel))

    @cached_property
    def bar(self) -> Member:
        """The bar under the rack's back; half the height under it is free."""
        place, (_, top, *_) = self.sizes.guide, heights(self.mechanism, self.sizes)
        low, high = rack.rack_ends(self.sizes, self.mechanism.spec.wheel.z)
        outline = rectangle("LINK", place.back, low, place.back + place.bar, high)
        return Member(Plate("guide bar", "LINK", outline, self._bar_bolts, 0.5 * top, 0.0))

    @cached_property
    def arm_plate(self) -> Plate | None:
        """The crank's arm, x to the roller; None without a pin for the roller."""
        return self.required_arm if self.sizes.bore else None

    @property
    def required_arm(self) -> Plate:
        """The arm. Raises GenevaError, naming the key, where the sizes leave none."""
        size, sizes = self.mechanism.spec.size, self.sizes
        arm, high = rack.crank_arm(size, sizes), -size.allowances.pin_gap_mm
        holes = (arm.bore, *arm.pins, *arm.bolts)
        least, needed = least_wall(holes, [arm.outline]), wall_min(size, sizes.arm)
        text = f"--part arm: the least wall around the arm's holes is {least:.4g} mm, below "
        text += f"{needed:g}; use a larger arm_eye_mm or arm_hub_mm, or a smaller arm_bore_mm, "
        refuse_size(least < needed, "arm_bore_mm", f"{text}pin_mm or lock_bolt_mm")
        return Plate("arm", "ARM", arm.outline, holes, high - sizes.thick.arm, high)

    def crank_with(self, arm: bool) -> Member:
        """Return the crank; its locking sector stands on the arm."""
        size, sizes, thick = self.mechanism.spec.size, self.sizes, self.sizes.thick
        stands, plate = -size.allowances.pin_gap_mm, self.arm_plate if arm else None
        members = [Member(plate)] if plate else []
        ends, centres = (stands - thick.arm, thick.wheel), [(sizes.arm, 0.0)]
        members += rollers(self.mechanism, centres, sizes.pin, *ends)
        sector = rack.locking_sector(sizes)
        if sector is not None:
            holes, high = tuple(rack.lock_bolts(size, sizes)), stands + thick.lock
            members.append(Member(Plate("locking sector", "CRANK", sector, holes, stands, high)))
        # the roller is on the rack's side
        return Member(Group("crank", tuple(members)), (sizes.arm, 0.0), math.pi)

    @cached_property
    def gear_pair(self) -> tuple[Member, ...]:
        """The noncircular gears that turn the crank, up to their pitch curves."""
        return gear_pair(self, None, self.sizes.bore)

    @cached_property
    def guide(self) -> tuple[Member, ...]:
        """Rail, wall and cover of the guide."""
        self._require_built()
        sizes, place = self.sizes, self.sizes.guide
        _, top, *_ = heights(self.mechanism, sizes)
        x, bar, slide, half = place.back, place.bar, place.slide, place.half
        text = f"use a smaller one: a guide that the rack always covers would be {2.0 * half:.4g} "
        text += f"mm long, and its screws need {2.0 * bar:.4g}"
        refuse_size(half < bar, "roller_radius_mm", text, sizes.roller)
        over = sizes.thick.wheel + self.mechanism.spec.size.allowances.pin_gap_mm
        on_rail, on_wall = (tuple(one for one in row if one.radius) for row in _screws(sizes))
        rail = rectangle("FRAME", x + bar + slide, -half, x + 2.0 * bar + slide, half)
        wall = rectangle("FRAME", x - slide - 2.0 * bar, -half, x - slide, half)
        # the cover ends a tenth of a bar inside the edges of wall and bar
        cover = rectangle("FRAME", x - slide - 1.9 * bar, -half, x + 0.9 * bar, half)
        return (
            Member(Plate("guide rail", "FRAME", rail, on_rail, top, 0.0)),
            Member(Plate("guide wall", "FRAME", wall, on_wall, top, over)),
            Member(Plate("guide cover", "FRAME", cover, on_wall, over, over + sizes.thick.arm)),
        )

    @cached_property
    def framed(self) -> FrameAndShafts:
        """The shafts and the frame, with holes for them and the guide's screws."""
        self._require_built()
        mechanism, size, sizes = self.mechanism, self.mechanism.spec.size, self.sizes
        plain, top, _, stands = heights(mechanism, sizes)
        own, axis = list[Shaft](), (sizes.arm, 0.0)
        L = 2.0 * sizes.arm  # as a wheel of 6 slots has it
        if sizes.bore:  # the crank's shaft, up to the arm's upper face
            ends = shaft_ends(size, "crank", plain, stands)
            # the keyway is on the side of the locking sector, as in the arm
            bore = bore_of(size, "crank", sizes.bore)._replace(direction=math.pi)
            own.append(Shaft("crank's shaft", "crank", bore, *ends, axis, math.pi))
        own += gear_shafts(mechanism, None, plain, True, sizes.bore)
        axles = tuple(one.member for one in own)
        bored = shaft_holes(size, axles, top)
        if not sizes.bore:
            bored.insert(0, hole_without_shaft(mechanism.spec.shaft.crank_diameter_mm, axis, L))
        rows = zip(("guide rail", "guide wall"), _screws(sizes), strict=True)
        screwed = tuple((name, "the frame", hole) for name, row in rows for hole in row)
        within = [*bored, *(tapped(hole) for *_, hole in screwed)]
        holes = [one for one in within if one.radius]
        eye = max(L / 20.0, 3.0 * wall_min(size, L))  # it leaves walls around mounting holes
        frame, mounts = mounted_plate(holes, within, eye, (plain, top))
        screwed = screwed if _bolt(sizes) else ()
        return FrameAndShafts(frame, axles, screwed=screwed, mounts=mounts)

    def _require_built(self) -> None:
        """Raise GenevaError where the crank's shaft has no bearing in the frame."""
        if reason := self.mechanism.spec.no_parts:
            raise GenevaError(reason, ("drive", "kind"))

    @property
    def screws(self) -> tuple[Screwed, ...]:
        """The screws of locking sector, guide bar, and what is fixed to the frame."""
        spec = self.mechanism.spec
        bolts = rack.lock_bolts(spec.size, self.sizes) if self.arm_plate else []
        own = [("locking sector", "the arm", hole) for hole in bolts]
        own += [("rack", "nuts under the guide bar", hole) for hole in self._bar_bolts]
        return (*own, *(() if spec.no_parts else self.framed.screws))

    @property
    def standing(self) -> tuple[Member, ...]:
        """The parts that stand still."""
        return (*self.guide, self.frame)

    @property
    def members(self) -> tuple[Member, ...]:
        """All parts; behind links those that move."""
        moving = self.wheel, self.bar, self.crank
        framed = not self.mechanism.spec.no_parts
        return (*moving, *self.gear_pair, *self.shafts, *self.standing) if framed else moving

    def by_name(self) -> Iterator[NamedParts]:
        """Yield all parts in the order of a list, as names and functions that build them."""
        yield "rack", lambda: [self.wheel.part]
        yield "guide bar", lambda: [self.bar.part]
        yield "crank", lambda: [self.crank.part]
        unbuilt = self.mechanism.spec.no_parts
        yield "gears", lambda: [] if unbuilt else [one.part for one in self.gear_pair]
        yield "shafts", lambda: [one.part for one in self.shafts]
        yield "guide", lambda: [one.part for one in self.guide]
        yield "frame", lambda: [self.frame.part]


def heights(mechanism: Mechanism, sizes: rack.RackSizes) -> tuple[float, float, float, float]:
    """Return heights along the crank's axis, mm; 0 is the rack's lower face.

    They are the lower face of a frame of plain shafts, its upper face, the lower face of what is on
    the crank's shaft (the arm, or gears below it), and the upper face of the arm.
    """
    stands = 0.0 - mechanism.spec.size.allowances.pin_gap_mm  # no -0.0
    low = gear_span(mechanism, None)[0] if mechanism.spec.gears else stands - sizes.thick.arm
    top = low - mechanism.spec.size.washer_mm
    return top - sizes.thick.arm, top, low, stands


def _screws(sizes: rack.RackSizes) -> list[tuple[Circle, ...]]:
    """Return three screws' holes in rail and in wall; of no width where no screw is so thin."""
    place, r = sizes.guide, _bolt(sizes)
    far = place.half - 0.5 * place.bar  # half a bar's width from the ends
    rows = place.back + 1.5 * place.bar + place.slide, place.back - place.slide - place.bar
    return [tuple(Circle("BORE", (x, y), r) for y in (-far, 0.0, far)) for x in rows]


def _bolt(sizes: rack.RackSizes) -> float:
    return bolt_radius(None, 2.0 * sizes.arm, 0.5 * sizes.guide.bar)


def rack_stressed(mechanism: Mechanism) -> Stressed:
    """Return the dimensions of the parts of a machine that their strength depends on."""
    spec, size, sizes = mechanism.spec, mechanism.spec.size, rack.rack_sizes(mechanism)
    _, _, low, stands = heights(mechanism, sizes)
    (deep, _, thick, _), bore, bend = sizes.thick, sizes.bore, NO_ARM
    contact = value_or(size.face_width_mm, deep)
    if bore:
        arm, bored = rack.crank_arm(size, sizes), reach_or_bore(size, "crank", bore)
        offset = 0.5 * (contact + thick) - stands
        bend = ArmDimensions(sizes.arm, arm.hub, arm.eye, bored, arm.pins[0].radius, thick, offset)
    crank = shaft_of(spec, "crank", bore, 0.5 * deep - (low - size.washer_mm), thick)
    key = key_of(size.crank_keyway, bore, thick)
    no_shaft = ShaftSize(math.nan, math.nan)
    return Stressed(contact, 2.0 * sizes.pin, no_shaft, crank, bend, NO_KEY, key)


def horn_sizes(mechanism: Mechanism) -> tuple[float, float]:
    """Return half the slot's width and the recess's radius, NaN for a rack that cannot be cut."""
    try:
        sizes = rack.rack_sizes(mechanism)
    except GenevaError:  # the check of the parts reports the error
        return math.nan, math.nan
    return sizes.half_width, sizes.recess
