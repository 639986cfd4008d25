"""Loads of designs, sizing, vibration, impacts, and the effects of tolerances."""

import numpy as np

from geneva_cli.loads import load_peaks
from geneva_cli.loads.contact import OF_MOTION
from geneva_cli.loads.impacts.entry import entry_impacts
from geneva_cli.loads.impacts.reversal import lasting_drag_Nm, reversal_impacts
from geneva_cli.loads.impacts.shock_force import Impacts
from geneva_cli.loads.load_case import inertia_kgm2, load_case, sources
from geneva_cli.loads.positive_drive import positive_drives
from geneva_cli.numerics.arrays import Array, Number
from geneva_cli.verdict.quantities.groups import Columns, Designs
from geneva_cli.verdict.quantities.under_load import UnderLoad


def greatest(of: Designs) -> Columns:
    """The greatest sizes of loads and their input angles."""
    requested = of.requested("loads")
    out: dict[str, Number | None] = {}
    known = [n for n in load_peaks.REPORTED_PEAKS if {f"{n}.max", f"{n}.at_deg"} & requested]
    for name, (most, at_deg) in load_peaks.reported_peaks(of.machine, known).items():
        out |= {f"{name}.max": most * of.loaded, f"{name}.at_deg": at_deg * of.loaded}
    if "kinetic_power_W" in requested:
        from geneva_cli.loads.sizing import kinetic_power_W

        moved = np.ravel(load_case(of.machine).inertia_Nm) > 0.0
        out["kinetic_power_W"] = np.where(moved, kinetic_power_W(of.machine), np.nan)
    return out


def summaries(of: Designs) -> Columns:
    """Greatest and least values, means and rms of loads."""
    known, ends = sources(of.machine), dict[str, list[str]]()
    for name in of.requested("loads"):
        load, _, end = name.rpartition(".")
        # the ``max`` of loads that are sizes is a quantity of the report
        own = load_peaks.LoadSummary._fields[2 * (load in load_peaks.REPORTED_PEAKS) :]
        if load in known and end in own:
            ends.setdefault(load, []).append(end)
    if not ends:
        return {}
    means, out = any({"mean", "rms"} & {*own} for own in ends.values()), dict[str, Array]()
    for load, one in load_peaks.load_summaries(of.machine, list(ends), means).items():
        where = 1.0 if known[load][0] in OF_MOTION else of.loaded
        out |= {f"{load}.{end}": getattr(one, end) * where for end in ends[load]}
    return out


def sizing(of: Designs) -> Columns:
    """Motor, flywheel and the cam-indexer formula."""
    from geneva_cli.loads.sizing import sizings

    return sizings(of.machine, of.requested("sizing"))


def slot(of: Designs) -> Columns:
    """Intervals without the needed wall, and the distance of the slot's two branches."""
    drives = positive_drives(of.machine)
    if drives is None:
        return {}
    return {
        "not_driven_share": drives.fraction,
        "branch_gap_mm": drives.gap_mm,
        "branch_gap_at_deg": drives.gap_at_deg,
    }


def vibration(of: Designs) -> Columns:
    """The vibration of a load on its elastic shaft."""
    from geneva_cli.loads.vibration.vibration import design_vibrations

    return design_vibrations(of.machine, of.requested("vibration"))


def entry(of: Designs) -> Columns:
    """The impact at entry if R/L is wrong."""
    return _impact(of, entry_impacts(of.machine, pin=of.once(UnderLoad).pin))


def reversal(of: Designs) -> Columns:
    """The impact at a change of sides, and the drag that would prevent it."""
    coasts = np.ravel(inertia_kgm2(of.spec)) > 0.0
    drag = np.where(coasts, np.ravel(lasting_drag_Nm(of.machine)), np.nan)
    return _impact(of, reversal_impacts(of.machine, of.once(UnderLoad).pin), drag_Nm=drag)


def _impact(of: Designs, impacts: Impacts, **more: Array) -> Columns:
    """The quantities of impacts, and ``more``."""
    columns, lacks = impacts._asdict() | more, of.machine.output.lacks
    return {name: row for name, row in columns.items() if name not in lacks}


def tolerances(of: Designs) -> Columns:
    """The worst effects of tolerances on the motion, and on the velocity at entry."""
    from geneva_cli.loads.tolerance.locking import used
    from geneva_cli.loads.tolerance.motion_error import entry_jumps_worst, motion_plays

    plays = motion_plays(of.machine) if of.machine.output.turns else {}
    out: dict[str, Number | None] = {f"motion_play.{name}": row for name, row in plays.items()}
    if plays and "entry_jump.worst" in of.requested("tolerance"):
        jumps = entry_jumps_worst(of.machine, used(of.spec))
        known = np.isfinite(plays["worst_deg"])
        out["entry_jump.worst"] = None if jumps is None else np.where(known, jumps, np.nan)
    return out
