"""The roller in its slot at one or many input angles: levers, sliding speed, curvature.

Jets by the input angle in radians; lengths are in units of the centre distance L. The slot's
tangent t points away from the wheel's axis: M . t > 0, M being the roller's centre in the wheel.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.loads.forces import Contact
from geneva_cli.motion.engagement import Engagement, Vector
from geneva_cli.numerics.arrays import all_true, choose, library
from geneva_cli.numerics.jet import Jet, Number, sqrt

NEAR_CUSP = 1e-4  # fraction of a half motion: nearer to a cusp, slopes are lost to rounding


def contact(
    engagement: Engagement, input_deg: Number, order: int = 0, reactions: bool = True
) -> Contact[Jet]:
    """The contact at input angles, degrees from an engagement's mid-motion, one or an array.

    Without ``reactions`` those of the joints are None. At mid-motion of a curved slot only the
    values have a limit, that of entry: there ``order`` must be 0.
    """
    if not engagement.slot.curved or all_true(input_deg != 0.0):
        return _moving(engagement, input_deg, order, reactions)
    assert order == 0
    middle = input_deg == 0.0
    near = choose(middle, NEAR_CUSP * engagement.entry_deg, input_deg)
    both = zip(_middle(engagement), _moving(engagement, near, 0, False)[:-1], strict=True)
    jets = [Jet((choose(middle, own, jet.c[0]),)) for own, jet in both]
    joints = _reactions(engagement, input_deg, jets[2], jets[3]) if reactions else None
    return Contact._make([*jets, joints])


def _moving(engagement: Engagement, x: Number, order: int, reactions: bool) -> Contact[Jet]:
    """The contact where the pin moves in its slot, or where the slot is straight."""
    rates = engagement.motion.rate(x, order + 1)
    velocity, acceleration = _to_order(rates, order), rates.derivative()
    constant = Jet((velocity.c[0] * 0.0, *[0.0] * order))
    straight_axis = engagement.slot.axis(x, order)
    if straight_axis:
        lever, along = straight_axis
        offset, curvature = constant + engagement.slot.offset, constant
    else:
        lever, offset, along, curvature = _curved(engagement, x, order, rates)
    upright = engagement.slot.upright(x, order)
    touches = constant + engagement.slot.touches(x)
    body = engagement.carrier(x, order)
    spin = (body - velocity * upright) * touches
    crank = constant + (body if engagement.on_arm else engagement.shaft_rate(x, order))
    arm = (constant + upright) * touches
    joints = _reactions(engagement, x, lever, offset) if reactions else None
    slot = lever, offset, along, curvature
    return Contact(velocity, acceleration, *slot, spin, arm, touches, crank, joints)


def _curved(engagement: Engagement, x: Number, order: int, rates: Jet) -> tuple[Jet, Jet, Jet, Jet]:
    """Lever, offset, speed along and curvature of a curved slot, from the path p on the wheel.

    The axes are the fixed ones at the instant. Each vector's rate is its own less the wheel's
    rotation. Products of two vectors are equal in all axes, so the wheel's angle is not needed.
    """
    path = engagement.path(x, order + 2)
    dx, dy = (jet.derivative() for jet in path)
    px, py = (_to_order(jet, order + 1) for jet in path)
    ux, uy = dx + py * rates, dy - px * rates
    turn = _to_order(rates, order)
    bend_x, bend_y = ux.derivative(), uy.derivative()
    px, py, dx, dy, ux, uy = (_to_order(jet, order) for jet in (px, py, dx, dy, ux, uy))
    outward = px * dx + py * dy
    square = ux * ux + uy * uy
    along = sqrt(square) * library(outward.c[0]).copysign(1.0, outward.c[0])
    curvature = (ux * bend_y - uy * bend_x - square * turn) / (square * along)
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
    px, py = (_to_order(jet, lever.order) for jet in path)
    square = px * px + py * py
    # the tangent, whose M . t and M x t are known
    tx, ty = (px * lever - py * offset) / square, (py * lever + px * offset) / square
    none = px * 0.0
    normal, tangent = (ty * -1.0, tx), (tx, ty)
    loads: tuple[tuple[Vector, Jet], ...] = (
        (normal, none),
        (tangent, none),
        ((none, none), none + 1.0),
    )
    return tuple(engagement.reactions(x, path, loads))


def _middle(engagement: Engagement) -> list[Number]:
    """The contact at mid-motion of a curved slot, where the pin crosses the radius or reverses."""
    from geneva_cli.motion.pitch_curve import retraces

    back = retraces(engagement)
    if isinstance(back, bool):
        return _cusp(engagement) if back else _crossing(engagement)
    with np.errstate(all="ignore"):  # each formula holds for its own designs
        both = zip(_cusp(engagement), _crossing(engagement), strict=True)
        return [choose(back, cusp, crossing) for cusp, crossing in both]


def _crossing(engagement: Engagement) -> list[Number]:
    """The contact where the pin crosses the radius.

    The lever is 0 there, so the sign of the tangent is rounding; next to it, the sign is known.
    """
    values, before = (
        [jet.c[0] for jet in _moving(engagement, x, 0, False)[:-1]]
        for x in (0.0, NEAR_CUSP * engagement.entry_deg)
    )
    lever, along = (Contact._fields.index(name) for name in ("lever", "along"))
    turned = values[along] * before[along] < 0.0
    for name in ("offset", "along", "curvature"):
        i = Contact._fields.index(name)
        values[i] = choose(turned, -values[i], values[i])
    values[lever] = 0.0
    return values


def _cusp(engagement: Engagement) -> list[Number]:
    """The contact where the pin reverses in a cusp of its pitch curve."""
    from geneva_cli.motion.pitch_curve import pitch_at_retrace

    at = pitch_at_retrace(engagement)
    m = library(at.x)
    lever = at.x * at.tangent_x + at.y * at.tangent_y
    sense = m.copysign(1.0, lever)
    offset = sense * (at.x * at.tangent_y - at.y * at.tangent_x)
    _, v, a = engagement.motion(0.0, 2).derivatives()
    body = engagement.carrier(0.0).c[0]
    crank = body if engagement.on_arm else engagement.shaft_rate(0.0).c[0]
    # A slot that turns by less than 1e-9 has equal entry and exit paths: its curvature is that next
    # to the cusp.
    curvature = choose(
        at.turning * at.turning > 1e-9 * 1e-9,
        m.copysign(math.inf, sense * at.turning),
        _moving(engagement, NEAR_CUSP * engagement.entry_deg, 0, False).curvature.c[0],
    )
    return [v, a, sense * lever, offset, 0.0, curvature, body - v, 1.0, 1.0, crank]


def _to_order(jet: Jet, order: int) -> Jet:
    """The jet without its derivatives above an order."""
    return Jet(jet.c[: order + 1])
