"""Quantities of wheels on a carrier: their motion from the ground."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.loads.carried import carried_kg
from geneva_cli.loads.unbalance import centrifugal_N, held_unbalance_Nm
from geneva_cli.motion.peak_search import worst_peaks
from geneva_cli.table import rows_table
from geneva_cli.verdict.quantities.designs import Columns, Designs, Values

if TYPE_CHECKING:
    from geneva_cli.drawings.model import PartsModel


def motion(of: Designs) -> Columns:
    """Return turn and velocity of the wheels from the ground, and their centrifugal force."""
    machine, wheels = of.machine, of.spec.drive.wheels_on_carrier
    if not wheels:
        return {}
    own = sum(2.0 * one.half_step for one in machine.engagements) * (360.0 / machine.period_deg)
    fastest = worst_peaks(machine, ["velocity"])["velocity"].max
    every = machine.under_load  # its period has the motions of all wheels
    moving = sum(one.motion_deg for one in every.engagements) / every.period_deg
    force = centrifugal_N(machine) if carried_kg(of.spec) else np.inf
    held = held_unbalance_Nm(machine) if of.spec.unbalanced else np.inf
    return {
        "turn_deg": np.ravel(360.0 + machine.frame * np.degrees(own)),
        "velocity": 1.0 + machine.frame * fastest,
        "moving_fraction": np.ravel(moving),
        "behind_deg": 360.0 / wheels if wheels > 1 else np.inf,
        "centrifugal_N": np.ravel(force),
        "held_Nm": np.ravel(held),
    }


def wheels(model: PartsModel) -> Values:
    """Return a row for each of several wheels: where it stands, and when it moves.

    Angles are those of the carrier from the middle of the first wheel's motion.
    """
    mechanism = model.mechanism
    places = mechanism.wheel_places
    if len(places) < 2:
        return {"wheels": None}
    (one,) = mechanism.engagements  # one finger, which all wheels meet alike
    names = ("wheel", "behind_deg", "entry_deg", "exit_deg", "entry_s")
    rows = []
    for place in places:
        behind = place.behind_deg
        after_s = behind / (6.0 * mechanism.spec.drive.n_rpm)  # n rpm is 6 n degrees a second
        rows.append((place.number, behind, behind + one.entry_deg, behind + one.exit_deg, after_s))
    return {"wheels": rows_table(names, rows)}
