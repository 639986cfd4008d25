"""The impacts of a machine's roller at the worst of its tolerances, and their forces."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.contact import contact as touching
from geneva_cli.loads.impacts.change_of_sides import changes, drag_over, impacts_of
from geneva_cli.loads.impacts.shock import (
    FirstContacts,
    Mouth,
    RestingAxis,
    first_contacts,
    mouth_contacts,
)
from geneva_cli.loads.impacts.shock_force import forces_N, impulse_Nms
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.strength.pin import PinSize
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import all_true, choose, library, only_of, parameter
from geneva_cli.numerics.jet import Array
from geneva_cli.spec.workshops import workshop


class Impact(NamedTuple):
    """A jump of the wheel's velocity over the input's, with its force and moment.

    Both are None without an inertia; ``force_N`` is None without a drawn pin too, and
    ``contact_stress_MPa`` if the roller meets a corner, or without a ``face_width_mm``.
    """

    at_deg: float
    jump: float
    force_N: float | None
    moment_Nms: float | None
    contact_stress_MPa: float | None = None


class Impacts(NamedTuple):
    """Impacts of m designs, (m,) each; NaN if there is none, or if it is not known."""

    at_deg: Array
    jump: Array
    force_N: Array
    moment_Nms: Array
    contact_stress_MPa: Array

    @property
    def only(self) -> Impact | None:
        """Impact of a single design, or None."""
        at_deg, jump, *force = only_of(self)
        return None if at_deg is None or jump is None else Impact(at_deg, jump, *force)


def entry_impacts(
    mechanism: Mechanism, fraction: float = 1.0, pin: PinSize | None = None
) -> Impacts:
    """Impacts at entry of m designs with a ``fraction`` of the cranks' greatest errors.

    Without the ``pin`` as it is drawn, forces are not known. The roller meets the slot's axis. If
    the slot is too narrow for it to enter off the axis, it meets a corner of the mouth. The jump is
    negative if the wheel is struck backwards.
    """
    best = np.full((2, 1), np.nan)
    for engagement in mechanism.engagements:
        every = [first_contacts(engagement, *e) for e in _errors(mechanism, engagement, fraction)]
        for contacts in (*every, *_on_mouth(mechanism, engagement, fraction)):
            if contacts is not None:
                best = _harder(best, _shown(mechanism, engagement, *contacts))
    return _with_force(mechanism, best, pin)


def _errors(
    mechanism: Mechanism, engagement: Engagement, fraction: float
) -> Iterator[tuple[float, float]]:
    """Greatest relative errors of R and L that act across the slot, in both directions.

    A longer crank acts as a shorter centre distance. It acts as a longer one where the slot misses
    the wheel's centre by so much that the crank's axis lies between both.
    """
    spec, L, axis = mechanism.spec, mechanism.center_distance_mm, RestingAxis.of(engagement)
    if axis is None:  # a slot that is solved for has no contacts
        return
    arm = arm_mm(mechanism, engagement)
    crank = fraction * spec.tolerance.crank_radius_mm / arm if spec.drive.ONE_ARM else 0.0
    center = fraction * spec.tolerance.center_distance_mm / L if spec.wheel.FLAT else 0.0
    between = axis.hub_offset * (axis.hub_offset + axis.engagement.slot.offset) < 0.0
    center = choose(between, -center, center)
    if not all_true((crank == 0.0) & (center == 0.0)):
        yield crank, -center
        yield -crank, center


def arm_mm(mechanism: Mechanism, engagement: Engagement) -> float:
    """Crank radius at an engagement, mm; its rollers' arms may differ."""
    L = mechanism.center_distance_mm
    if not mechanism.spec.wheel.FLAT:
        return mechanism.ratio * L
    x, y = (z.c[0] for z in engagement.path(0.0, 0))
    return parameter(L * library(x, y).hypot(x - engagement.hub, y))


def _on_mouth(
    mechanism: Mechanism, engagement: Engagement, fraction: float, recess_mm: float = 0.0
) -> list[FirstContacts | None]:
    """First contacts with the mouth's corners, for the largest roller in the narrowest slot."""
    tolerance, L = mechanism.spec.tolerance, mechanism.center_distance_mm
    clear = mechanism.spec.size.allowances.slot_clearance_mm
    lost = 0.5 * fraction * (tolerance.roller_diameter_mm + tolerance.slot_width_mm)
    spare = parameter(np.maximum(clear - lost, 0.0)) / L
    roller = mechanism.roller_radius_mm / L
    errors = _errors(mechanism, engagement, fraction)
    mouth = Mouth(mechanism.spec.size.mouth_radius_mm / L, _lost(mechanism, engagement, recess_mm))
    return [mouth_contacts(engagement, *error, roller, spare, mouth) for error in errors]


def _lost(mechanism: Mechanism, engagement: Engagement, recess_mm: float) -> tuple[float, float]:
    """Lengths over L by which blunt horns shorten a slot's walls, as ``mouth_contacts`` has them.

    In the slot's frame the recess's centre is L cos b along it, and L sin b across on either side.
    """
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    axis = RestingAxis.of(engagement)
    if not (size.horn_tip_mm and recess_mm and axis):
        return 0.0, 0.0
    width = mechanism.roller_radius_mm + size.allowances.slot_clearance_mm
    across = L * math.sin(engagement.half_step) - width - size.horn_tip_mm
    beyond = L * abs(math.cos(engagement.half_step) - float(axis.anchor.along))
    out = []
    for side in (1.0, -1.0):
        depth = across + side * L * engagement.slot.offset
        lost = math.sqrt(max(recess_mm**2 - depth * depth, 0.0)) - beyond
        out.append(max(lost, 0.0) / L)
    return out[0], out[1]


def mouth_jumps_worst(mechanism: Mechanism, recess_mm: float = 0.0) -> Array:
    """Sizes of the worst jumps on a mouth's corner, (m,); 0 if no roller touches a corner.

    ``recess_mm`` is the radius of the recesses, to which blunt horns reach; only for one design.
    """
    every = [
        on for one in mechanism.engagements for on in _on_mouth(mechanism, one, 1.0, recess_mm)
    ]
    sizes = [np.nan_to_num(abs(one.jump)) for one in every if one is not None]
    worst: Array = np.max(np.broadcast_arrays(np.zeros(1), *sizes), axis=0)
    return worst


def clearance_mm(mechanism: Mechanism) -> float:
    """Clearance between roller and slot per side, for the smallest roller in the widest slot.

    Where both have nominal sizes, the fits of the process make it.
    """
    tolerance, size = mechanism.spec.tolerance, mechanism.spec.size
    both = tolerance.roller_diameter_mm + tolerance.slot_width_mm
    given = size.allowances.slot_clearance_mm
    return choose(given == 0.0, workshop(size.process).slot_play_mm, given) + 0.5 * both


def reversal_impacts(mechanism: Mechanism, pin: PinSize | None = None) -> Impacts:
    """Hardest impacts of m designs at a change of sides with the greatest play.

    Without the ``pin`` as it is drawn, forces are not known. The play is the clearance over the
    lever where the wheel begins to coast. Without an inertia no wheel coasts. With a drag above
    ``lasting_drag_Nm`` the roller never changes sides.
    """
    best = np.full((3, 1), np.nan)
    none = (drag_over(mechanism) == np.inf) | (clearance_mm(mechanism) == 0.0)
    # a body off a carried wheel's axis drives the wheel where it would coast
    none = none | mechanism.unbalanced
    for engagement in () if all_true(none) else mechanism.engagements:
        best = _harder(best, _reversal(mechanism, engagement))
    *impacts, edge = best
    hit = _with_force(mechanism, np.array(impacts), pin)
    hertz = load_case(mechanism).hertz
    if hertz is None:
        return hit
    with np.errstate(divide="ignore"):  # a wall as sharp as the roller
        square = hit.force_N * np.ravel(hertz) / np.maximum(edge, 0.0)
    return hit._replace(contact_stress_MPa=np.sqrt(square))


def _reversal(mechanism: Mechanism, engagement: Engagement) -> Array:
    """Displayed input angles, jumps and edges of one engagement's hardest impacts, (3, m).

    The edge is 1 - k r, for a wall of curvature k under the roller (see ``instant``).
    """
    numbers = mechanism.center_distance_mm, drag_over(mechanism), clearance_mm(mechanism)
    L, drag, clearance = (np.broadcast_to(x, (mechanism.designs, 1)) for x in numbers)
    at = changes(engagement, drag)
    out = np.full((3, mechanism.designs), np.nan)
    if not len(at.x):
        return out
    lever = abs(touching(taken(engagement, at.which), at.x[:, None]).lever.arrays()[0][:, 0])
    least = 1e-6  # of the centre distance: where the slot lies across the path, play is unbounded
    sine = clearance[at.which, 0] / (np.maximum(lever, least) * L[at.which, 0])
    play = np.where(lever > least, engagement.slot.play(np.minimum(sine, 1.0)), 0.0)
    struck = impacts_of(engagement, at, play, drag)
    # hardest of each design; of equal ones the first
    order = np.lexsort((np.nan_to_num(-struck.speed, nan=np.inf), at.which))
    which, first = np.unique(at.which[order], return_index=True)
    x = out[0, which] = struck.at_deg[order][first]
    out[1, which] = struck.speed[order][first]
    wall = touching(taken(engagement, which), x[:, None])
    # the torque that the wheel then needs is that of the wall which strikes it
    bears = np.copysign(1.0, wall.acceleration.arrays()[0] + drag[which])
    radius = np.broadcast_to(load_case(mechanism).radius, drag.shape)[which]
    out[2, which] = (1.0 - wall.curvature.arrays()[0] * bears * radius)[:, 0]
    return _shown(mechanism, engagement, *out)


def _shown(mechanism: Mechanism, engagement: Engagement, at_deg: Array, *others: Array) -> Array:
    """Displayed input angles, jumps, and what else there is of impacts: (2 or more, m)."""
    shown = mechanism.shown_deg(parameter(engagement.mid_deg + at_deg[:, None]))
    return np.stack(np.broadcast_arrays(np.ravel(shown), *others))


def _harder(one: Array, other: Array) -> Array:
    """The harder of two impacts in each design; the first if they are equal."""
    more = abs(other[1]) > np.nan_to_num(abs(one[1]), nan=-1.0)
    return np.where(more, other, one)


def _with_force(mechanism: Mechanism, impacts: Array, pin: PinSize | None) -> Impacts:
    """Impacts with their forces and moments, from angles and jumps (2, m)."""
    at_deg, jump = impacts[0], impacts[1, :, None]
    moment = np.ravel(impulse_Nms(mechanism, jump))
    force = np.nan if pin is None else forces_N(mechanism, jump, pin)
    moment = np.where(moment == 0.0, np.nan, moment)
    return Impacts(*np.broadcast_arrays(at_deg, impacts[1], force, moment, np.nan))
