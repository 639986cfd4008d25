"""Default sizes of a spherical machine: thickness, pin, bores, hubs and arm under its load.

They follow one another as on a plane (``load_sizes``).
"""

import math
from collections.abc import Iterable
from contextlib import suppress
from functools import lru_cache
from itertools import chain, takewhile

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.spherical.ball import Ball, flat_radius, hub_about, usual_ball
from geneva_cli.kinds.spherical.horn import sphere_horns
from geneva_cli.loads.load_case import first_alike
from geneva_cli.loads.strength.horn import greatest_stress
from geneva_cli.loads.strength.lock import dwell_torque_Nm
from geneva_cli.loads.strength.part_loads import shaft_squares, single_loads
from geneva_cli.loads.strength.pin_arm_key import NO_ARM, ArmDimensions, arm_stress_MPa
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import array, value_or
from geneva_cli.numerics.tolerances import keeps, sizes_from
from geneva_cli.parts import sized_by_load as load
from geneva_cli.parts import sizes as rules
from geneva_cli.parts.machine_sizes import keys_by_load
from geneva_cli.spec.defaults import wall_min, wheel_material
from geneva_cli.study.synth.suiting import LOCK, SIZES, USUAL, with_roller


def sized_ball(mechanism: Mechanism) -> Ball | None:
    """Return the sizes of a spherical machine; None where it has no parts."""
    with suppress(GenevaError):  # the check of the parts reports the error
        return None if mechanism.spec.no_parts else ball(mechanism)
    return None


def stressed(mechanism: Mechanism) -> load.Stressed | None:
    """Return the sizes of stressed parts; None if the sizes leave no shells."""
    sizes = sized_ball(mechanism)
    return sphere_stressed(mechanism.spec, sizes) if sizes else None


def horn_sizes(mechanism: Mechanism) -> tuple[float, float, float] | None:
    """Return the angles of half a slot, the recess and the shafts; None without parts."""
    sizes = sized_ball(mechanism)
    return (sizes.half_width, sizes.recess, sizes.axes) if sizes else None


def key_sizes(mechanism: Mechanism) -> rules.KeySizes:
    """Return the sizes of a spherical machine by the keys of the spec; none without parts."""
    sizes, size = sized_ball(mechanism), mechanism.spec.size
    if sizes is None:
        return {}, ()
    lock_mm = sizes.radius_mm * math.sin(sizes.lock)
    known = {"slot_bottom_clearance_mm": sizes.bottom_mm, "lock_radius_mm": lock_mm}
    known |= {"wheel_bore_mm": 2.0 * sizes.bore_mm, "pin_mm": 2.0 * sizes.pin_mm}
    if sizes.arm_bore_mm:
        _, hub, eye, _ = sizes.arm_radii(size)
        known |= {"arm_bore_mm": 2.0 * sizes.arm_bore_mm}
        known |= {"arm_hub_mm": 2.0 * hub, "arm_eye_mm": 2.0 * eye}
    spans = {"wheel": sizes.span_mm, "lock": sizes.lock_span_mm, "arm": sizes.arm_span_mm}
    for part, (inside, outside) in spans.items():
        # the digits beyond the twelfth are rounding of the faces' radii
        known[f"{part}_thickness_mm"] = float(f"{outside - inside:.12g}")
    return known, keys_by_load(mechanism, bool(sizes.recess))


@lru_cache(maxsize=16)
def ball(mechanism: Mechanism) -> Ball:
    """Return the cached sizes of a spherical machine.

    Those that the spec leaves out are as large as its load needs; a load without a bound leaves the
    usual ones. Raises GenevaError, naming the key, where they leave no wheel or no lock.
    """
    spec, size = mechanism.spec, mechanism.spec.size
    usual = usual_ball(mechanism, size.wheel_thickness_mm)
    if not spec.is_loaded or not all(map(math.isfinite, single_loads(mechanism))):
        return usual
    if usual.recess and size.wheel_thickness_mm is None and size.face_width_mm is None:
        usual = usual_ball(mechanism, _horn_thickness_mm(mechanism, usual))
    loads, L, (inside, outside) = single_loads(mechanism), usual.radius_mm, usual.span_mm
    # the arm's eye about the pin passes the largest hub, and covers less than half of the sphere
    hub = max(usual.opening_mm, rules.LARGEST_HUB * usual.slot_end_mm)
    eye = min(usual.passing_mm(hub), 0.99 * L * (0.5 * math.pi - usual.arm))
    roller, clear = inside * math.sin(usual.roller), eye - wall_min(size, L)
    pin = load.pin_that_holds(mechanism, usual.pin_mm, outside - inside, roller, clear, loads)
    sizes, under = usual._replace(pin_mm=array(pin).item()), usual.arm_span_mm[0]

    if not sizes.arm_bore_mm or size.arm_thickness_mm is not None:
        return _crank_bored(mechanism, _wheel_bored(mechanism, sizes), True)
    # a thicker arm, up to twice the wheel, is better for a key than a thicker shaft
    for keyed in (False, True) if size.crank_keyway else (True,):
        for thick in sizes_from(outside - inside, 2.0 * (outside - inside)):
            trial = sizes._replace(arm_span_mm=(under, under + thick))
            trial = _crank_bored(mechanism, _wheel_bored(mechanism, trial), keyed)
            parts = sphere_stressed(spec, trial)
            arm_MPa = float(arm_stress_MPa(parts.arm, loads.wheel_N))
            key_lasts = load.key_holds(spec, parts.crank_key, loads.crank_Nm)
            if key_lasts and keeps(arm_MPa, "at most", wheel_material(spec).allowed_MPa):
                return trial
    return trial


def _horn_thickness_mm(mechanism: Mechanism, usual: Ball) -> float:
    """Return the wheel's thickness at which its horns hold, at most twice the usual one."""
    allowed = wheel_material(mechanism.spec).allowed_MPa
    angles = usual.half_width, usual.recess, usual.axes
    least = usual.span_mm[1] - usual.span_mm[0]
    # a thicker wheel bends its pins more than its horns
    for thick in sizes_from(least, 2.0 * least):
        stress_MPa = array(greatest_stress(sphere_horns, mechanism, (*angles, thick)).stress_MPa)
        if keeps(max(0.0, stress_MPa.item()), "at most", allowed):  # it is NaN without a load
            break
    return thick


def _wheel_bored(mechanism: Mechanism, ball: Ball) -> Ball:
    """Return the sizes with a bore of the wheel whose shaft and key hold."""
    spec, L, size, end = mechanism.spec, ball.radius_mm, mechanism.spec.size, ball.slot_end_mm
    fixed = size.wheel_bore_mm is not None or spec.shaft.wheel_diameter_mm is not None
    if fixed or not ball.bore_mm:
        return ball
    # a hub with flat faces stays in its shell, a hundredth short of the outer sphere
    widest = min(end - wall_min(size, L), 0.99 * flat_radius(*ball.span_mm))
    most = min(end * 2.0 / 3.0, rules.within_hub(size, "wheel"))
    held = spec.shaft.torsion_factor * dwell_torque_Nm(mechanism).item()
    bores = (0.5 * d for d in sizes_from(2.0 * ball.bore_mm, 2.0 * most, bores=True)[1:])
    trials = (ball._replace(bore_mm=r, hub_mm=hub_about(size, L, r, end)) for r in bores)
    fitting = takewhile(lambda trial: trial.hub_mm <= widest, trials)
    return _held(mechanism, "wheel", chain((ball,), fitting), held)


def _crank_bored(mechanism: Mechanism, ball: Ball, keyed: bool) -> Ball:
    """Return the sizes with a bore of the arm whose shaft holds, and if ``keyed`` its key."""
    spec, size = mechanism.spec, mechanism.spec.size
    own = (size.arm_bore_mm, spec.shaft.crank_diameter_mm)
    if not ball.arm_bore_mm or any(key is not None for key in own):
        return ball
    under, over = ball.arm_span_mm
    wall = wall_min(size, ball.radius_mm)

    def fits(trial: Ball) -> bool:
        # the standard has no keys for the largest shafts
        parts = sphere_stressed(spec, trial)
        if size.crank_keyway is not None and math.isnan(float(parts.crank_key.shaft)):
            return False
        # the arm's hub fits: about its bore, in the arm, and past pins and wheel
        bored, hub, _, cap = trial.arm_radii(size)
        hole = math.asin(min(1.0, rules.hole_radius(size, trial.pin_mm) / under))
        to_pins = under * math.sin(max(0.0, trial.arm - hole - wall / under))
        passing = trial.arm + trial.passing_mm(trial.opening_mm) / trial.radius_mm
        within = bored + wall <= hub <= min(to_pins, 0.99 * flat_radius(under, over))
        return within and cap <= passing

    bores = sizes_from(2.0 * ball.arm_bore_mm, over, bores=True)[1:]
    fitting = takewhile(fits, (ball._replace(arm_bore_mm=0.5 * d) for d in bores))
    return _held(mechanism, "crank", chain((ball,), fitting), keyed=keyed)


def _held(
    mechanism: Mechanism, part: str, trials: Iterable[Ball], held: float = 0.0, keyed: bool = True
) -> Ball:
    """Return the first sizes whose shaft, and key, of a part hold, or else the last.

    The equivalent torque is at least ``held``, N m.
    """
    torque = getattr(single_loads(mechanism), f"{part}_Nm")
    for trial in trials:
        parts = sphere_stressed(mechanism.spec, trial)
        lever = getattr(parts, f"{part}_shaft").overhang
        squares = shaft_squares(first_alike(mechanism), {part: lever})
        moment = max(math.sqrt(squares[part].max.item()) if squares else 0.0, held)
        if load.shaft_and_key_hold(mechanism.spec, part, parts, moment, torque, keyed):
            break
    return trial


def sphere_stressed(spec: Spec, ball: Ball) -> load.Stressed:
    """Return the dimensions of a spherical machine's parts."""
    size, L, (under, over) = spec.size, ball.radius_mm, ball.arm_span_mm
    thick, arm, bore = over - under, NO_ARM, ball.arm_bore_mm
    end = ball.shafts_end_mm(size) - L, thick
    if bore:
        middle, (bored, _, eye, cap) = 0.5 * (under + over), ball.arm_radii(size)
        hole, off = rules.hole_radius(size, ball.pin_mm), middle - L * math.cos(ball.arm)
        radii = L * ball.arm, middle * cap, middle * eye / L, bored, hole
        arm = ArmDimensions(*radii, thick, off)
    contact = value_or(size.face_width_mm, ball.span_mm[1] - ball.span_mm[0])
    on_wheel = load.shaft_of(spec, "wheel", ball.bore_mm, *end)
    on_crank = load.shaft_of(spec, "crank", bore, *end)
    in_wheel = load.key_of(size.wheel_keyway, ball.bore_mm, ball.hub_length_mm(size))
    in_arm = load.key_of(size.crank_keyway, bore, thick)
    return load.Stressed(contact, 2.0 * ball.pin_mm, on_wheel, on_crank, arm, in_wheel, in_arm)


def ball_roller(mechanism: Mechanism) -> tuple[float, str]:
    """Return the largest usual roller that suits, NaN for the spec's; or the obstacle to parts."""
    L, spec = mechanism.center_distance_mm, mechanism.spec
    least, why = wall_min(spec.size, L), ""
    given = spec.size.roller_radius_mm
    for r in (0.01 * percent * L for percent in USUAL) if given is None else (given,):
        try:
            shells = ball(mechanism._replace(spec=with_roller(spec, r)))
        except GenevaError as error:
            why = LOCK if error.key == ("size", "lock_radius_mm") else SIZES
            continue
        why = LOCK if shells.lock and shells.horn * L < least else ""
        if not why:
            return math.nan if given or r == 0.01 * USUAL[0] * L else r, ""
    return math.nan, why
