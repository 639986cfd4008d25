"""All parts of a spherical machine at their positions, at input angle 0, and its wheel's mass.

The sphere's centre is the origin and the wheel's axis is z. The crank's parts are in its frame.
"""

from collections.abc import Iterator
from typing import ClassVar

from geneva_cli.errors import refuse_size
from geneva_cli.geometry import plates
from geneva_cli.geometry.plates import Group, MassProperties, Member, Plate, Shell
from geneva_cli.geometry.shapes import ORIGIN, Circle
from geneva_cli.geometry.sphere import POLE, Cap, axis_frame, place
from geneva_cli.geometry.sphere_arcs import RoundHole, polar
from geneva_cli.kept import cached_property
from geneva_cli.kinds.spherical import regions
from geneva_cli.kinds.spherical.ball import Ball, refuse_wide
from geneva_cli.kinds.spherical.gaps import BallGaps, SpherePairs
from geneva_cli.kinds.spherical.sizes import ball
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.assembly import assembly
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.projection import NamedParts
from geneva_cli.parts.shafts.arm_and_shafts import Shaft, shaft_ends
from geneva_cli.parts.shafts.bores import Bore, bore_of, has_shape
from geneva_cli.parts.sizes import refuse_bored_hub
from geneva_cli.parts.turn.turned_parts import TurnedShape
from geneva_cli.spec.defaults import wheel_material
from geneva_cli.spec.tables import Size


class SphereParts(Parts):
    """The parts of a machine in the wheel's frame."""

    LAID_FLAT: ClassVar[tuple[str, ...]] = ("wheel", "crank")

    @cached_property
    def shape(self) -> TurnedShape:
        """Wheel and crank as they are turned. Raises GenevaError where the sizes leave none."""
        own, where = ball(self.mechanism), assembly(self.mechanism, flat=False)
        locks = regions.sectors(own)
        return TurnedShape(where, own.lengths, locks, BallGaps(where, own, locks))

    @property
    def ball(self) -> Ball:
        """The sizes, as angles on the sphere and radii."""
        ball: Ball = self.shape.gaps.ball
        return ball

    @property
    def outside_mm(self) -> float | None:
        """Radius of the wheel's outer face, from which heights count inwards."""
        return self.ball.span_mm[1]

    def pairs(self, target: float) -> SpherePairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""
        return SpherePairs(self.shape.gaps, self.shape.crank, target)

    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far a motion's roller is in its slot, beyond the mouth's corners, mm, (n,)."""
        pins = self.shape.gaps.pose(at).pins[:, motion]  # as far from the axis in the wheel's frame
        return self.ball.radius_mm * (self.ball.mouth - polar(pins))

    @cached_property
    def wheel(self) -> Member:
        """The wheel's shell with its hub. Raises GenevaError for one that cannot be made."""
        size, ball = self.mechanism.spec.size, self.ball
        hub, shell = wheel_hub(size, ball), wheel_shell(ball)
        return Member(Group("wheel", (Member(shell), *([Member(hub)] if hub else []))))

    @cached_property
    def arm(self) -> regions.CapArm | None:
        """The crank arm; None without pins for the rollers."""
        if not self.ball.arm_bore_mm:
            return None
        return regions.crank_arm(self.ball, self.shape.crank, self.mechanism.spec.size)

    @cached_property
    def crank(self) -> Member:
        """The crank: locking sectors, arm, rollers on their pins."""
        ball, size, arm = self.ball, self.mechanism.spec.size, self.arm
        sectors, members = self.shape.crank, []
        each = len(arm.bolts) // len(sectors) if arm and sectors else 0
        for k, region in enumerate(sectors):
            bolts = arm.bolts[k * each : (k + 1) * each] if arm else ()
            sector = Shell("locking sector", "CRANK", (region,), *ball.lock_span_mm, bolts)
            members.append(Member(sector))
        if arm:
            cap = Shell("arm", "ARM", (arm.boundary,), *ball.arm_span_mm, arm.holes)
            hub, bore = Circle("ARM", ORIGIN, arm.hub), arm.bore.hole()
            hub_plate = Plate("arm's hub", "ARM", hub, (bore,), *ball.arm_span_mm)
            members += [Member(cap), Member(hub_plate)]
        bored = ball.pin_mm + 0.5 * size.allowances.shaft_fit_mm
        hole = (RoundHole(POLE, bored),) if arm else ()
        roller = Shell("roller", "ROLLER", (Cap(POLE, ball.roller).region,), *ball.span_mm, hole)
        across = Circle("ROLLER", ORIGIN, ball.pin_mm)
        pin = Plate("pin", "ROLLER", across, (), ball.span_mm[0], ball.arm_span_mm[1])
        for azimuth in ball.rollers:
            frame = axis_frame(place(ball.arm, azimuth))
            members += [Member(one, frame=frame) for one in ((roller, pin) if arm else (roller,))]
        return Member(Group("crank", tuple(members)), frame=regions.at_mid_motion(ball))

    @cached_property
    def shafts(self) -> tuple[Member, ...]:
        """The shafts of wheel and crank: as wide as the bores, and as long as on a plane."""
        ball, size, arm = self.ball, self.mechanism.spec.size, self.arm
        (inside, outside), (under, over) = ball.span_mm, ball.arm_span_mm
        lowest = outside - ball.shafts_end_mm(size) - (over - under)
        own, members = list[tuple[str, Bore, float, float]](), list[Member]()
        if ball.bore_mm:
            hub = ball.hub_mm > ball.bore_mm
            bore = bore_of(size, "wheel", ball.bore_mm)._replace(direction=ball.half_step)
            own.append(("wheel", bore, lowest if hub else 0.0, outside - inside))
        if arm:
            own.append(("crank", arm.bore, lowest, outside - under))
        for part, bore, low, high in own:
            ends = shaft_ends(size, part, low, high)
            plate = Shaft(f"{part}'s shaft", part, bore, *ends, ORIGIN).member.plate
            # heights become distances inwards
            inwards = plate._replace(low=outside - plate.high, high=outside - plate.low)
            frame = None if part == "wheel" else regions.at_mid_motion(ball)
            members.append(Member(inwards, frame=frame))
        return tuple(members)

    @property
    def members(self) -> tuple[Member, ...]:
        """All parts."""
        return (self.wheel, self.crank, *self.shafts)

    def by_name(self) -> Iterator[NamedParts]:
        """Yield all parts in the order of a list, as names and functions that build them."""
        yield "wheel", lambda: [self.wheel.part]
        yield "crank", lambda: [self.crank.part]
        yield "shafts", lambda: [one.part for one in self.shafts]


def wheel_shell(ball: Ball) -> Shell:
    """Return the wheel's shell, down to the round hole about its axis, if there is one."""
    holes = (RoundHole(POLE, ball.opening_mm),) if ball.opening_mm else ()
    return Shell("wheel", "WHEEL", tuple(regions.wheel_regions(ball)), *ball.span_mm, holes)


def wheel_hub(size: Size, ball: Ball) -> Plate | None:
    """Return the wheel's hub: in its shell and outside it, by default out to the arm's face."""
    wide = ball.hub_mm > ball.bore_mm
    name = "wheel_bore" if size.wheel_keyway is None else "wheel_keyway"
    text = f"{name}: on a sphere only the wheel's hub has a bore that is not round; set "
    text += f"wheel_bore_mm and wheel_hub_mm, or remove {name}"
    refuse_size(has_shape(size, "wheel") and not (wide and ball.bore_mm), name, text)
    if not wide:
        return None
    inside, outside = ball.span_mm
    refuse_wide("wheel_hub_mm", ball.hub_mm, inside, outside)
    form = bore_of(size, "wheel", ball.bore_mm)
    refuse_bored_hub("wheel", ball.hub_mm, form.reach, ball.bore_mm)
    bored = (form.shape("BORE", ball.half_step),) if ball.bore_mm else ()
    span = inside, inside + ball.hub_length_mm(size)
    return Plate("wheel's hub", "HUB", Circle("HUB", ORIGIN, ball.hub_mm), bored, *span)


def shell_body(mechanism: Mechanism) -> MassProperties:
    """Return mass and inertia of the wheel's shell and hub, in closed form."""
    size, sizes = mechanism.spec.size, ball(mechanism)
    both = wheel_shell(sizes), wheel_hub(size, sizes)
    density = wheel_material(mechanism.spec).density_kgm3
    return plates.mass_properties(filter(None, both), density)


def screw_sizes(mechanism: Mechanism) -> dict[str, float]:
    """Return the screws of locking sectors by keys of ``[size]``: their number, and holes, mm."""
    parts = SphereParts(mechanism)
    arm, sectors = parts.arm, len(parts.shape.crank)
    if not (arm and sectors):
        return {}
    holes = {"lock_bolt_mm": 2.0 * arm.bolts[0].radius} if arm.bolts else {}
    return {"lock_bolts": len(arm.bolts) // sectors, **holes}
