"""Gear-Geneva: the roller sits on a planet that rolls on a fixed sun, or in a fixed ring.

With the carrier R0 at phi the roller is at R0 e^(i phi) + rp e^(i c phi), c = 1 + u on a sun and
1 - u in a ring, u = fixed teeth / planet teeth. It enters its slot without shock at an extreme of
this trochoid, where both arms are in line: u = 2z/(z-2), R0 - rp = L sin b. The jump at entry is
(R0 - c² rp)/(L cos b), zero for rp = L sin b/(c² - 1); rp < 0 lowers the peak instead.
"""

from __future__ import annotations

from typing import Annotated, NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.drives import Plan
from geneva_cli.machine.engagement import Anchor, SlotDriven
from geneva_cli.machine.wheels import poses as gearing
from geneva_cli.machine.wheels.classic import gap, half_motion_deg
from geneva_cli.numerics.jet import Coefficient, Jet, sine_versine
from geneva_cli.spec.rules import OneOf, Range
from geneva_cli.spec.tables import Spec


class Keys(NamedTuple):
    """The keys that ``kind = "epicyclic"`` adds."""

    planet_ratio: Annotated[
        float | str,
        Range(-0.4, 0.4),
        'planet crank rp / L, either sign; "shockless" for no jump at entry',
    ]
    fixed: Annotated[str, OneOf(("sun", "ring")), "fixed gear that the planet rolls on"] = "sun"


def plan(spec: Spec) -> Plan:
    """The one station of a gear-Geneva, the planet's arm pointing outwards at mid-motion."""
    keys, wheel = spec.kind, spec.wheel
    assert isinstance(keys, Keys)
    if wheel.z not in (3, 4, 6):
        raise GenevaError(
            f"z = {wheel.z}: the planet comes round once a turn only where 2z/(z-2) is whole; "
            "z must be 3, 4 or 6",
            ("wheel", "z"),
        )
    step = gearing.Step(1, wheel.z)
    teeth = 2 * wheel.z // (wheel.z - 2)
    c = 1.0 + teeth if keys.fixed == "sun" else 1.0 - teeth
    l, cos_b = step.sin_cos
    rp = l / (c * c - 1.0) if keys.planet_ratio == "shockless" else float(keys.planet_ratio)
    _refuse_reach(l, rp, teeth, c)
    R0 = l + rp
    half = half_motion_deg("external", *step)

    def both(slope: float, bend: float, planet: float) -> tuple[tuple[float, float], ...]:
        return ((R0 * slope, R0 * bend), (planet * slope, planet * bend))

    # At the ends the planet's arm points back along the carrier, at mid-motion outwards.
    anchors = (
        _anchor(-half, -step.b, cos_b, -1.0, 0.0, both(1.0, 1.0, -rp), c),
        _anchor(0.0, 0.0, gap("external", *step) - 2.0 * rp, 0.0, 1.0, both(1.0, 1.0, rp), c),
        _anchor(half, step.b, cos_b, 1.0, 0.0, both(1.0, -1.0, -rp), c),
    )
    station = SlotDriven(0.0, step.b, anchors)
    station.crank_sense = 1.0
    # The roller sits on the planet, which turns c times as fast as the carrier.
    station.body = lambda tau, order: Jet((tau * 0.0 - c, *[0.0] * order))
    return Plan(station, R0 + rp, spec.size)


def _anchor(
    input_deg: float,
    wheel: float,
    along: float,
    radial: float,
    level: float,
    arms: tuple[tuple[float, float], ...],
    c: float,
) -> Anchor:
    """A pose of carrier and planet; ``radial`` is the sense of their speed along the ray."""

    def displacement(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
        u: Jet | None = None
        v: Jet | None = None
        for (slope, bend), rate in zip(arms, (1.0, c), strict=True):
            turn = Jet.variable(tau, order) * rate
            sine, versine = sine_versine(turn)
            # On the ray's own axes: at the ends the speed is along it, at mid-motion across.
            du = sine * (slope * radial) + versine * (bend * level)
            dv = sine * (slope * level) + versine * (bend * (1.0 - level))
            u, v = (du, dv) if u is None or v is None else (u + du, v + dv)
        assert u is not None and v is not None
        return u, v

    return Anchor(input_deg, wheel, along, displacement)


def _refuse_reach(l: float, rp: float, teeth: int, c: float) -> None:
    """Raise GenevaError where the wheel would start backwards or the roller leave its slot.

    Forward from rest: R0 >= c² rp. Into the slot at entry: R0 > c rp. Forward at mid-motion:
    R0 + c rp > 0, where R0 = l + rp.
    """
    most = l / (c * c - 1.0)
    least = -l / (1.0 + c) if c > 0.0 else -l / teeth
    if not least < rp <= most:
        raise GenevaError(
            f"planet_ratio = {rp:.6g}: the wheel would turn back, or the roller leave its slot; it "
            f"must be above {least:.6g} and at most {most:.6g} (shockless)",
            ("drive", "planet_ratio"),
        )
