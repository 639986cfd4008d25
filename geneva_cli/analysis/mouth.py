"""The shock at the mouth: a roller whose arm is too short or too long for its slot.

Where the slot's clearance leaves it no room for that, it meets the corner in which one of the
slot's walls ends, drawn at the foot of the perpendicular from the crank's axis: an arm too short
the corner on the side of that axis, which it strikes forwards, an arm too long the one beyond,
which it strikes back. On a sharp corner the blow is about

    jump / omega = tan b sqrt(2 eps) sqrt((R -+ r)/r),

less for the arm too short, eps being the share of R that is missing or too much once the clearance
is used up, r the roller's radius: some three times the first contact with the slot's axis
(``shock``) where r is R/10, as if the walls went on past the mouth. A corner rounded by c counts
as a roller of r + c.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.shock import FirstContacts, SlotAxis
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import all_true

if TYPE_CHECKING:
    from geneva_cli.machine.engagement import Engagement
    from geneva_cli.numerics.arrays import N


def mouth_contacts(
    engagement: Engagement, crank: N, center: N, roller: N, clearance: N
) -> FirstContacts | None:
    """The first contacts with the mouth's sharp corners; NaN where the roller has room.

    ``crank`` and ``center`` are relative errors as of ``shock.first_contacts``, ``roller`` the
    roller's radius and ``clearance`` that of the slot per side, both over L: floats, or (m, 1) of
    m designs. None for a roller that is on no crank's arm, and for slots that are solved for. The
    arm turns evenly during the little that it is early. A jump below 0 is one back.

        >>> from geneva_cli import Design, External
        >>> [engagement] = Design(External(6)).mechanism.engagements
        >>> found = mouth_contacts(engagement, -1e-4, 0.0, roller=0.05, clearance=0.0)
        >>> round(float(found.jump[0]), 6)  # tan(30 deg) sqrt(2e-4) sqrt(9) is 0.024495
        0.024448
    """
    on_arm = all_true(engagement.crank_sense == 0.0) and all_true(engagement.hub == 1.0)
    if engagement.motion.entry is None or not on_arm:
        return None
    axis = SlotAxis.of(engagement)
    R = abs(np.atleast_2d(axis.beside + engagement.slot.offset)) * (1.0 + crank)
    over = (1.0 + crank) * axis.aside(crank, center) * np.sign(axis.beside)  # of the arm
    side, over = np.sign(over), abs(over)
    far = abs(axis.along) * (1.0 + center)
    rate = abs(engagement.carrier(engagement.entry_deg).c[0])
    wide = roller + clearance
    corner = R - side * (over - wide)  # from the crank's axis
    with np.errstate(all="ignore"):
        # on the circle of R the corner is a roller away: R² + corner² - 2 R corner cos = r²
        rise = (over - clearance) * (roller + wide - over) / (2.0 * R * corner)  # 1 - cos
        meets = (over > clearance) & (over < wide) & (corner > 0.0)
        early = np.where(meets, 2.0 * np.arcsin(np.sqrt(rise / 2)), np.nan)
        sine, across = R * np.sin(early), side * (corner - R * np.cos(early))
        # speeds of roller and corner along the line between them are one
        jump = -side * rate * corner * sine / (far * across + wide * sine)
    return FirstContacts(np.ravel(engagement.entry_deg - early / rate / DEGREE), np.ravel(jump))
