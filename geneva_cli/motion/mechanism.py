"""The machine of a design: its engagements over a full period, built from a spec."""

from __future__ import annotations

import math
from operator import attrgetter
from typing import NamedTuple

from geneva_cli.kept import load_named
from geneva_cli.motion import compatible
from geneva_cli.motion.drive import Plan
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.laws.law import Law
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.pivots import FIRST, AxisPlace, Layout, Pivot, ShaftPlace, wheel_places
from geneva_cli.motion.registry import IN_FRONT
from geneva_cli.motion.wheels.gearing import Output
from geneva_cli.numerics.angles import sin_cos_pi
from geneva_cli.numerics.arrays import Whole, all_true, choose, choose_record, larger, library
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG

_AS_BUILT = (
    "the crank is taken as built: the wheel is at rest until the roller's centre crosses its "
    "slot's axis, while real parts touch before"
)


class Mechanism(NamedTuple):
    """A Geneva mechanism."""

    spec: Spec
    # One for each kind of motion in a period. Rollers that all move the wheel alike share one, and
    # the period is then one index.
    engagements: tuple[Engagement, ...]
    period_deg: float  # input angle after which the sequence of engagements repeats
    ratio: float  # l = R/L
    rollers_max: int  # most evenly spaced rollers that do not jam
    center_distance_mm: float  # L, from the spec or solved for
    # The numbers of m designs of a batch, (m, 1): it keeps its size if nothing else varies.
    design: int | Whole
    plan: Plan  # of the drive, with engagements by the angle of its own input shaft
    law: Law | None  # by the angle of the drive's own input shaft; None for straight slots
    output: Output  # what the wheel gives out, with its unit
    axes: tuple[Pivot, ...]  # of wheel and crank in the plane of the parts; none if they meet
    # of a wheel that turns the crank: its slots, and its distance from its own crank
    first_wheel: tuple[int, float] | None
    frame: float  # turns of the wheel's frame in a turn of the input: 0 but on a carrier
    wheel_places: tuple[AxisPlace, ...]  # more than one only on a carrier
    crank_places: tuple[AxisPlace, ...]  # about the wheel: several with ``crank_steps``
    no_turn: str  # the reason why the full turn of drawn parts has no meaning; empty if it has one

    @property
    def designs(self) -> int:
        """Number of designs in the batch; 1 for a single design."""
        return 1 if isinstance(self.design, int) else len(self.design)

    @property
    def crank_shaft(self) -> ShaftPlace:
        """The crank's shaft, which turns against an external wheel and with an internal one."""
        sense = self.engagements[0].crank_sense or self.spec.wheel.SIGN
        return ShaftPlace(self.center_distance_mm, -sense)

    @property
    def own_shaft(self) -> ShaftPlace:
        """The input shaft of the drive itself, which a drive before it turns."""
        spec = self.spec
        return spec.drive.input_shaft(self.plan, spec.wheel.SIGN, self.crank_shaft.sense)

    @property
    def gear_shaft(self) -> ShaftPlace:
        """The shaft of the driven one of noncircular gears."""
        before = self.spec.drive_before
        return self.own_shaft if before and before.gears else self.crank_shaft

    @property
    def layout(self) -> Layout:
        """Pivots and dimensions of the drives, and the axes of all cranks behind the first.

        Pivots have places only in a plane that also has the axes of wheel and crank.
        """
        spec, plan = self.spec, self.plan
        own = spec.drive.layout(plan, spec.wheel.SIGN)
        for place in self.crank_places[1:]:
            own = (*own, Pivot(f"axis of crank {place.number}", *place.at))
        if spec.drive_before:
            shift, names = self.own_shaft.x_mm - self.center_distance_mm, {one.name for one in own}
            for one in spec.drive_before.layout(plan, spec.wheel.SIGN):
                here = one._replace(name=f"first {one.name}" if one.name in names else one.name)
                if isinstance(here, Pivot):
                    here = here._replace(x_mm=here.x_mm + shift)
                own = (*own, here)
        return own if self.axes else tuple(one for one in own if not isinstance(one, Pivot))

    @property
    def roller_radius_mm(self) -> float:
        """Roller radius r in millimetres, by default L/20."""
        return self.spec.size.roller_radius(self.center_distance_mm)

    @property
    def lasting_deg(self) -> float:
        """The period with its stops, as the angle that the input would turn meanwhile."""
        stop_deg = 6.0 * self.spec.drive.n_rpm * self.spec.drive.stop_s  # of one dwell
        return self.period_deg + len(self.engagements) * stop_deg

    def shown_deg(self, input_deg: float) -> float:
        """Input angle for display: between -180 and 180 degrees from mid-motion.

        Over a period of several turns it is counted from the first engagement's entry.
        """
        whole = 360.0 * self.spec.turns
        m = library(input_deg, whole)
        entry = self.engagements[0].mid_deg + self.engagements[0].entry_deg
        # Rounding may put an angle just before the entry: count it as the entry.
        periods = m.floor((input_deg - entry + SAME_INPUT_DEG) / whole)
        counted = larger(input_deg - periods * whole, entry)
        if isinstance(input_deg, (float, int)) and isinstance(whole, float):
            return math.remainder(input_deg, whole) if whole == 360.0 else counted
        # as math.remainder, and exact for angles of a few turns
        near: float = input_deg - 360.0 * m.rint(input_deg / 360.0)
        return choose(whole == 360.0, near, counted)

    @property
    def under_load(self) -> Mechanism:
        """The machine with the period of its loads: up to the entry of the next wheel."""
        wheels = self.spec.drive.wheels_on_carrier
        return self._replace(period_deg=360.0 / wheels) if wheels > 1 else self

    def dwell_deg(self, i: int) -> float:
        """Input angle in degrees from the exit of engagement i to the next entry."""
        here = self.engagements[i]
        after = self.engagements[(i + 1) % len(self.engagements)]
        turns = self.period_deg if i + 1 == len(self.engagements) else 0.0
        dwell = turns + (after.mid_deg + after.entry_deg) - (here.mid_deg + here.exit_deg)
        # Rollers may follow each other without a dwell; then only rounding is left.
        out: float = choose(abs(dwell) > 1e-9, dwell, 0.0)
        return out


def build(spec: Spec, like: Mechanism | None = None) -> Mechanism:
    """Build the mechanism of a spec, which takes the engagements of ``like`` if it moves alike.

    Raises GenevaError, naming the key, if the values do not make a machine together.
    """
    compatible.refuse_conflicts(spec)
    radius, given = spec.size.crank_radius_mm, spec.size.center_distance_mm
    if like and spec.moving == like.spec.moving:
        plan, own = Plan(*like[1:6]), like.plan
    else:
        built = None
        if radius is not None and given is not None and spec.motion is None:
            built = _as_built(spec, radius, given)
        plan = own = built or spec.drive.plan(spec.wheel, spec.motion, spec.given_distance_mm)
        if spec.drive_before:
            plan = load_named(IN_FRONT)(plan, spec, spec.drive_before)
            own = plan._replace(engagements=tuple(map(attrgetter("own"), plan.engagements)))
    L, wheel, wheels = plan.center_distance_mm, spec.wheel, spec.drive.wheels_on_carrier
    compatible.refuse_sizes(spec, L, plan.ratio)
    if spec.tolerance is not Spec.tolerance:  # whose deviations are all 0
        compatible.refuse_tolerances(spec, L, plan.ratio)
    cranks, steps = [], spec.drive.cranks
    for k, step in enumerate(steps):
        sine, cosine = sin_cos_pi(2 * int(step), wheel.z)
        turn, behind_deg = math.tau * step / wheel.z, 360.0 * k / len(steps)
        cranks.append(AxisPlace(k + 1, behind_deg, turn, (L * cosine, L * sine)))
    return Mechanism(
        spec,
        *plan,
        design=0,
        plan=own,
        law=spec.motion.law if spec.motion else None,
        output=spec.output,
        axes=wheel.axes(L),
        first_wheel=None if spec.drive.direct else spec.drive.first_wheel(L),
        frame=wheel.SIGN if wheels else 0.0,
        wheel_places=wheel_places(wheels, wheel.SIGN, L) if wheels > 1 else (FIRST,),
        crank_places=tuple(cranks),
        no_turn=_AS_BUILT if plan.engagements[0].built else "",
    )


def _as_built(spec: Spec, radius: float, L: float) -> Plan | None:
    """The plan of a crank as built, whose R/L is not what the slots need; None for any other."""
    wheel = spec.wheel
    derived = wheel.place(wheel.step, L)
    off = abs(radius / L - derived.ratio) > compatible.SAME_RATIO
    if not all_true(off) and (isinstance(off, bool) or not off.any()):
        return None
    from geneva_cli.motion.wheels.as_built import as_derived

    rim = spec.size.wheel_radius_mm
    if rim is None:  # that of a machine as derived
        away, r = L * wheel.step.sin_cos[1], spec.size.roller_radius(L)
        rim = library(away, r).hypot(away, r)
    place = wheel.as_built(radius / L, rim / L, L)
    if place is None:
        return None
    if not isinstance(off, bool):  # designs with the R/L of their slots are machines as derived
        place = choose_record(off, place, as_derived(derived))
    return spec.drive.as_built(wheel, place, L)
