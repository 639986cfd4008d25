"""The results of a study of tolerances as ``geneva tolerance`` prints them."""

from __future__ import annotations

import math
from typing import Any

from geneva_cli.errors import GenevaError, Notice
from geneva_cli.loads.tolerance.dimensions import Deviations, tolerances
from geneva_cli.loads.tolerance.random_machines import Spread
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.parts import Parts
from geneva_cli.spec.rules import POSITIVE, require_mm
from geneva_cli.table import Table, record_table, rows_table
from geneva_cli.verdict.tolerance.study import Study, study

ANGLES = ("worst", "rss", "mean", "std", "p997")


def tolerance_table(
    mechanism: Mechanism, parts: Parts, samples: int, seed: int, radius_mm: float | None = None
) -> Table:
    """The study as a record, with micrometres at ``radius_mm``, if not None."""
    if radius_mm is not None:
        require_mm("--radius", radius_mm, POSITIVE)
    results = study(mechanism, parts, samples, seed)
    spec, size, entry = mechanism.spec, mechanism.spec.size, results.entry
    locked = results.clearances.lock_mm is not None
    values: dict[str, Any] = {"spec": spec.path, "title": spec.title}
    values |= {"samples": samples, "seed": seed, "distribution": spec.tolerance.distribution}
    values["radius_mm"] = radius_mm
    values |= _angles("dwell_position", results.dwell, radius_mm)
    values |= _angles("motion_play", results.motion, radius_mm)
    values["motion_play.at_deg"] = results.motion_at_deg
    values["contributions"] = _contributions(mechanism, results)
    values |= {
        "entry_jump.mean": entry.mean if entry else None,
        "entry_jump.std": entry.std if entry else None,
        "entry_jump.worst": entry.worst if entry else None,
        "entry_jump.missed_share": entry.missed if entry else None,
        "entry_jump.mouth_worst": entry.mouth if entry else None,
        "clearances.slot_mm": size.allowances.slot_clearance_mm,
        "clearances.slot_needed_mm": results.clearances.slot_mm,
        "clearances.lock_mm": size.allowances.lock_clearance_mm if locked else None,
        "clearances.lock_needed_mm": results.clearances.lock_mm,
        "clearances.turns": results.clearances.turns,
        "clearances.jam_share": results.jams,
        "warnings": (*results.warnings, *_unscaled(results, radius_mm)),
    }
    return record_table(values, spec.title)


def histogram_table(mechanism: Mechanism, parts: Parts, samples: int, seed: int) -> Table:
    """Histograms of the machines: for each angle the middles of bins, and the fraction in each.

    Raises GenevaError if neither angle is known.
    """
    results = study(mechanism, parts, samples, seed)
    known = {"dwell_position": results.dwell, "motion_play": results.motion}
    columns: dict[str, list[float]] = {}
    for name, spread in known.items():
        if spread:
            columns[f"{name}_deg"], columns[f"{name}_share"] = map(
                list, zip(*spread.shape, strict=True)
            )
    if not columns:
        raise GenevaError(f"--histogram: {'; '.join(results.warnings)}")
    return Table(tuple(columns), list(columns.values()), title=mechanism.spec.title)


def _angles(name: str, spread: Spread | None, radius_mm: float | None) -> dict[str, float | None]:
    """The five numbers of a spread in degrees, arc seconds, and micrometres at a radius."""
    degrees = [getattr(spread, angle) if spread else None for angle in ANGLES]
    out: dict[str, float | None] = {}
    micron = None if radius_mm is None else math.radians(1.0) * radius_mm * 1e3
    for unit, scale in (("deg", 1.0), ("arcsec", 3600.0), ("um", micron)):
        for angle, value in zip(ANGLES, degrees, strict=True):
            known = value is not None and scale is not None
            out[f"{name}.{angle}_{unit}"] = value * scale if known else None  # type: ignore[operator]
    return out


def _unscaled(results: Study, radius_mm: float | None) -> list[Notice]:
    """A note on the micrometres, if there are angles and no radius."""
    known = [
        name
        for name, of in (("dwell_position", results.dwell), ("motion_play", results.motion))
        if of
    ]
    if radius_mm is not None or not known:
        return []
    return [Notice("not-known", f"micrometres of {' and '.join(known)}: need --radius")]


def _contributions(mechanism: Mechanism, results: Study) -> Table:
    """A row for each dimension that deviates: its fraction of the squares, its plus or minus."""
    names = ("dimension", "share", "dwell_position_deg", "motion_share", "motion_play_deg")
    rows = []
    for i, name in enumerate(Deviations._fields):
        if tolerances(mechanism.spec)[name]:
            row: list[Any] = [name]
            for spread in (results.dwell, results.motion):
                row += [spread.fractions[i], spread.parts[i]] if spread else [None, None]
            rows.append(tuple(row))
    rows.sort(key=lambda row: -(row[1] or 0.0))
    return rows_table(names, rows)
