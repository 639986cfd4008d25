"""Gear-Geneva: the roller sits on a planet that rolls on a fixed sun, or in a fixed ring.

With the carrier R0 at phi it is at R0 e^(i phi) + rp e^(i c phi), c = 1 + u on a sun and 1 - u in a
ring, u = fixed teeth / planet teeth. It enters without shock at an extreme, where both arms are in
line: u = 2z/(z-2), R0 - rp = L sin b. The jump is (R0 - c² rp)/(L cos b).
"""

from typing import Annotated, ClassVar, NamedTuple, cast

from geneva_cli.drives.pushed import pushed
from geneva_cli.errors import refuse_text
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.engagement import Anchor, Engagement
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.path_and_slot import AnchoredPath, RadialSlot, StraightSlotMotion
from geneva_cli.motion.pivots import Dimension, Joint, Layout, Link, Pivot, Teeth
from geneva_cli.motion.wheels.classic import PinPose, PinTravel, gap, middle
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Array, Number, choose, library
from geneva_cli.numerics.jet import Held, Jet, Loads, Vector, rotation, sin_cos, sine_versine
from geneva_cli.spec.rules import OneOf, Range


class Epicyclic(Drive, kw_only=True):
    """A planet gear carries the roller.

    ``planet_ratio`` is the planet's crank over the centre distance; with "shockless" the
    acceleration does not jump at entry. ``fixed`` is the gear that the planet rolls on.

    >>> soft = Design(External(4), Epicyclic(planet_ratio="shockless"))
    >>> abs(soft.peaks.ends.acceleration_entry) < 1e-9
    True
    """

    NAME: ClassVar[str] = "epicyclic"
    WORDS: ClassVar[str] = "a roller on a planet gear"
    round_gears: ClassVar[tuple[str, ...]] = ("planet", "fixed gear")
    planet_ratio: Annotated[
        float | str,
        Range(-0.4, 0.4, words=("shockless",)),
        'planet crank rp / L, either sign; "shockless" for no jump at entry',
    ]
    fixed: Annotated[str, OneOf(("sun", "ring")), "fixed gear that the planet rolls on"] = "sun"

    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        text = "z = {z}: the planet's path closes only if 2z/(z-2) is a whole number: z must be "
        odd = (wheel.z != 3) & (wheel.z != 4) & (wheel.z != 6)
        refuse_text(odd, ("wheel", "z"), text + "3, 4 or 6", z=wheel.z)
        step = wheel.step
        teeth = 2 * wheel.z // (wheel.z - 2)
        c = 1.0 + teeth if self.fixed == "sun" else 1.0 - teeth
        l, cos_b = step.sin_cos
        # beyond these the wheel would start backwards, or the roller leave its slot
        most, least = l / (c * c - 1.0), -l / choose(c > 0.0, 1.0 + c, teeth)
        rp = most if isinstance(self.planet_ratio, str) else self.planet_ratio
        text = "planet_ratio = {rp:.6g}: the wheel would turn back, or the roller leave its slot: "
        text += "it must be above {least:.6g} and at most {most:.6g} (shockless)"
        key, outside = ("drive", "planet_ratio"), (rp <= least) | (rp > most)
        refuse_text(outside, key, text, rp=rp, least=least, most=most)
        R0 = l + rp
        half = wheel.half_motion_deg(step)

        # At the ends the planet's arm points back along the carrier, at mid-motion outwards. A pose
        # is that of an arm of length 1.
        anchors = tuple(
            Anchor(pose.crank_deg, pose.wheel, pose.along, _Arms(pose, R0, planet, c))
            for pose, planet in (
                (PinPose(-half, -step.b, cos_b, (-1.0, 0.0), (0.0, 1.0)), -rp),
                (middle(1.0, 1.0, gap(1.0, step.p, step.q) - 2.0 * rp), rp),
                (PinPose(half, step.b, cos_b, (1.0, 0.0), (0.0, -1.0)), -rp),
            )
        )
        path = AnchoredPath(anchors)
        followed = StraightSlotMotion(path, step.b)
        # The roller sits on the planet, which turns c times as fast as the carrier.
        reactions = PlanetReactions(R0, rp, c)
        slot, body = RadialSlot(path), -c
        engagement = Engagement(0.0, path, slot, followed, body, reactions, 1.0)
        return self.planned(engagement, R0 + rp, L)

    def layout(self, plan: Plan, sign: float) -> Layout:
        reactions = cast(PlanetReactions, plan.engagements[0].reactions)
        L = plan.center_distance_mm
        R0, rp, teeth = L * reactions.R0, L * reactions.rp, abs(reactions.c - 1.0)
        planet = R0 / abs(reactions.c)
        return (
            Pivot("planet axis", L - R0, 0.0),
            Dimension("carrier R0", R0, "mm"),
            Dimension("planet crank rp", rp, "mm"),
            Dimension("fixed gear", self.fixed),
            Dimension("fixed teeth / planet teeth", teeth),
            Dimension("planet's pitch radius", planet, "mm"),
            Dimension("fixed gear's pitch radius", planet * teeth, "mm"),
        )

    def links(self, plan: Plan, sign: float, input_deg: Array) -> tuple[Link, ...]:
        reactions = cast(PlanetReactions, plan.engagements[0].reactions)
        L, still, turn = plan.center_distance_mm, 0.0 * input_deg, radians(input_deg)
        R0, rp, c = L * reactions.R0, L * reactions.rp, reactions.c
        m, axis = library(turn), (still + L, still)
        planet = L - R0 * m.cos(turn), R0 * m.sin(turn)
        roller = planet[0] - rp * m.cos(c * turn), planet[1] + rp * m.sin(c * turn)
        radius, shaft = R0 / abs(c), Joint.SHAFT
        teeth, fixed = Teeth(inside=self.fixed == "ring", fixed=True), radius * abs(c - 1.0)
        return (
            Link("carrier", (axis, planet), (shaft, shaft), 2),
            Link("planet's arm", (planet, roller), (shaft, Joint.ROLLER), 1),
            Link("planet", (planet,), (shaft,), 3, radius),
            Link("fixed gear", (axis,), (shaft,), 3, fixed, teeth),
        )


class PlanetReactions(NamedTuple):
    """Equilibrium of the planet, held by the carrier's pin and by the fixed gear at the mesh."""

    R0: float  # over L
    rp: float
    c: float

    def __call__(self, turn: Jet, path: Vector, loads: Loads) -> Held:
        """Reactions of the carrier's shaft, and of the fixed gear, to each load."""
        (s, c), (sp, cp) = sin_cos(turn), sin_cos(turn * self.c)
        planet, across = (cp * -self.rp, sp * self.rp), (s * -1.0, c * -1.0)
        return pushed(loads, planet, across, -self.R0 / self.c)


class _Arms(NamedTuple):
    """The roller's displacement from a pose, by the carrier R0 and the planet's arm rp."""

    pose: PinPose
    R0: float
    rp: float
    c: float  # the planet's rate

    def __call__(self, tau: Number, order: int) -> Vector:
        x, y = PinTravel(self.pose, rotation)(tau, order)
        u, v = PinTravel(self.pose, self._planet)(tau, order)
        return x * self.R0 + u * self.rp, y * self.R0 + v * self.rp

    def _planet(self, tau: Number, order: int) -> Vector:
        """sin d and 1 - cos d of the planet's rotation d."""
        return sine_versine(Jet.variable(tau, order) * self.c)
