"""Impacts, the product, stresses and life against limits of the spec or the default steel."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator
from functools import partial
from typing import TYPE_CHECKING

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import to_digits
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.parts import Parts
from geneva_cli.spec.tables import LIMITED
from geneva_cli.verdict.checks import FIRST, Check, compared, unknown

if TYPE_CHECKING:  # a spec without limits or loads is checked without NumPy
    from geneva_cli.verdict.strength import Strength

# Each limited quantity of strength and life: the key that limits it, its whole name, but for the
# greatest stress of the lock, and the loaded part whose default steel limits it without that key.
_DEFLECTION = "limits.lock_deflection_max_deg"
_WHEEL, _SHAFT = "material.wheel.stress_max_MPa", "shaft.shear_stress_max_MPa"
BOUNDS = {
    "pv_max_W_m2": ("limits.pv_max_W_m2", LIMITED["pv_max_W_m2"], ""),
    "roller_life_min_h": ("limits.roller_life_min_h", LIMITED["roller_life_min_h"], ""),
    "pin_stress_MPa": ("material.roller.stress_max_MPa", "strength.pin.stress_MPa", "pin"),
    "horn_stress_MPa": (_WHEEL, "strength.horn.stress_MPa", "horn"),
    "lock_horn_stress_MPa": (_WHEEL, "strength.lock.horn_stress_MPa", "horn"),
    "lock_stress_max_MPa": ("limits.lock_stress_max_MPa", "", ""),
    "lock_deflection_max_deg": (_DEFLECTION, "strength.lock.deflection_deg", ""),
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


def shocks(names: Collection[str], parts: Parts) -> Iterator[Check]:
    """Impacts, where tolerances or limits ask for them: the pin's stress has them in any case."""
    mechanism, spec = parts.mechanism, parts.mechanism.spec
    limits = spec.limits
    misplaced = spec.tolerance.crank_radius_mm or spec.tolerance.center_distance_mm
    if misplaced and "entry_shock_N" in names:
        # R/L is wrong, and the roller does not enter along its slot
        yield from _force_check("entry_shock_N", mechanism, "shock.entry")
    most_MPa = limits.contact_stress_max_MPa
    # where the roller changes from one wall of its slot to the other
    if limits.pin_force_max_N is not None or spec.tolerance.is_given:
        yield from _force_check("reversal_shock_N", mechanism, "shock.reversal", _drag)
    if most_MPa is not None:
        from geneva_cli.verdict.strength import strength

        of, words = strength(mechanism), partial(_drag, mechanism)
        if (stress := of["shock.reversal.contact_stress_MPa"]) is not None:
            place = "at most", most_MPa, of["shock.reversal.at_deg"]
            yield compared("reversal_stress_MPa", stress, *place, reason=words)
    if mechanism.engagements[0].paired and "stopping_torque_Nm" in names:
        from geneva_cli.loads.impacts.reversal import arrival

        if stop := arrival(mechanism):
            torque_Nm, most_Nm = stop
            why = "no inertia carries the wheel on: set inertia_kgm2 in [load]"
            words = partial(str, "" if most_Nm > 0.0 else why)
            yield compared("stopping_torque_Nm", torque_Nm, "at most", most_Nm, reason=words)


def _drag(mechanism: Mechanism) -> str:
    """The remedy for the change of sides, in words."""
    if any(engagement.paired for engagement in mechanism.engagements):
        return "a smaller slot_clearance_mm reduces it"
    from geneva_cli.loads.impacts.reversal import lasting_drag_Nm

    # the last digits of a short number are rounding
    drag = to_digits(lasting_drag_Nm(mechanism) * (1.0 - 1e-9), 3, math.ceil)
    return f"a drag of {drag:g} N m on the wheel prevents the change of sides"


def _force_check(
    name: str, mechanism: Mechanism, shock: str, remedy: Callable[[Mechanism], str] | None = None
) -> Iterator[Check]:
    """An impact's force, if there is one, compared with the limit of the pin force."""
    from geneva_cli.verdict.strength import strength

    spec, limit = mechanism.spec, mechanism.spec.limits.pin_force_max_N
    names, words = ("jump", "force_N", "at_deg"), remedy and partial(remedy, mechanism)
    jump, force_N, at_deg = (strength(mechanism)[f"{shock}.{name}"] for name in names)
    if jump is None:
        return
    if force_N is not None and limit is not None:
        yield compared(name, force_N, "at most", limit, at_deg, reason=words)
        return
    lacks = [] if spec.is_loaded else ["inertia_kgm2 in [load]"]
    if force_N is None and spec.size.face_width_mm is None:
        lacks.append("face_width_mm in [size]")
    if limit is None:
        lacks.append("pin_force_max_N in [limits]")
    why = f"the wheel's speed jumps by {jump:.4g} of the input's; to judge it, set "
    why += ", ".join(lacks)
    why += f"; {words()}" if words else ""
    yield Check(name, force_N, "at most", limit, None, why, at_deg)


def strength_limits(names: Collection[str], parts: Parts) -> Iterator[Check]:
    """Limited values of strength and life; none without a limit, or without the part."""
    mechanism = parts.mechanism
    for name in names:
        whole, quantity, part = BOUNDS[name]
        table, _, key = whole.rpartition(".")
        limit = own = mechanism.spec.table(table)[key]
        if own is None and not (part and mechanism.spec.is_loaded):
            continue
        from geneva_cli.verdict.strength import BOUND, strength

        of = strength(mechanism)
        # a key's allowable shear limits it, too
        if part and (own is None or part.endswith("_key")):
            limit = of[f"strength.{part}.allowed_MPa"]
        value = of[quantity] if quantity else of.lock_MPa
        must_be = "at least" if name == "roller_life_min_h" else "at most"
        if value is not None and limit is not None:
            placed = name in ("horn_stress_MPa", "wheel_shaft_stress_MPa", "crank_shaft_stress_MPa")
            at_deg = of[f"strength.{part}.at_deg"] if placed else None
            needed = partial(_needed, part, value, limit, of)
            yield compared(name, value, must_be, limit, at_deg, reason=needed)
        # without a limit in the spec, a value that needs another key is not asked for
        elif (reason := of.reason(name)) and (own is not None or reason == BOUND):
            yield unknown(name, f"not known: it needs {reason}", must_be, limit)


def _needed(part: str, value: float, limit: float, of: Strength) -> str:
    """The size on which a stress depends, and what it must be; empty if unknown."""
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


def first_stresses(names: Collection[str], parts: FlatParts) -> Iterator[Check]:
    """Stresses of the first of two loaded wheels in series, and of its crank."""
    if not (parts.mechanism.spec.is_loaded and parts.in_front):
        return
    for name in names:
        for check in strength_limits([name.removeprefix(FIRST)], parts.front):
            # its angles are counted from another motion of the first wheel, and its sizes are of
            # links
            why = check.why.replace("arm_thickness_mm", "link_thickness_mm")
            why = why.replace("the crank's shaft", "the first crank's shaft")
            yield check._replace(name=name, at_deg=None, why=why)
