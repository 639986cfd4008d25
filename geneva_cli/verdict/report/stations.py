"""Timing and peaks: shared values, the greatest, and a row for each engagement."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from geneva_cli.analysis.peaks import Peaks, placed_peaks, worst
from geneva_cli.analysis.timing import timings
from geneva_cli.drawings.model import PartsModel
from geneva_cli.loads import loads
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import omega
from geneva_cli.table import rows_table
from geneva_cli.verdict.quantities.motion import peak_values

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Numbers, Values


def timing(model: PartsModel) -> Values:
    """The timing that is equal in all engagements; None for values that differ."""
    mechanism = model.mechanism
    each = [_timing(mechanism, i) for i in range(len(mechanism.engagements))]
    return {name: _shared([one[name] for one in each]) for name in each[0]}


def _shared(values: Sequence[float | None]) -> float | None:
    """The value that is equal in all engagements, apart from rounding; None if they differ."""
    known = [value for value in values if value is not None]
    # Rounding makes a value differ between engagements by up to 1e-12 of it.
    if len(known) < len(values) or not math.isclose(min(known), max(known), rel_tol=1e-12):
        return None
    return known[0]


def peaks(model: PartsModel) -> Values:
    """The greatest peaks over all engagements."""
    return {**_peaks(model.mechanism, worst(model.mechanism))}


def stations(model: PartsModel) -> Values:
    """A row for each engagement, if they differ."""
    mechanism = model.mechanism
    if len(mechanism.engagements) == 1:
        return {"stations": None}
    each = [
        _timing(mechanism, i) | _peaks(mechanism, placed_peaks(mechanism, s))
        for i, s in enumerate(mechanism.engagements)
    ]
    return {"stations": rows_table(tuple(each[0]), [tuple(e.values()) for e in each])}


def _timing(mechanism: Mechanism, i: int) -> Numbers:
    timing = timings(mechanism)[i]
    values: Numbers = {f"timing.{k}": v for k, v in timing._asdict().items()}
    # Krasniqi's (15) and (16): t = phi/omega is shortest at the highest speed that the limits on
    # force, torque and stress allow. That is n itself without limits, and none if no speed keeps
    # them. The work coefficient of one roller is k_r = phi/(2 pi - phi).
    motion = mechanism.engagements[i].motion_deg
    fastest = loads.fastest_rpm(mechanism)
    if fastest is not None and math.isinf(fastest):
        fastest = mechanism.spec.drive.n_rpm
    values["timing.shortest_motion_s"] = motion / (6.0 * fastest) if fastest else None
    values["timing.k_r"] = motion / (360.0 - motion) if motion < 360.0 else None
    return values


def _peaks(mechanism: Mechanism, peaks: Peaks) -> Numbers:
    w, ends, output = omega(mechanism.spec.drive.n_rpm), peaks.ends, mechanism.output
    return {
        **peak_values("velocity", output, w, peaks.velocity, ()),
        **peak_values("acceleration", output, w, peaks.acceleration, ends[:2]),
        **peak_values("jerk", output, w, peaks.jerk, ends[2:]),
        **peak_values("power", output, w, peaks.power, ()),
    }
