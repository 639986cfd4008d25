"""Contacts and impacts of single designs, from the functions for batches."""

import numpy as np

from geneva_cli.loads.impacts.entry import FirstContacts, RestingAxis, first_contacts
from geneva_cli.loads.impacts.reversal import changes, impacts_of
from geneva_cli.loads.impacts.shock_force import forces_N
from geneva_cli.loads.strength.pin_arm_key import PinSize, pin_diameter_mm
from geneva_cli.parts.machine_sizes import built


def contact_of(engagement, crank, center=0.0):
    """The first contact of one engagement; None if there is none."""
    axis = RestingAxis.of(engagement)
    contacts = axis and first_contacts(axis, crank, center)
    if contacts is None or np.isnan(contacts.jump).any():
        return None
    return FirstContacts(*(row.item() for row in contacts))


def impacts_in(engagement, play, drag=0.0):
    """Where the wheel begins to coast, where it is struck, and how fast; in order."""
    over = np.array([[float(drag)]])
    at = changes(engagement, over)
    start = at[1]
    rows = zip(start, *impacts_of(engagement, at, np.full(len(start), play), over), strict=True)
    return [row for row in rows if not np.isnan(row[1])]


def force_of(mechanism, jump):
    """The force of one design's impact, N; None if it is not known."""
    face_mm = mechanism.spec.size.face_width_mm
    if face_mm is None:
        return None
    drawn_mm = built(mechanism).pin_mm or pin_diameter_mm(mechanism)  # 0: the roller is its pin
    force = forces_N(mechanism, np.array([[jump]]), PinSize(drawn_mm, face_mm))
    return None if np.isnan(force).any() else force.item()
