"""Quantities of wheels on a carrier: their motion from the ground, and their space."""

from contextlib import suppress

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.load_case import carried_kg, centrifugal_N
from geneva_cli.motion.many import worst_peaks
from geneva_cli.parts.parts import Parts
from geneva_cli.verdict.checks.part_checks import reach_mm
from geneva_cli.verdict.quantities.groups import Columns, Designs, Values


def motion(of: Designs) -> Columns:
    """Return turn and velocity of the wheels from the ground, and their centrifugal force."""
    machine, wheels = of.machine, of.spec.drive.wheels_on_carrier
    own = sum(2.0 * one.half_step for one in machine.engagements) * (360.0 / machine.period_deg)
    fastest = worst_peaks(machine, ["velocity"])["velocity"].max
    every = machine.under_load  # its period has the motions of all wheels
    moving = sum(one.motion_deg for one in every.engagements) / every.period_deg
    force = centrifugal_N(machine) if carried_kg(of.spec) else np.inf
    return {
        "turn_deg": np.ravel(360.0 + machine.frame * np.degrees(own)),
        "velocity": 1.0 + machine.frame * fastest,
        "moving_fraction": np.ravel(moving),
        "behind_deg": 360.0 / wheels if wheels > 1 else np.inf,
        "centrifugal_N": np.ravel(force),
    }


def envelope(parts: Parts) -> Values:
    """Return the radius about the fixed axis that the wheels sweep, on a carrier."""
    with suppress(GenevaError):  # ``parts.none`` gives the reason
        if parts.mechanism.spec.is_flat:
            return {"envelope_mm": parts.mechanism.center_distance_mm + reach_mm(parts.outlines)}
    return {}
