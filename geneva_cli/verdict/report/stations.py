"""Timing and peaks, engagement by engagement."""

from __future__ import annotations

import math

from geneva_cli.analysis.loads import loads
from geneva_cli.analysis.peaks import Peaks, placed, worst
from geneva_cli.analysis.timing import timings
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.parts.proof import Proof
from geneva_cli.table import rows_table
from geneva_cli.verdict.report.values import Numbers, Values


def stations(proof: Proof) -> Values:
    """Where engagements differ, what they share and their worst, then each."""
    mechanism = proof.mechanism
    each = [
        _timing(mechanism, i) | _peaks(mechanism, placed(mechanism, s))
        for i, s in enumerate(mechanism.engagements)
    ]
    if len(each) == 1:
        return {**each[0], "stations": None}
    shared: Numbers = {}
    for name in each[0]:
        low, high = min(found := [e[name] or 0.0 for e in each]), max(found)
        same = all(e[name] is not None for e in each) and math.isclose(low, high, rel_tol=1e-12)
        shared[name] = each[0][name] if same else None
    rows = rows_table(tuple(each[0]), [tuple(e.values()) for e in each])
    return {**shared, **_peaks(mechanism, worst(mechanism)), "stations": rows}


def _timing(mechanism: Mechanism, i: int) -> Numbers:
    timing = timings(mechanism)[i]
    values: Numbers = {f"timing.{k}": v for k, v in timing._asdict().items()}
    # Krasniqi's (15) and (16): t = phi/omega, shortest at the highest speed that the limits on
    # force, torque and stress allow (n itself where none bounds it; none where no speed keeps
    # them), and the work coefficient of one roller, k_r = phi/(2 pi - phi).
    motion = mechanism.engagements[i].motion_deg
    fastest = loads.fastest_rpm(mechanism)
    if fastest is not None and math.isinf(fastest):
        fastest = mechanism.spec.drive.n_rpm
    values["timing.shortest_motion_s"] = motion / (6.0 * fastest) if fastest else None
    values["timing.k_r"] = motion / (360.0 - motion) if motion < 360.0 else None
    return values


def _peaks(mechanism: Mechanism, found: Peaks) -> Numbers:
    w = omega(mechanism.spec.drive.n_rpm)
    values: Numbers = {}
    rows = (
        ("velocity", found.velocity, w, "rad_s"),
        ("acceleration", found.acceleration, w**2, "rad_s2"),
        ("jerk", found.jerk, w**3, "rad_s3"),
        ("power", found.power, w**3, "rad2_s3"),
    )
    for name, peak, scale, unit in rows:
        values[f"{name}.max"] = peak.max
        values[f"{name}.at_deg"] = peak.at_deg
        values[f"{name}.max_{unit}"] = peak.max * scale
        if name == "acceleration":
            entry = found.ends.acceleration_entry
            values[f"{name}.entry"] = entry
            values[f"{name}.exit"] = found.ends.acceleration_exit
            values[f"{name}.entry_{unit}"] = entry * scale
        if name == "jerk":
            values[f"{name}.entry"] = found.ends.jerk_entry
            values[f"{name}.exit"] = found.ends.jerk_exit
    return values
