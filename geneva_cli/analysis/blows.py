"""The blows that a machine's roller deals at the worst of its tolerances, and their forces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.analysis.loads.contact import contact as touching
from geneva_cli.analysis.shock import changes, contact, drag_over, impact
from geneva_cli.analysis.shock_force import force_N, impulse_Nms
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.arrays import scalar

NO_LEVER = 1e-6  # of the centre distance: where the slot lies across the way nothing bounds a play


class Blow(NamedTuple):
    """A jump of the wheel's velocity over the input's, and what it costs.

    Both are None without an inertia, ``force_N`` without a ``face_width_mm`` too.
    """

    at_deg: float
    jump: float
    force_N: float | None
    moment_Nms: float | None


def entry_blow(mechanism: Mechanism, share: float = 1.0) -> Blow | None:
    """Where the crank is as wrong as its tolerances allow, times ``share``; None without any.

    The jump is negative where the wheel is struck back.
    """
    found = [
        Blow(mechanism.shown_deg(e.mid_deg + one.at_deg), one.jump, *_cost(mechanism, one.jump))
        for e in mechanism.engagements
        for crank, center in _errors(mechanism, e, share)
        if (one := contact(e, crank, center))
    ]
    return max(found, key=lambda blow: abs(blow.jump), default=None)


def _errors(
    mechanism: Mechanism, engagement: Engagement, share: float
) -> Iterator[tuple[float, float]]:
    """The largest relative errors of R and L that lie across the slot, one way and the other."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    arm = arm_mm(mechanism, engagement)
    crank = share * spec.tolerance.crank_radius_mm / arm if spec.drive.ONE_ARM else 0.0
    center = share * spec.tolerance.center_distance_mm / L if spec.wheel.FLAT else 0.0
    if crank or center:
        yield crank, -center
        yield -crank, center


def arm_mm(mechanism: Mechanism, engagement: Engagement) -> float:
    """The crank's radius at an engagement: its rollers' arms may differ."""
    L = mechanism.center_distance_mm
    if not mechanism.spec.wheel.FLAT:
        return mechanism.ratio * L
    x, y = (z.c[0] for z in engagement.path(0.0, 0))
    return L * math.hypot(x - engagement.hub, y)


def clearance_mm(mechanism: Mechanism) -> float:
    """Roller to slot, per side, of the smallest roller in the widest slot."""
    given = mechanism.spec.tolerance
    both = given.roller_diameter_mm + given.slot_width_mm
    return mechanism.spec.size.slot_clearance_mm + 0.5 * both


def reversal_blow(mechanism: Mechanism) -> Blow | None:
    """The hardest change of sides, through the largest play; None where the roller changes none.

    The play is that of the clearance at the lever where the wheel begins to coast. Without an
    inertia there is none that coasts; with a drag above ``lasting_drag_Nm`` nothing changes.
    """
    drag, clearance = drag_over(mechanism), clearance_mm(mechanism)
    found = []
    for engagement in mechanism.engagements if math.isfinite(drag) and clearance else ():
        for start in changes(engagement, drag):
            lever = abs(scalar(touching(engagement, start).lever.c[0]))
            share = clearance / (max(lever, NO_LEVER) * mechanism.center_distance_mm)
            one = impact(engagement, start, 2.0 * math.asin(min(share, 1.0)), drag)
            if one and lever > NO_LEVER:
                at_deg = mechanism.shown_deg(engagement.mid_deg + one.at_deg)
                found.append(Blow(at_deg, one.speed, *_cost(mechanism, one.speed)))
    return max(found, key=lambda blow: blow.jump, default=None)


def _cost(mechanism: Mechanism, jump: float) -> tuple[float | None, float | None]:
    moment = impulse_Nms(mechanism, jump)
    return force_N(mechanism, jump), moment or None
