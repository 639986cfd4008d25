"""Loads of designs, sizing, vibration, impacts, and the effects of tolerances."""

import numpy as np

from geneva_cli.loads import load_peaks
from geneva_cli.loads.impacts.entry import entry_impacts
from geneva_cli.loads.impacts.reversal import lasting_drag_Nm, reversal_impacts
from geneva_cli.loads.impacts.shock_force import Impacts
from geneva_cli.loads.load_case import inertia_kgm2, load_case, sources
from geneva_cli.loads.positive_drive import positive_drives
from geneva_cli.numerics.arrays import Array, Number
from geneva_cli.verdict.quantities.batch_designs import Columns, Designs
from geneva_cli.verdict.quantities.under_load import drawn_pin

OF_MOTION = ("omega_rad_s", "alpha_rad_s2", "sliding_m_s")  # known without a load


def greatest(of: Designs) -> Columns:
    """The greatest sizes of loads and their input angles; infinite if no design has the load."""
    requested = of.requested("loads")
    names = [
        name for name in load_peaks.REPORTED_PEAKS if {f"{name}.max", f"{name}.at_deg"} & requested
    ]
    peaks = load_peaks.reported_peaks(of.machine, names)
    out: dict[str, Number | None] = {}
    for name in names:
        most, at_deg = peaks.get(name, (np.inf, np.inf))
        out |= {f"{name}.max": most * of.loaded, f"{name}.at_deg": at_deg * of.loaded}
    if "kinetic_power_W" in requested:
        from geneva_cli.loads.sizing import kinetic_power_W

        kinetic = kinetic_power_W(of.machine)
        moved = np.ravel(load_case(of.machine).inertia_Nm) > 0.0
        out["kinetic_power_W"] = np.where(moved, kinetic, np.nan) * of.loaded
    return out


def pressure(of: Designs) -> Columns:
    """The greatest pressure angle and its input angle."""
    peak = load_peaks.greatest_pressure(of.machine)
    return {"max_deg": peak.max, "at_deg": peak.at_deg}


def summaries(of: Designs) -> Columns:
    """Greatest and least values, means and rms of loads; None for loads that no design has."""
    known = sources(of.machine)
    ends: dict[str, list[str]] = {}
    for name in of.requested("loads"):
        load, _, end = name.rpartition(".")
        # the ``max`` of loads that are sizes is a quantity of the report
        if end in load_peaks.LoadSummary._fields[2 * (load in load_peaks.REPORTED_PEAKS) :]:
            ends.setdefault(load, []).append(end)
    out: dict[str, Number | None] = {
        f"{load}.{end}": None for load, own in ends.items() if load not in known for end in own
    }
    requested = {load: own for load, own in ends.items() if load in known}
    if not requested:
        return out
    means = any({"mean", "rms"} & set(own) for own in requested.values())
    for load, one in load_peaks.load_summaries(of.machine, list(requested), means).items():
        values, moves = one._asdict(), known[load][0] in OF_MOTION
        for end in requested[load]:
            out[f"{load}.{end}"] = _where_loaded(of, values[end], moves)
    return out


def _where_loaded(of: Designs, values: Array, is_motion: bool) -> Array:
    """Values of loads, infinite without one; those of the ``motion`` need none."""
    without = np.ones(1, dtype=bool) if is_motion else ~np.isnan(of.loaded)
    return np.where(without, values, np.inf)


def sizing(of: Designs) -> Columns:
    """Motor, flywheel and the cam-indexer formula; None for values that need keys none has."""
    from geneva_cli.loads.sizing import KNOWN_UNLOADED, sizings

    requested = of.requested("sizing")
    names = requested if of.spec.is_loaded else requested & {*KNOWN_UNLOADED}
    out: dict[str, Number | None] = dict.fromkeys(requested)
    for name, row in sizings(of.machine, names).items():
        if name not in of.machine.output.lacks:
            known = np.where(np.isnan(row), np.inf, row)
            out[name] = _where_loaded(of, known, name in KNOWN_UNLOADED)
    return out


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
    from geneva_cli.loads.vibration.vibration import NAMES, design_vibrations

    shaken = design_vibrations(of.machine, of.requested("vibration"))
    return {**dict.fromkeys(NAMES), **(shaken or {})}


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
    """The worst effects of tolerances on the motion, and on the velocity at entry."""
    from geneva_cli.loads.tolerance.motion_error import entry_jumps_worst, motion_plays, used

    plays = motion_plays(of.machine) if of.machine.output.turns else None
    if plays is None:
        return dict.fromkeys(("motion_play.worst_deg", "motion_play.rss_deg", "entry_jump.worst"))
    out: dict[str, Number | None] = {f"motion_play.{n}": v for n, v in plays._asdict().items()}
    if "entry_jump.worst" in of.requested("tolerance"):
        jumps = entry_jumps_worst(of.machine, used(of.machine))
        known = np.isfinite(plays.worst_deg)
        out["entry_jump.worst"] = None if jumps is None else np.where(known, jumps, np.nan)
    return out
