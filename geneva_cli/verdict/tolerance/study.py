"""The effects of tolerances on dwell, motion, entry and clearances: ``geneva tolerance``."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, Notice, cut
from geneva_cli.loads.impacts.entry import mouth_jumps_worst
from geneva_cli.loads.tolerance.dimensions import Deviations, corners, tolerances, without_effect
from geneva_cli.loads.tolerance.locking import CutLock
from geneva_cli.loads.tolerance.motion_error import (
    WorstErrors,
    entry_jumps_worst,
    motion_errors,
    used,
)
from geneva_cli.loads.tolerance.random_machines import (
    Draws,
    Spread,
    entry_jumps,
    likely_place,
    random_machines,
    spread,
)
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.jet import Array
from geneva_cli.parts.parts import Parts
from geneva_cli.spec.rules import POSITIVE, require_mm
from geneva_cli.table import Table, record_table, rows_table
from geneva_cli.verdict.tolerance.needed import RequiredClearances, cut_parts, required_clearances


class EntryJumps(NamedTuple):
    """Sizes of the jump at entry over the input's speed; 0 for a machine that misses the axis."""

    worst: float
    mean: float
    std: float
    missed: float  # fraction of the machines whose roller misses the slot's axis
    mouth: float  # the worst on a mouth's corner; 0 if no roller touches one


class Study(NamedTuple):
    """The effects of the tolerances; None for those that do not exist, as ``warnings`` say."""

    dwell: Spread | None
    motion: Spread | None
    motion_at_deg: float | None
    entry: EntryJumps | None
    clearances: RequiredClearances
    jams: float | None  # fraction of the machines that do not fit together
    warnings: tuple[Notice, ...]


def study(mechanism: Mechanism, parts: Parts, samples: int, seed: int) -> Study:
    """The study of a machine by its ``[tolerance]``.

    Raises GenevaError without tolerances, and for numbers of samples and seeds out of range.
    """
    _refuse(mechanism, samples, seed)
    use, given = used(mechanism), tolerances(mechanism.spec)
    warnings = [
        Notice("tolerance-left-out", f"{name} is left out: {reason}")
        for name, reason in without_effect(mechanism.spec).items()
        if given[name]
    ]
    _refuse_large(mechanism, use)
    sizes = list(use.values())
    ends = corners(sizes)
    lock = None
    try:
        lock = _loosest_lock(mechanism, parts, ends)
    except GenevaError as error:
        warnings.append(Notice("not-known", f"no parts: {error}"))
    motions = motion_errors(mechanism)
    errors = [(one, *_single_design(one.greatest(ends))) for one in motions]
    farthest = max(errors, key=lambda error: error[1], default=None)
    roots = [(one, *_single_design(one.greatest_rss(sizes))) for one in motions]
    jumps = max(entry_jumps(mechanism), key=lambda one: _greatest(one(ends)[0]), default=None)
    normal = mechanism.spec.tolerance.distribution == "normal"
    machines = Draws(tuple(sizes), normal, seed)
    likely = likely_place(machines, samples, motions) if motions else None
    drawn = random_machines(machines, samples, lock, likely, jumps)
    dwell = motion = at_deg = None
    if lock:
        worst = _worst(lock, ends, use)
        dwell = spread(lambda by: lock(by).angle + by.slot_angle_deg, sizes, worst, drawn.dwell)
    else:
        warnings.append(
            Notice(
                "not-known",
                "dwell_position is not known: no drawn locking disc holds the wheel at rest",
            )
        )
    if farthest:
        one, worst, at, _ = farthest
        at_deg = mechanism.shown_deg(one.engagement.mid_deg + at)
        other, _, place, side = max(roots, key=lambda root: root[1])
        motion = spread(lambda by: other(by, place, side) * side, sizes, worst, drawn.motion)
    else:
        warnings.append(
            Notice(
                "not-known",
                "motion_play is not known: curved slots are computed for a path without errors",
            )
        )
    entry = None
    if jumps:
        worst_jump = entry_jumps_worst(mechanism, use)
        assert worst_jump is not None  # there are slots to enter
        mean, deviation = float(drawn.jump.mean()), float(drawn.jump.std())
        mouth = mouth_jumps_worst(mechanism).item()
        entry = EntryJumps(float(worst_jump[0]), mean, deviation, drawn.missed, mouth)
    else:
        warnings.append(
            Notice(
                "not-known",
                "entry_jump is not known: the law, not the path, sets how the roller enters",
            )
        )
    clearances = required_clearances(mechanism, parts, use)
    if clearances.turns is not True:
        what = "not every machine turns" if clearances.turns is False else "no turn was computed"
        warnings.append(Notice("not-every-machine-turns", f"{what}: {clearances.why}"))
    return Study(dwell, motion, at_deg, entry, clearances, drawn.jams, tuple(warnings))


def worst_dwell_deg(mechanism: Mechanism, parts: Parts) -> float | None:
    """The greatest error of the resting wheel's angle within the tolerances, degrees.

    None without a drawn locking disc. Raises GenevaError for tolerances that are too wide, and for
    parts that cannot be built.
    """
    use = used(mechanism)
    _refuse_large(mechanism, use)
    ends = corners(list(use.values()))
    lock = _loosest_lock(mechanism, parts, ends)
    return math.degrees(_worst(lock, ends, use)) if lock else None


def _loosest_lock(mechanism: Mechanism, parts: Parts, ends: Deviations) -> CutLock | None:
    """The lock that lets the wheel turn farthest; None if no drawn lock holds it."""
    locks = cut_parts(parts.turned).locks() if mechanism.spec.is_turned else []
    return max(locks, key=lambda one: _greatest(one(ends).angle.arrays()[0]), default=None)


def _worst(lock: CutLock, ends: Deviations, use: dict[str, float]) -> float:
    """The greatest error of the resting wheel's angle, radians."""
    return _greatest(lock(ends).angle.arrays()[0]) + use["slot_angle_deg"]


def _refuse(mechanism: Mechanism, samples: int, seed: int) -> None:
    if not 1 <= samples <= 10_000_000:
        raise GenevaError(f"--samples {cut(samples)}: it must be from 1 to 10000000")
    if seed < 0:
        raise GenevaError(f"--seed {cut(seed)}: it must be 0 or more")
    if not mechanism.output.turns:
        raise GenevaError(
            f"tolerances are computed for a wheel on a shaft, not for a {mechanism.output.noun}",
            ("wheel", "gearing"),
        )
    if not any(tolerances(mechanism.spec).values()):
        raise GenevaError(
            "the spec gives no tolerances: set one or more of "
            + ", ".join(Deviations._fields)
            + " in [tolerance], each a plus or minus",
            ("tolerance",),
        )


def _refuse_large(mechanism: Mechanism, use: dict[str, float]) -> None:
    """Raise GenevaError if some machine's roller may reach the wheel's axis or the crank's.

    A normal distribution has tails: deviations lie within three times the plus or minus.
    """
    for one in motion_errors(mechanism):
        margin_mm = one.margin_mm(mechanism.spec, use)
        if not use["center_distance_mm"] + use["crank_radius_mm"] < margin_mm:
            raise GenevaError(
                "the tolerances are too wide: center_distance_mm and crank_radius_mm must add up "
                f"to less than {max(margin_mm, 0.0):.6g} mm. Beyond that the roller could reach "
                "the wheel's axis or the crank's",
                ("tolerance", "center_distance_mm"),
            )


def _single_design(errors: WorstErrors) -> tuple[float, float, float]:
    """The values of the single design."""
    return float(errors.error[0]), float(errors.at_deg[0]), float(errors.side[0])


def _greatest(values: Array) -> float:
    return float(np.max(values))


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
    fields = {name: f"entry_jump.{name}" for name in ("mean", "std", "worst")}
    fields |= {"missed": "entry_jump.missed_share", "mouth": "entry_jump.mouth_worst"}
    values |= {name: getattr(entry, field) if entry else None for field, name in fields.items()}
    values |= {
        "clearances.slot_mm": size.allowances.slot_clearance_mm,
        "clearances.slot_needed_mm": results.clearances.slot_mm,
        "clearances.lock_mm": size.allowances.lock_clearance_mm if locked else None,
        "clearances.lock_needed_mm": results.clearances.lock_mm,
        "clearances.turns": results.clearances.turns,
        "clearances.jam_share": results.jams,
        "warnings": (*spec.accept.applied(results.warnings), *_unscaled(results, radius_mm)),
    }
    return record_table(values, spec.title)


def histogram_table(mechanism: Mechanism, parts: Parts, samples: int, seed: int) -> Table:
    """Histograms of the machines: for each angle the middles of bins, and the fraction in each.

    Raises GenevaError if neither angle is known.
    """
    results = study(mechanism, parts, samples, seed)
    known = {"dwell_position": results.dwell, "motion_play": results.motion}
    columns: dict[str, list[float]] = {}
    for name, one in known.items():
        if one:
            columns[f"{name}_deg"], columns[f"{name}_share"] = map(
                list, zip(*one.shape, strict=True)
            )
    if not columns:
        raise GenevaError(f"--histogram: {'; '.join(results.warnings)}")
    return Table(tuple(columns), list(columns.values()), title=mechanism.spec.title)


def _angles(name: str, of: Spread | None, radius_mm: float | None) -> dict[str, float | None]:
    """The five numbers of a spread in degrees, arc seconds, and micrometres at a radius."""
    micron = None if radius_mm is None else math.radians(1.0) * radius_mm * 1e3
    units = {"deg": 1.0, "arcsec": 3600.0, "um": micron}
    return {
        f"{name}.{angle}_{unit}": None
        if of is None or scale is None
        else getattr(of, angle) * scale
        for unit, scale in units.items()
        for angle in ANGLES
    }


def _unscaled(results: Study, radius_mm: float | None) -> list[Notice]:
    """A note on the micrometres, if there are angles and no radius."""
    angles = {"dwell_position": results.dwell, "motion_play": results.motion}
    known = [name for name, of in angles.items() if of]
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
            for of in (results.dwell, results.motion):
                row += [of.fractions[i], of.parts[i]] if of else [None, None]
            rows.append(tuple(row))
    rows.sort(key=lambda row: -(row[1] or 0.0))
    return rows_table(names, rows)
