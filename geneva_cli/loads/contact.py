"""The roller in its slot at input angles, what the loads there depend on, and their names.

Jets are by the input angle in radians, lengths over L.
The slot's tangent t points away from the wheel's axis: M . t > 0, M being the roller's centre.
"""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Truth, Whole, all_true, array, choose, choose_record, library
from geneva_cli.numerics.jet import Array, Jet, Number, Vector, sqrt

OF_MOTION = ("omega_rad_s", "alpha_rad_s2", "sliding_m_s")  # known without a load
PRESSED = ("contact_stress_MPa", "pv_W_m2")  # known only with a face width
# Searched by their squares: a root has no slope where it is 0, nor has the size of a vector.
SQUARED = (*PRESSED, "crank_bearing_N", "guide_force_N")
# Quantities that are never negative.
NEVER_NEGATIVE = (*SQUARED, "pin_force_N", "wheel_bearing_N")
NEGLIGIBLE = 1e-12  # fraction of a torque, of a motion, or of a lever over L that is rounding
NEAR_CUSP = 1e-4  # fraction of a half motion: nearer to a cusp, slopes are lost to rounding


def plain_values(values: Array, name: str) -> Array:
    """Values of a quantity, from the values that are searched."""
    return np.sqrt(np.abs(values)) if name in SQUARED else values


class Contact(NamedTuple):
    """The state of roller and slot that the loads depend on: jets of one order."""

    velocity: Jet
    acceleration: Jet
    lever: Jet  # M . t: of the walls' normal about the wheel's axis
    offset: Jet  # M x t: of the slot's tangent from the wheel's axis
    along: Jet  # the roller centre's speed along t
    curvature: Jet  # of the pitch curve, positive to the left of t: 0 in a straight slot
    spin: Jet  # rate of the roller's body relative to the wheel
    arm: Jet  # of friction at the wall about the wheel's axis, beyond M's: over the radius
    touches: Jet  # 0 while gears drive and no roller does, else 1
    crank: Jet  # rate of the shaft that carries the crank
    # Reactions of the joints of the roller's body (the crank's shaft, a guide) to a force of 1
    # along the normal i t, to one along t, and to a couple of 1; None where there is only a shaft.
    reactions: tuple[tuple[Vector, Vector], ...] | None = None


class LoadCase(NamedTuple):
    """The data that the loads depend on besides the motion; floats, or (m, 1) for m designs."""

    speed_rad_s: float  # of the input
    inertia_Nm: float  # inertia times the square of the input speed
    resists_Nm: float  # torque at the wheel that resists its motion
    L: float  # metres
    radius: float  # of the roller, over L
    friction: float  # ratio of the force along the wall to the force on it
    efficiency: float
    # square of the stress on a flat wall, MPa² per newton; None without a face width
    hertz: float | None
    # turns of the wheel's frame in one turn of the input, positive as the wheel turns in it
    frame: float = 0.0
    guide: Any = None  # in which the output slides: a rack's, with its friction and drag
    design: int | Whole = 0  # the design's number in its batch: (m, 1) in a batch
    rubs: bool = False  # True if there is friction along the wall in any of the designs
    guided: bool = False  # True if there is friction in the output's guide in any of them
    # A number that is above 0 for a design with any friction, which may hold the wheel
    all_friction: float = 0.0

    def with_friction(self, friction: float) -> LoadCase:
        """The load case with this friction along the wall, and with that in its own guide."""
        guide = self.guide
        return self._replace(
            friction=friction,
            rubs=not all_true(friction == 0.0),
            guided=guide is not None and not all_true(guide.friction == 0.0),
            all_friction=friction + guide.friction if guide else friction,
        )

    def lossless(self) -> LoadCase:
        """The load case without friction and losses, and without a contact's stress."""
        case = self._replace(hertz=None, efficiency=1.0, guide=None)
        return case.with_friction(0.0)


class QuantityValue(NamedTuple):
    """A quantity, the margin that bounds it where above 0, and the sign of its infinity."""

    value: Jet
    margin: Jet | None = None
    sign: Number = 1.0


def lesser(a: Jet, b: Jet) -> Jet:
    """The lesser of two jets, element by element."""
    first: Truth = a.c[0] < b.c[0]
    return Jet(map(partial(choose, first), a.c, b.c))


def contact(engagement: Engagement, x: Number, order: int = 0, reactions: bool = True) -> Contact:
    """The contact at input angles x, degrees from an engagement's mid-motion, one or an array.

    At mid-motion of a curved slot only the values have a limit, that of entry: ``order`` must be 0.
    """
    slot = engagement.slot
    rates = engagement.motion.rate(x, order + 1)
    velocity, acceleration = rates.lower, rates.derivative()
    constant = Jet((velocity.c[0] * 0.0, *[0.0] * order))
    if not slot.curved:
        lever, place = slot.axis(x, order + 1)
        lever, along = lever.lower, place.derivative()
        offset, curvature = constant + slot.offset, constant
    elif all_true(x != 0.0):
        lever, offset, along, curvature = _curved(engagement, x, order, rates)
    else:
        assert order == 0
        lever, offset, along, curvature = _at_middle(engagement, array(x), rates)
    upright, touches = slot.upright(x, order), constant + slot.touches(x)
    body = engagement.carrier(x, order)
    spin = (body - velocity * upright) * touches
    crank = constant + (body if engagement.on_arm else engagement.shaft(x, order + 1).derivative())
    arm = (constant + upright) * touches
    joints = _reactions(engagement, x, lever, offset) if reactions else None
    wall = lever, offset, along, curvature
    return Contact(velocity, acceleration, *wall, spin, arm, touches, crank, joints)


def _at_middle(engagement: Engagement, x: Array, rates: Jet) -> list[Jet]:
    """The values of ``_curved`` at input angles of which some are mid-motion.

    Where the pin crosses the radius there, its lever is 0, so that the sign of the tangent is
    rounding; next to it, the sign is known. Where the pin reverses in a cusp, the tangent is that
    of the pitch curve.
    """
    from geneva_cli.motion.path_and_slot import pitch, retraces

    near = contact(engagement, NEAR_CUSP * engagement.entry_deg, reactions=False)
    back, middle, at = retraces(engagement), x == 0.0, pitch(engagement, 0.0, 2)
    with np.errstate(all="ignore"):  # each formula holds for its own designs
        here = [jet.c[0] for jet in _curved(engagement, x, 0, rates)]
        turned = np.where(here[2] * near.along.c[0] < 0.0, -1.0, 1.0)
        crossing: tuple[Number, ...] = 0.0, *(turned * value for value in here[1:])
        lever = array(at.x * at.tangent_x + at.y * at.tangent_y)
        sense = np.copysign(1.0, lever)
        offset = sense * (at.x * at.tangent_y - at.y * at.tangent_x)
        # A slot that turns by less than 1e-9 has equal entry and exit paths: its curvature is that
        # next to the cusp.
        sharp = np.copysign(np.inf, sense * at.turning)
        curvature = np.where(np.abs(at.turning) > 1e-9, sharp, near.curvature.c[0])
        cusp: tuple[Number, ...] = sense * lever, offset, 0.0, curvature
        limits = choose_record(back, cusp, crossing)
        return [Jet((np.where(middle, a, b),)) for a, b in zip(limits, here, strict=True)]


def _curved(engagement: Engagement, x: Number, order: int, rates: Jet) -> tuple[Jet, Jet, Jet, Jet]:
    """Lever, offset, speed along and curvature of a curved slot, from the path p on the wheel.

    The axes are the fixed ones at the instant: each vector's rate is its own less the wheel's turn.
    """
    path = engagement.path(x, order + 2)
    dx, dy = (jet.derivative() for jet in path)
    px, py = (jet.lower for jet in path)
    ux, uy = dx + py * rates, dy - px * rates
    bend_x, bend_y = ux.derivative(), uy.derivative()
    px, py, dx, dy, ux, uy = (jet.lower for jet in (px, py, dx, dy, ux, uy))
    outward = px * dx + py * dy
    square = ux * ux + uy * uy
    along = sqrt(square) * library(outward.c[0]).copysign(1.0, outward.c[0])
    curvature = (ux * bend_y - uy * bend_x - square * rates.lower) / (square * along)
    return outward / along, (px * uy - py * ux) / along, along, curvature


def _reactions(
    engagement: Engagement, x: Number, lever: Jet, offset: Jet
) -> tuple[tuple[Vector, Vector], ...] | None:
    """The reactions of joints to three unit loads at the pin."""
    if engagement.reactions is None:
        return None
    path = engagement.path(x, lever.order + 1)
    touches = engagement.slot.touches(x)
    if not all_true(touches == 1.0):  # gears push at their pitch point, which stands still
        apart = Jet((*lever.c, 0.0)) * (1.0 - touches)
        path = path[0] * touches + apart, path[1] * touches
    px, py = (jet.lower for jet in path)
    square = px * px + py * py
    # the tangent, whose M . t and M x t are known
    tx, ty = (px * lever - py * offset) / square, (py * lever + px * offset) / square
    none = px * 0.0
    normal, tangent = (ty * -1.0, tx), (tx, ty)
    loads = (normal, none), (tangent, none), ((none, none), none + 1.0)
    return tuple(engagement.reactions(Jet.variable(radians(x), lever.order), path, loads))
