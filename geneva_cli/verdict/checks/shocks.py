"""The forces of shocks with the worst of the tolerances, and the torque that stops the wheel."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.numerics.roots import Falsi
from geneva_cli.spec.tables import Tolerance
from geneva_cli.verdict.checks.check import Check, compared

if TYPE_CHECKING:
    from geneva_cli.loads.impacts.impacts import Impact
    from geneva_cli.loads.strength.pin import PinSize


def entry_shock(name: str, mechanism: Mechanism) -> Check | None:
    """The impact at entry if R/L is wrong and the roller does not enter along its slot."""
    tolerance = mechanism.spec.tolerance
    if not (tolerance.crank_radius_mm or tolerance.center_distance_mm):
        return None
    from geneva_cli.loads.impacts.impacts import entry_impacts

    impact = entry_impacts(mechanism, pin=_pin(mechanism)).only
    if impact is None:
        return None
    check = _force_check(name, mechanism, impact)
    if check.passes is not False:
        return check
    return check._replace(reason=partial(_tolerable, mechanism, check))


def reversal_shock(name: str, mechanism: Mechanism) -> Check | None:
    """The impact where the roller changes from one wall of its slot to the other.

    None if neither a limit nor tolerances ask for it: the pin's stress has it in any case.
    """
    spec = mechanism.spec
    limit, tolerance = spec.limits.pin_force_max_N, spec.tolerance
    if limit is None and tolerance == Tolerance(distribution=tolerance.distribution):
        return None
    if mechanism.unbalanced:
        why = "not computed where a body off its axis moves a wheel on a carrier"
        return Check(name, None, "at most", limit, None, why)
    impact = _reversal(mechanism)
    if impact is None:
        return None
    check = _force_check(name, mechanism, impact)
    if check.passes is None:
        return check._replace(why=f"{check.why}; {drag_words(mechanism)}")
    return _without_change(check, mechanism)


def reversal_stress(name: str, mechanism: Mechanism) -> Check | None:
    """The contact stress of the impact at a change of sides, where ``[limits]`` bounds it."""
    limit = mechanism.spec.limits.contact_stress_max_MPa
    impact = None if limit is None else _reversal(mechanism)
    if limit is None or impact is None or impact.contact_stress_MPa is None:
        return None
    stress = impact.contact_stress_MPa
    return _without_change(compared(name, stress, "at most", limit, impact.at_deg), mechanism)


def _reversal(mechanism: Mechanism) -> Impact | None:
    from geneva_cli.loads.impacts.impacts import reversal_impacts

    return reversal_impacts(mechanism, _pin(mechanism)).only


def _without_change(check: Check, mechanism: Mechanism) -> Check:
    """The check, and what prevents the change of sides if it fails."""
    return check if check.passes else check._replace(reason=partial(drag_words, mechanism))


def drag_words(mechanism: Mechanism) -> str:
    """The remedy for the change of sides, in words.

    If one roller starts the wheel and another stops it, a drag would take the wheel off the second
    one, so less clearance is advised.
    """
    if any(engagement.paired for engagement in mechanism.engagements):
        return "a smaller slot_clearance_mm reduces it"
    from geneva_cli.loads.impacts.change_of_sides import lasting_drag_Nm

    # the last digits of a short number are rounding
    drag = to_digits(lasting_drag_Nm(mechanism) * (1.0 - 1e-9), 3, math.ceil)
    return f"a drag of {drag:g} N m on the wheel prevents the change of sides"


def _pin(mechanism: Mechanism) -> PinSize | None:
    from geneva_cli.verdict.quantities.batch_designs import single
    from geneva_cli.verdict.quantities.under_load import drawn_pin

    return drawn_pin(single(mechanism))


def _force_check(name: str, mechanism: Mechanism, impact: Impact) -> Check:
    """The impact's force, compared with the limit of the pin force if there is one."""
    limit = mechanism.spec.limits.pin_force_max_N
    if impact.force_N is not None and limit is not None:
        return compared(name, impact.force_N, "at most", limit, impact.at_deg)
    spec, lacks = mechanism.spec, []
    if not spec.is_loaded:
        lacks.append("inertia_kgm2 in [load]")
    if impact.force_N is None and spec.size.face_width_mm is None:
        lacks.append("face_width_mm in [size]")
    if limit is None:
        lacks.append("pin_force_max_N in [limits]")
    why = f"the wheel's speed jumps by {impact.jump:.4g} of the input's; to judge it, set "
    return Check(
        name, impact.force_N, "at most", limit, None, why + ", ".join(lacks), at_deg=impact.at_deg
    )


def _tolerable(mechanism: Mechanism, check: Check) -> str:
    """The fraction to which the tolerances on R and L must shrink, whose root the force follows."""
    from geneva_cli.loads.impacts.impacts import entry_impacts

    limit, pin = check.limit or 0.0, _pin(mechanism)

    def spare(fraction: float) -> float:
        impact = entry_impacts(mechanism, fraction, pin).only
        return limit - (impact.force_N or 0.0 if impact else 0.0)

    force = Falsi(0.0, limit, 1.0, limit - (check.value or 0.0))
    for _ in range(60):  # about ten are enough, except where the force jumps
        if force.bad - force.good <= 1e-11 * force.good:  # of which two digits are shown
            break
        fraction = force.middle()
        force.add(fraction, spare(fraction))
    low = force.good
    tolerance = mechanism.spec.tolerance
    names = [
        f"{key} = {to_digits(low * value * (1.0 + 1e-9), 2, math.floor):g}"
        for key, value in (
            ("crank_radius_mm", tolerance.crank_radius_mm),
            ("center_distance_mm", tolerance.center_distance_mm),
        )
        if value
    ]
    return " and ".join(names) + " in [tolerance]"


def stopping_torque(name: str, mechanism: Mechanism) -> Check | None:
    """The resisting torque, limited by the wheel's inertia; None for slots with two walls."""
    if not mechanism.engagements[0].paired:
        return None
    from geneva_cli.loads.impacts.arrival import arrival

    stop = arrival(mechanism)
    if stop is None:
        return None
    check = compared(name, stop.torque_Nm, "at most", stop.most_Nm)
    if check.passes or stop.most_Nm > 0.0:
        return check
    return check._replace(why="no inertia carries the wheel on: set inertia_kgm2 in [load]")
