"""Single contacts and impacts, as the tests of impacts ask for them."""

import numpy as np

from geneva_cli.analysis.change_of_sides import WallImpacts, changes, impacts_of
from geneva_cli.analysis.shock import FirstContacts, first_contacts
from geneva_cli.analysis.shock_force import forces_N


def contact_of(engagement, crank, center=0.0):
    """The first contact of one engagement; None where there is none."""
    found = first_contacts(engagement, crank, center)
    if found is None or np.isnan(found.jump).any():
        return None
    return FirstContacts(*(row.item() for row in found))


def impacts_in(engagement, play, drag=0.0):
    """The changes of sides of one engagement that take up a play in its motion."""
    over = np.array([[float(drag)]])
    at = changes(engagement, over)
    rows = zip(*impacts_of(engagement, at, np.full(len(at.x), play), over), strict=True)
    return [WallImpacts(*row) for row in rows if not np.isnan(row[1])]


def force_of(mechanism, jump):
    """The force of one design's impact; None where it is not known."""
    found = forces_N(mechanism, np.array([[jump]]))
    return None if found is None or np.isnan(found).any() else found.item()
