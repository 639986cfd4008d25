"""Stresses of loaded parts against what their steel allows, and their life against limits."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.spec.load_limits import LIMITED
from geneva_cli.verdict.checks.all_checks import LIMITS, check_named
from geneva_cli.verdict.checks.check import Check, compared

if TYPE_CHECKING:
    from geneva_cli.verdict.strength import Strength


class Bound(NamedTuple):
    """A limit of the spec, and the whole names of quantities: the limited one, and others.

    ``allowed`` is the limit of the default steel, ``size`` and ``least`` the size on which the
    stress depends, and its least value while all other sizes stay. A stress that ``spreads`` is in
    inverse proportion to the contact's width. One that ``shears`` is limited by its allowable
    shear, too.
    """

    limit: str  # table.key
    quantity: str
    place: str = ""  # the quantity with its input angle
    must_be: str = "at most"
    allowed: str = ""
    what: str = ""  # the size, in words
    size: str = ""
    least: str = ""
    held: str = ""  # what the least value depends on and a default may change, in words
    spreads: bool = False
    shears: bool = False


def _part(
    limit: str, part: str, what: str = "", size: str = "", stress: str = "stress_MPa"
) -> Bound:
    """The bound of a part's stress, which has a default limit."""
    name = f"strength.{part}"
    place = f"{name}.at_deg" if part in ("horn", "wheel_shaft", "crank_shaft") else ""
    sizes = (f"{name}.{size}", f"{name}.least_{size}") if size else ("", "")
    return Bound(limit, f"{name}.{stress}", place, "at most", f"{name}.allowed_MPa", what, *sizes)


# A change of one size moves others, such as bores and overhangs by load.
AS_DRAWN = "with the other parts as they are"
BOUNDS = {
    "pv_max_W_m2": Bound("limits.pv_max_W_m2", LIMITED["pv_max_W_m2"]),
    # L10
    "roller_life_min_h": Bound(
        "limits.roller_life_min_h", LIMITED["roller_life_min_h"], must_be="at least"
    ),
    # Archard's depth
    "slot_wear_max_mm_per_million": Bound(
        "limits.slot_wear_max_mm_per_million", LIMITED["slot_wear_max_mm_per_million"]
    ),
    "pin_stress_MPa": _part("material.roller.stress_max_MPa", "pin", "pin_mm", "diameter_mm"),
    # under the roller
    "horn_stress_MPa": _part("material.wheel.stress_max_MPa", "horn")._replace(spreads=True),
    # under the torque that the lock holds
    "lock_horn_stress_MPa": Bound(
        "material.wheel.stress_max_MPa",
        "strength.lock.horn_stress_MPa",
        allowed="strength.horn.allowed_MPa",
        spreads=True,
    ),
    # between disc and recess: on the recess's end, or between the arcs
    "lock_stress_max_MPa": Bound("limits.lock_stress_max_MPa", "strength.lock.greatest_MPa"),
    # the wheel turns by the lock's play, the contact's approach and the horn's bending
    "lock_deflection_max_deg": Bound(
        "limits.lock_deflection_max_deg", "strength.lock.deflection_deg"
    ),
    # shear stresses, by the ASME code
    "wheel_shaft_stress_MPa": _part(
        "shaft.shear_stress_max_MPa", "wheel_shaft", "the wheel's shaft", "diameter_mm"
    )._replace(held=AS_DRAWN),
    "crank_shaft_stress_MPa": _part(
        "shaft.shear_stress_max_MPa", "crank_shaft", "the crank's shaft", "diameter_mm"
    )._replace(held=AS_DRAWN),
    "arm_stress_MPa": _part(
        "material.wheel.stress_max_MPa", "arm", "arm_thickness_mm", "thickness_mm"
    )._replace(held="with these bores"),
    # on a key's sides
    **{
        f"{key}_pressure_MPa": _part(
            "material.wheel.stress_max_MPa", key, "the key", "length_mm", "pressure_MPa"
        )._replace(shears=True)
        for key in ("wheel_key", "crank_key")
    },
}


def strength_limit(name: str, mechanism: Mechanism) -> Check | None:
    """A limited value of strength or life; None without a limit, or without the part.

    Loaded parts are limited by the spec, or else by their default steel. It is not proved if a key
    is missing.
    """
    bound = BOUNDS[name]
    table, _, key = bound.limit.rpartition(".")
    own = mechanism.spec.table(table)[key]
    if own is None and not (bound.allowed and mechanism.spec.is_loaded):
        return None
    # A spec without limits or loads is checked without NumPy.
    from geneva_cli.verdict.strength import BOUND, strength

    of = strength(mechanism)
    limit = of[bound.allowed] if bound.shears or (bound.allowed and own is None) else own
    value = of[bound.quantity]
    if value is not None and limit is not None:
        at_deg = of[bound.place] if bound.place else None
        check = compared(name, value, bound.must_be, limit, at_deg)
        return check if check.passes else check._replace(reason=partial(_needed, bound, of, check))
    reason = of.reason(name)
    # without a limit in the spec, a value that needs another key is not asked for
    if reason is None or (own is None and reason != BOUND):
        return None
    return Check(name, None, bound.must_be, limit, None, f"not known: it needs {reason}")


def _needed(bound: Bound, of: Strength, check: Check) -> str:
    """The size on which a failing stress depends, and what it must be; empty if unknown."""
    if not bound.size:
        return _needed_width(of, check) if bound.spreads else ""
    size, least = of[bound.size], of[bound.least]
    if size is None:
        return ""
    needs = "no value is enough" if least is None else f"this load needs {least:.4g}"
    return f"{bound.what} is {size:.4g} mm, but {needs} {bound.held}".rstrip()


def _needed_width(of: Strength, check: Check) -> str:
    """The width of the contact that a horn needs: its stress is in inverse proportion to it."""
    width = of.contact_mm
    if width is None or not check.value or not check.limit:
        return ""
    least = width * check.value / check.limit
    return f"the contact is {width:.4g} mm wide, but this load needs {least:.4g}"


def first_stress(name: str, parts: FlatParts) -> Check | None:
    """A stress of the first of two wheels in series or of its crank; None without them or a load.

    It is the check of a machine of one wheel, made of that first pair.
    """
    if not (parts.mechanism.spec.is_loaded and parts.in_front):
        return None
    check = check_named(LIMITS, name.removeprefix("first_"), parts.front.mechanism)
    if check is None:
        return None
    # its angles are counted from another motion of the first wheel
    check = check._replace(name=name, at_deg=None)
    return check._replace(reason=partial(_of_links, check)) if check.reason else check


def _of_links(check: Check) -> str:
    """The reason of a first wheel's check, whose sizes are those of links."""
    why = check.told.why.replace("arm_thickness_mm", "link_thickness_mm")
    return why.replace("the crank's shaft", "the first crank's shaft")
