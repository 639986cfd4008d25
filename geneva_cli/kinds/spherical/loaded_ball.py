"""Default sizes of a spherical machine under a load: thickness, pin, bores, hubs and arm.

They follow one another as on a plane (``load_sizes``).
"""

from __future__ import annotations

import math
from functools import lru_cache, partial
from itertools import takewhile

from geneva_cli.kinds.spherical.ball import Ball, hub_about, inner_edge
from geneva_cli.kinds.spherical.horn import sphere_horns
from geneva_cli.loads.strength.arm_strength import NO_ARM, ArmDimensions
from geneva_cli.loads.strength.horn_search import single_stress
from geneva_cli.loads.strength.lock import dwell_torque_Nm
from geneva_cli.loads.strength.part_loads import PartLoads, greatest, single_loads
from geneva_cli.loads.strength.shaft_stress import (
    LoadedShaft,
    ShaftForces,
    crank_forces,
    shafts_under_load,
    wheel_forces,
)
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.preferred import bores_from, rounded_from
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.parts.sized_by_load import (
    arm_that_holds,
    first_that,
    key_holds,
    pin_that_holds,
    shaft_holds,
)
from geneva_cli.parts.sizes import arm_hub, hole_radius, largest_hub, within_hub
from geneva_cli.parts.stressed import Stressed, key_of, shaft_of
from geneva_cli.spec.default_sizes import half_or, value_or
from geneva_cli.spec.least_wall import eye_about, wall_min
from geneva_cli.spec.materials import wheel_material


def horn_thickness_mm(mechanism: Mechanism, usual: Ball) -> float | None:
    """Return the wheel's thickness at which its horns hold, at most twice the usual one.

    None where the spec has a thickness, or nothing bends a horn: then it stays as it is.
    """
    size = mechanism.spec.size
    fixed = size.wheel_thickness_mm is not None or size.face_width_mm is not None
    if fixed or not usual.recess or not all(map(math.isfinite, single_loads(mechanism))):
        return None
    allowed = wheel_material(mechanism.spec).allowed_MPa
    angles = usual.half_width, usual.recess, usual.axes
    least = usual.span_mm[1] - usual.span_mm[0]

    def holds(thick: float) -> bool:
        def bent_MPa(way: Mechanism) -> float:
            horn = single_stress(sphere_horns, way, angles, thick).single
            return horn.stress_MPa if horn else 0.0

        return keeps(greatest(bent_MPa, mechanism), "at most", allowed)

    # a thicker wheel bends its pins more than its horns
    return first_that(rounded_from(least, 2.0 * least), holds)


def sphere_load_sizes(mechanism: Mechanism, usual: Ball) -> Ball:
    """Return the sizes of a machine under its load, from the usual ones.

    A load without a bound leaves all sizes.
    """
    loads, spec, L = single_loads(mechanism), mechanism.spec, usual.radius_mm
    if not all(map(math.isfinite, loads)):
        return usual
    inside, outside = usual.span_mm
    thick = outside - inside
    # the arm's eye about the pin passes the largest hub, and covers less than half of the sphere
    hub = max(usual.opening_mm, largest_hub(inside * math.sin(min(usual.slot_end, 0.5 * math.pi))))
    eye = min(usual.passing_mm(hub), 0.99 * L * (0.5 * math.pi - usual.arm))
    roller, clear = inside * math.sin(usual.roller), eye - wall_min(spec.size, L)
    pin = pin_that_holds(mechanism, usual.pin_mm, thick, roller, clear, loads)
    ball, under = usual._replace(pin_mm=pin), usual.arm_span_mm[0]

    def trial(keyed: bool, arm: float | None) -> Ball:
        one = ball._replace(arm_span_mm=(under, under + arm)) if arm else ball
        return _crank_bored(mechanism, _wheel_bored(mechanism, one, loads), loads, keyed)

    if not ball.arm_bore_mm or spec.size.arm_thickness_mm is not None:
        return trial(True, None)
    return arm_that_holds(spec, thick, trial, partial(sphere_stressed, spec), loads)


def _wheel_bored(mechanism: Mechanism, ball: Ball, loads: PartLoads) -> Ball:
    """Return the sizes with a bore of the wheel whose shaft and key hold."""
    spec, L = mechanism.spec, ball.radius_mm
    size = spec.size
    fixed = size.wheel_bore_mm is not None or spec.shaft.wheel_diameter_mm is not None
    if fixed or not ball.bore_mm:
        return ball
    inside, outside = ball.span_mm
    end = inside * math.sin(min(ball.slot_end, 0.5 * math.pi))
    held = spec.shaft.torsion_factor * dwell_torque_Nm(mechanism).item()

    def bored(d: float) -> Ball:
        hub = hub_about(size, L, 0.5 * d, end)
        hole = math.asin(min(1.0, max(0.5 * d, hub) / inside))
        inner = inner_edge(ball.slot_end, ball.roller, hole)
        return ball._replace(bore_mm=0.5 * d, hub_mm=hub, inner=inner)

    def holds(trial: Ball) -> bool:
        parts = sphere_stressed(spec, trial)
        moment = _moment_Nm(mechanism, wheel_forces(mechanism), parts.wheel_shaft.overhang)
        shaft = shaft_holds(spec, "wheel", parts.wheel_shaft.diameter, max(moment, held))
        return shaft and key_holds(spec, parts.wheel_key, loads.wheel_Nm)

    # a hub with flat faces stays in its shell, a hundredth short of the outer sphere
    flat = 0.99 * math.sqrt((outside - inside) * (outside + inside))
    widest = min(end - wall_min(size, L), flat)
    most = min(end * 2.0 / 3.0, within_hub(size, "wheel"))
    each = map(bored, bores_from(2.0 * ball.bore_mm, 2.0 * most))
    return first_that(takewhile(lambda one: one.hub_mm <= widest, each), holds, ball)


def _crank_bored(mechanism: Mechanism, ball: Ball, loads: PartLoads, keyed: bool) -> Ball:
    """Return the sizes with a bore of the arm whose shaft holds, and if ``keyed`` its key."""
    spec, size = mechanism.spec, mechanism.spec.size
    own = (size.crank_bore_mm, size.arm_bore_mm, spec.shaft.crank_diameter_mm)
    if not ball.arm_bore_mm or any(key is not None for key in own):
        return ball

    def fits(trial: Ball) -> bool:
        # the standard has no keys for the largest shafts
        key = sphere_stressed(spec, trial).crank_key
        keyless = size.crank_keyway is not None and math.isnan(float(key.shaft))
        wider = trial.arm_bore_mm > ball.arm_bore_mm
        return not wider or (not keyless and _hub_fits(spec, trial))

    def holds(trial: Ball) -> bool:
        parts = sphere_stressed(spec, trial)
        moment = _moment_Nm(mechanism, crank_forces(spec), parts.crank_shaft.overhang)
        shaft = shaft_holds(spec, "crank", parts.crank_shaft.diameter, moment)
        return shaft and (not keyed or key_holds(spec, parts.crank_key, loads.crank_Nm))

    bores = bores_from(2.0 * ball.arm_bore_mm, ball.arm_span_mm[1])
    each = (ball._replace(arm_bore_mm=0.5 * d) for d in bores)
    return first_that(takewhile(fits, each), holds)


def _hub_fits(spec: Spec, ball: Ball) -> bool:
    """Return True if the arm's hub fits: about its bore, in the arm, and past pins and wheel."""
    size, (under, over) = spec.size, ball.arm_span_mm
    wall, bored = wall_min(size, ball.radius_mm), reach_or_bore(size, "crank", ball.arm_bore_mm)
    hub = arm_hub(size, bored, ball.arm_bore_mm, wall)
    hole = math.asin(min(1.0, hole_radius(size, ball.pin_mm) / under))
    to_pins = under * math.sin(max(0.0, ball.arm - hole - wall / under))
    flat = 0.99 * math.sqrt((over - under) * (over + under))
    passing = ball.arm + ball.passing_mm(ball.opening_mm) / ball.radius_mm
    cap = ball.cap(hub, bored, wall)
    return bored + wall <= hub <= min(to_pins, flat) and cap <= passing


@lru_cache(maxsize=64)
def _moment_Nm(mechanism: Mechanism, forces: ShaftForces, overhang_mm: float) -> float:
    """Return the greatest equivalent torque of a shaft; it needs a search of the whole cycle."""
    shaft = LoadedShaft(forces, overhang_mm)

    def moment_Nm(way: Mechanism) -> float:
        (one,) = shafts_under_load(way, [shaft])
        return one["moment_Nm"].item() if one else 0.0

    return greatest(moment_Nm, mechanism)


def sphere_stressed(spec: Spec, ball: Ball) -> Stressed:
    """Return the dimensions of a spherical machine's parts."""
    size = spec.size
    (inside, outside), (under, over) = ball.span_mm, ball.arm_span_mm
    end = (ball.shafts_end_mm(size) - ball.radius_mm, over - under)
    return Stressed(
        value_or(size.face_width_mm, outside - inside),
        2.0 * ball.pin_mm,
        shaft_of(spec, "wheel", ball.bore_mm, *end),
        shaft_of(spec, "crank", ball.arm_bore_mm, *end),
        _arm(spec, ball),
        key_of(size.wheel_keyway, ball.bore_mm, ball.hub_length_mm(size)),
        key_of(size.crank_keyway, ball.arm_bore_mm, over - under),
    )


def _arm(spec: Spec, ball: Ball) -> ArmDimensions:
    """Return the dimensions of the flat arm that stands for the bent one; NaN without an arm."""
    size, L = spec.size, ball.radius_mm
    if not ball.arm_bore_mm:
        return NO_ARM
    middle, thick = 0.5 * sum(ball.arm_span_mm), ball.arm_span_mm[1] - ball.arm_span_mm[0]
    wall, hole = wall_min(size, L), hole_radius(size, ball.pin_mm)
    bored = reach_or_bore(size, "crank", ball.arm_bore_mm)
    cap = ball.cap(arm_hub(size, bored, ball.arm_bore_mm, wall), bored, wall)
    eye = half_or(size.arm_eye_mm, eye_about(hole, wall, ball.passing_mm(ball.opening_mm)))
    offset = middle - L * math.cos(ball.arm)
    rows = L * ball.arm, middle * cap, middle * eye / L, bored, hole, thick, offset
    return ArmDimensions(*rows)
