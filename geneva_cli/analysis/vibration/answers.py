"""What ``geneva vibration`` prints: a record at the design's speed, a spectrum over speed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from geneva_cli.analysis.motion import check_samples
from geneva_cli.analysis.timing import timings
from geneva_cli.analysis.vibration.oscillator import NO_INERTIA, Oscillator
from geneva_cli.analysis.vibration.vibration import (
    FASTER,
    SLOWER,
    Avoid,
    Station,
    each_share,
    speeds_to_avoid,
    stations,
    steady,
    worst_residuals,
)
from geneva_cli.errors import Caution
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.table import Table, record_table, rows_table

SPECTRUM = (
    "n_rpm",
    "period_ratio",
    "residual_share",
    "residual_deg",
    "residual_share_worst",
    "steady_share",
)


def values(mechanism: Mechanism, load: Oscillator | None) -> dict[str, Any]:
    """Named values, the same for every machine; all None where no inertia is known."""
    if load is None:
        return dict.fromkeys((*NUMBERS, "avoid", "stations")) | {
            "warnings": (Caution("not-known", f"all is null: {NO_INERTIA}"),)
        }
    each = stations(mechanism, load)
    avoid = speeds_to_avoid(mechanism, load)
    first = timings(mechanism)[0]
    residual = max(each, key=lambda s: s.residual_share)
    steadies = [s.steady_share for s in each if s.steady_share is not None]
    worst = worst_residuals(mechanism, np.array([load.ratio]), load.damping)
    # accelerations over wn²: a wind-up is the wheel's
    wheel = max(s.windup_deg for s in each)
    swings = max(s.windup_deg * s.dynamic_factor for s in each)
    return {
        "period_ratio": load.ratio,
        "damping_ratio": load.damping,
        "natural_Hz": load.ratio / first.motion_s,
        "residual_share": residual.residual_share,
        "residual_deg": max(s.residual_deg for s in each),
        "residual_share_worst": float(worst[0]),
        "steady_share": max(steadies) if steadies else None,
        "dynamic_factor": swings / wheel,
        "windup_deg": wheel,
        "speeds_to_avoid_rpm": tuple(a.rpm for a in avoid),
        "avoid": rows_table(Avoid._fields, avoid),
        "stations": rows_table(Station._fields, each) if len(each) > 1 else None,
        "warnings": tuple(_warnings(mechanism, load, each)),
    }


NUMBERS = (
    "period_ratio",
    "damping_ratio",
    "natural_Hz",
    "residual_share",
    "residual_deg",
    "residual_share_worst",
    "steady_share",
    "dynamic_factor",
    "windup_deg",
    "speeds_to_avoid_rpm",
)
OFF = 0.01  # share by which a tuned law may miss its period ratio without a word
UNDAMPED = (
    "steady_share is null: without damping_ratio in [shaft], or --damping, what an index leaves "
    "never dies out, and there is no steady state"
)


def _warnings(mechanism: Mechanism, load: Oscillator, each: list[Station]) -> list[Caution]:
    out = []
    least = min(s.period_ratio for s in each)
    if least < 1.0:
        out.append(
            Caution(
                "short-motion",
                f"a motion takes only {least:.4g} natural periods of the load, which cannot follow "
                "it: a stiffer shaft, less inertia or a lower speed helps",
            )
        )
    law = mechanism.law
    tuned = law.tuned_to if law else None
    if tuned and not math.isclose(load.ratio, tuned, rel_tol=OFF):
        n_rpm = mechanism.spec.drive.n_rpm * load.ratio / tuned
        out.append(
            Caution(
                "off-tune",
                f"the law is tuned to a period ratio of {tuned:g}, and this is {load.ratio:.6g}: "
                f"n_rpm = {n_rpm:.6g} would meet it, or {(tuned / load.ratio) ** 2:.4g} times the "
                "stiffness",
            )
        )
    if not load.damping:
        out.append(Caution("not-known", UNDAMPED))
    return out


def vibration_table(mechanism: Mechanism, load: Oscillator | None) -> Table:
    """The record of ``geneva vibration``."""
    title = mechanism.spec.title
    head = {"spec": mechanism.spec.path, "title": title}
    return record_table(head | values(mechanism, load), title)


def spectrum(mechanism: Mechanism, load: Oscillator, samples: int) -> Table:
    """``samples`` speeds from half to twice the design's, each the same factor above the last."""
    check_samples(samples)
    n_rpm = mechanism.spec.drive.n_rpm
    speed = n_rpm * np.geomspace(SLOWER, FASTER, samples)
    ratio = load.ratio * (n_rpm / speed)
    each = each_share(mechanism, ratio, load.damping)
    steps = [2.0 * math.degrees(e.half_step) for e in mechanism.engagements]
    turned = np.max([share * step for share, step in zip(each, steps, strict=True)], axis=0)
    worst = worst_residuals(mechanism, ratio, load.damping)
    settled: object = [None] * samples
    if load.damping:
        settled = np.max(steady(mechanism, ratio, load.damping), axis=0)
    return Table(SPECTRUM, [speed, ratio, np.max(each, axis=0), turned, worst, settled])
