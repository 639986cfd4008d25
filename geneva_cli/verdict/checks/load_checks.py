"""Loads, impacts, stresses and life against limits of the spec, or of the default steel."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.numerics.roots import boundary
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.spec.tables import LIMITED
from geneva_cli.verdict.checks.check import Check, compared

if TYPE_CHECKING:  # a spec without limits or loads is checked without NumPy
    from geneva_cli.loads.impacts.shock_force import Impact
    from geneva_cli.loads.strength.pin import PinSize


def limited_load(name: str, mechanism: Mechanism) -> Check | None:
    """The load that a key of ``[limits]`` bounds, and its input angle."""
    limit = mechanism.spec.limits.as_dict()[name]
    if limit is None:
        return None
    from geneva_cli.verdict.quantities.batch_designs import number_of, single
    from geneva_cli.verdict.quantities.load_quantities import greatest

    peaks, load = single(mechanism).columns(greatest), LIMITED[name].split(".")[1]
    most, at_deg = (number_of(peaks[f"{load}.{end}"], 0) for end in ("max", "at_deg"))
    return compared(name, most, "at most", limit, at_deg)


def product(name: str, mechanism: Mechanism) -> Check | None:
    """The product's greatest acceleration, or the friction that holds it, where it is bounded."""
    spec = mechanism.spec
    limit = spec.limits.product_acceleration_max_m_s2
    if name == "product_slip":
        limit = spec.product.friction if spec.support.axis == "vertical" else None
    if limit is None:
        return None
    from geneva_cli.verdict.quantities.batch_designs import single
    from geneva_cli.verdict.quantities.motion_quantities import product_motion_of

    motion = single(mechanism).once(product_motion_of)
    assert motion is not None  # the spec refuses limit and friction without the product's place
    most, at_deg = motion.acceleration_m_s2
    value = motion.friction_needed if name == "product_slip" else most
    return compared(name, value.item(), "at most", limit, at_deg.item())


def entry_shock(name: str, mechanism: Mechanism) -> Check | None:
    """The impact at entry if R/L is wrong and the roller does not enter along its slot."""
    tolerance = mechanism.spec.tolerance
    if not (tolerance.crank_radius_mm or tolerance.center_distance_mm):
        return None
    from geneva_cli.loads.impacts.entry import entry_impacts

    pin = _pin(mechanism)
    impact = entry_impacts(mechanism, pin=pin).only
    if impact is None:
        return None
    check = _force_check(name, mechanism, impact)

    def tolerable() -> str:
        """The tolerances, reduced by one fraction, with which the force is at its limit."""

        def holds(fraction: float) -> bool:
            reduced = entry_impacts(mechanism, fraction, pin).only
            return reduced is None or (reduced.force_N or 0.0) <= (check.limit or 0.0)

        low, given = boundary(holds, 0.0, 1.0, 40), tolerance.as_dict()  # two digits are shown
        names = [
            f"{key} = {to_digits(low * given[key] * (1.0 + 1e-9), 2, math.floor):g}"
            for key in ("crank_radius_mm", "center_distance_mm")
            if given[key]
        ]
        return " and ".join(names) + " in [tolerance]"

    return check._replace(reason=tolerable) if check.passes is False else check


def reversal_shock(name: str, mechanism: Mechanism) -> Check | None:
    """The impact where the roller changes from one wall of its slot to the other.

    None if neither a limit nor tolerances ask for it: the pin's stress has it in any case.
    """
    spec = mechanism.spec
    if spec.limits.pin_force_max_N is None and not spec.tolerance.is_given:
        return None
    impact = _reversal(mechanism)
    if impact is None:
        return None
    check = _force_check(name, mechanism, impact)
    if check.passes is None:
        return check._replace(why=f"{check.why}; {drag_words(mechanism)}")
    return check if check.passes else check._replace(reason=partial(drag_words, mechanism))


def reversal_stress(name: str, mechanism: Mechanism) -> Check | None:
    """The contact stress of the impact at a change of sides, where ``[limits]`` bounds it."""
    limit = mechanism.spec.limits.contact_stress_max_MPa
    impact = None if limit is None else _reversal(mechanism)
    if limit is None or impact is None or impact.contact_stress_MPa is None:
        return None
    check = compared(name, impact.contact_stress_MPa, "at most", limit, impact.at_deg)
    return check if check.passes else check._replace(reason=partial(drag_words, mechanism))


def _reversal(mechanism: Mechanism) -> Impact | None:
    from geneva_cli.loads.impacts.reversal import reversal_impacts

    return reversal_impacts(mechanism, _pin(mechanism)).only


def drag_words(mechanism: Mechanism) -> str:
    """The remedy for the change of sides, in words.

    If one roller starts the wheel and another stops it, a drag would take the wheel off the second
    one, so less clearance is advised.
    """
    if any(engagement.paired for engagement in mechanism.engagements):
        return "a smaller slot_clearance_mm reduces it"
    from geneva_cli.loads.impacts.reversal import lasting_drag_Nm

    # the last digits of a short number are rounding
    drag = to_digits(lasting_drag_Nm(mechanism) * (1.0 - 1e-9), 3, math.ceil)
    return f"a drag of {drag:g} N m on the wheel prevents the change of sides"


def _pin(mechanism: Mechanism) -> PinSize | None:
    from geneva_cli.verdict.quantities.batch_designs import single
    from geneva_cli.verdict.quantities.under_load import drawn_pin

    return drawn_pin(single(mechanism))


def _force_check(name: str, mechanism: Mechanism, impact: Impact) -> Check:
    """The impact's force, compared with the limit of the pin force if there is one."""
    spec, limit = mechanism.spec, mechanism.spec.limits.pin_force_max_N
    if impact.force_N is not None and limit is not None:
        return compared(name, impact.force_N, "at most", limit, impact.at_deg)
    lacks = [] if spec.is_loaded else ["inertia_kgm2 in [load]"]
    if impact.force_N is None and spec.size.face_width_mm is None:
        lacks.append("face_width_mm in [size]")
    if limit is None:
        lacks.append("pin_force_max_N in [limits]")
    why = f"the wheel's speed jumps by {impact.jump:.4g} of the input's; to judge it, set "
    why += ", ".join(lacks)
    return Check(name, impact.force_N, "at most", limit, None, why, impact.at_deg)


def stopping_torque(name: str, mechanism: Mechanism) -> Check | None:
    """The resisting torque, limited by the wheel's inertia; None for slots with two walls."""
    if not mechanism.engagements[0].paired:
        return None
    from geneva_cli.loads.impacts.reversal import arrival

    stop = arrival(mechanism)
    if stop is None:
        return None
    torque_Nm, most_Nm, _ = stop
    check = compared(name, torque_Nm, "at most", most_Nm)
    if check.passes or most_Nm > 0.0:
        return check
    return check._replace(why="no inertia carries the wheel on: set inertia_kgm2 in [load]")


# Each limited quantity of strength and life: the key that limits it, its whole name, and the loaded
# part whose default steel limits it if the spec does not.
_WHEEL, _SHAFT = "material.wheel.stress_max_MPa", "shaft.shear_stress_max_MPa"
BOUNDS = {
    **{
        name: (f"limits.{name}", LIMITED[name], "") for name in ("pv_max_W_m2", "roller_life_min_h")
    },
    "pin_stress_MPa": ("material.roller.stress_max_MPa", "strength.pin.stress_MPa", "pin"),
    "horn_stress_MPa": (_WHEEL, "strength.horn.stress_MPa", "horn"),
    "lock_horn_stress_MPa": (_WHEEL, "strength.lock.horn_stress_MPa", "horn"),
    "lock_stress_max_MPa": ("limits.lock_stress_max_MPa", "strength.lock.greatest_MPa", ""),
    "lock_deflection_max_deg": (
        *("limits.lock_deflection_max_deg", "strength.lock.deflection_deg", ""),
    ),
    "wheel_shaft_stress_MPa": (_SHAFT, "strength.wheel_shaft.stress_MPa", "wheel_shaft"),
    "crank_shaft_stress_MPa": (_SHAFT, "strength.crank_shaft.stress_MPa", "crank_shaft"),
    "arm_stress_MPa": (_WHEEL, "strength.arm.stress_MPa", "arm"),
    "wheel_key_pressure_MPa": (_WHEEL, "strength.wheel_key.pressure_MPa", "wheel_key"),
    "crank_key_pressure_MPa": (_WHEEL, "strength.crank_key.pressure_MPa", "crank_key"),
}
# The size on which a part's stress depends, its name, and what must stay: a change of one size
# moves others, such as bores and overhangs by load.
_DRAWN = "with the other parts as they are"
SIZES = {
    "pin": ("diameter_mm", "pin_mm", ""),
    "wheel_shaft": ("diameter_mm", "the wheel's shaft", _DRAWN),
    "crank_shaft": ("diameter_mm", "the crank's shaft", _DRAWN),
    "arm": ("thickness_mm", "arm_thickness_mm", "with these bores"),
    "wheel_key": ("length_mm", "the key", ""),
    "crank_key": ("length_mm", "the key", ""),
}


def strength_limit(name: str, mechanism: Mechanism) -> Check | None:
    """A limited value of strength or life; None without a limit, or without the part.

    Loaded parts are limited by the spec, or else by their default steel. It is not proved if a key
    is missing.
    """
    whole, quantity, part = BOUNDS[name]
    table, _, key = whole.rpartition(".")
    limit = own = mechanism.spec.table(table)[key]
    if own is None and not (part and mechanism.spec.is_loaded):
        return None
    from geneva_cli.verdict.strength import BOUND, strength

    of = strength(mechanism)
    # a key's allowable shear limits it, too
    if part and (own is None or part.endswith("_key")):
        limit = of[f"strength.{part}.allowed_MPa"]
    value, must_be = of[quantity], "at least" if name == "roller_life_min_h" else "at most"
    if value is None or limit is None:
        reason = of.reason(name)
        # without a limit in the spec, a value that needs another key is not asked for
        if reason is None or (own is None and reason != BOUND):
            return None
        return Check(name, None, must_be, limit, None, f"not known: it needs {reason}")
    placed = name in ("horn_stress_MPa", "wheel_shaft_stress_MPa", "crank_shaft_stress_MPa")
    at_deg = of[f"strength.{part}.at_deg"] if placed else None
    check = compared(name, value, must_be, limit, at_deg)

    def needed() -> str:
        """The size on which the stress depends, and what it must be; empty if unknown."""
        if part in SIZES:
            size, words, held = SIZES[part]
            now, least = of[f"strength.{part}.{size}"], of[f"strength.{part}.least_{size}"]
            if now is None:
                return ""
            needs = "no value is enough" if least is None else f"this load needs {least:.4g}"
            return f"{words} is {now:.4g} mm, but {needs} {held}".rstrip()
        # a horn's stress is in inverse proportion to the width of the contact
        if not part or of.contact_mm is None or not limit:
            return ""
        least = of.contact_mm * value / limit
        return f"the contact is {of.contact_mm:.4g} mm wide, but this load needs {least:.4g}"

    return check if check.passes else check._replace(reason=needed)


def first_stress(name: str, parts: FlatParts) -> Check | None:
    """A stress of the first of two wheels in series or of its crank; None without them or a load.

    It is the check of a machine of one wheel, made of that first pair.
    """
    if not (parts.mechanism.spec.is_loaded and parts.in_front):
        return None
    check = strength_limit(name.removeprefix("first_"), parts.front.mechanism)
    if check is None:
        return None
    # its angles are counted from another motion of the first wheel, and its sizes are of links
    why = check.with_reason.why.replace("arm_thickness_mm", "link_thickness_mm")
    why = why.replace("the crank's shaft", "the first crank's shaft")
    return check.with_reason._replace(name=name, at_deg=None, why=why)
