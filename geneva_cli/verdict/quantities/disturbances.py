"""Disturbances of designs: vibration of the load, impacts of the roller, and tolerances."""

from __future__ import annotations

import numpy as np

from geneva_cli.loads.carried import inertia_kgm2
from geneva_cli.loads.impacts.change_of_sides import lasting_drag_Nm
from geneva_cli.loads.impacts.impacts import Impacts, entry_impacts, reversal_impacts
from geneva_cli.numerics.arrays import Array, Number
from geneva_cli.verdict.quantities.batch_designs import Columns, Designs
from geneva_cli.verdict.quantities.under_load import drawn_pin


def vibration(of: Designs) -> Columns:
    """The vibration of a load on its elastic shaft."""
    from geneva_cli.loads.vibration.vibration import Vibrations, design_vibrations

    shaken = design_vibrations(of.machine, of.requested("vibration"))
    if shaken is None:
        return dict.fromkeys(Vibrations._fields)
    # without damping there is no steady state; without a period ratio the design says why
    steady = np.where(
        np.isnan(shaken.steady_share), shaken.period_ratio + np.inf, shaken.steady_share
    )
    return shaken._replace(steady_share=steady)._asdict()


def entry(of: Designs) -> Columns:
    """The impact at entry if R/L is wrong."""
    return _impact(of, entry_impacts(of.machine, pin=drawn_pin(of)))


def reversal(of: Designs) -> Columns:
    """The impact at a change of sides, and the drag that would prevent it."""
    coasts = np.ravel(inertia_kgm2(of.spec)) > 0.0
    drag = np.where(coasts, np.ravel(lasting_drag_Nm(of.machine)), np.inf)
    impacts = reversal_impacts(of.machine, drawn_pin(of))
    return _impact(of, impacts, drag_Nm=drag)


def _impact(of: Designs, impacts: Impacts, **more: Array) -> Columns:
    """The quantities of impacts, and ``more``; infinite where a design has none."""
    columns = {n: np.where(np.isnan(row), np.inf, row) for n, row in impacts._asdict().items()}
    lacks = of.machine.output.lacks
    return {name: row for name, row in (columns | more).items() if name not in lacks}


def tolerances(of: Designs) -> Columns:
    """The worst effects of tolerances on the motion, and on the velocity at entry.

    None for racks, whose deviations are not studied. The jump at entry is computed as a batch if
    all designs have tolerances, none of which is too wide.
    """
    from geneva_cli.loads.tolerance.worst_effects import entry_jumps_worst, motion_plays, used

    plays = motion_plays(of.machine) if of.machine.output.turns else None
    if plays is None:
        return dict.fromkeys(("motion_play.worst_deg", "motion_play.rss_deg", "entry_jump.worst"))
    out: dict[str, Number | None] = {f"motion_play.{n}": v for n, v in plays._asdict().items()}
    if "entry_jump.worst" in of.requested("tolerance"):
        jumps = entry_jumps_worst(of.machine, used(of.machine))
        known = np.isfinite(plays.worst_deg)
        out["entry_jump.worst"] = None if jumps is None else np.where(known, jumps, np.nan)
    return out
