"""Results of ``geneva vibration``: a record at the design's speed, a spectrum over speed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from geneva_cli.errors import Notice
from geneva_cli.loads.load_case import unbalance_Nm
from geneva_cli.loads.vibration.centrifugal import STIFFEST, stiffness_ratio
from geneva_cli.loads.vibration.oscillator import NO_INERTIA, Oscillator
from geneva_cli.loads.vibration.vibration import (
    FASTER,
    SLOWER,
    Oscillators,
    SpeedToAvoid,
    Vibrations,
    oscillators_of,
    speeds_to_avoid,
    vibrations,
)
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import check_samples
from geneva_cli.table import Table, computed_table, record_table, rows_table

SPECTRUM_COLUMNS = (
    "n_rpm",
    "period_ratio",
    "residual_share",
    "residual_deg",
    "residual_share_worst",
    "steady_share",
)


def values(mechanism: Mechanism, load: Oscillator[float] | None) -> dict[str, Any]:
    """Named values, with equal names for every machine; all None if no inertia is known."""
    why = _unknown(mechanism, load)
    if load is None or why:
        return dict.fromkeys((*NUMBERS, "avoid", "stations")) | {
            "warnings": (Notice("not-known", f"no value is computed: {why}"),)
        }
    oscillators = oscillators_of(mechanism, load)
    avoid = speeds_to_avoid(mechanism, load)
    numbers = {name: float(x[0]) for name, x in vibrations(oscillators)._asdict().items()}
    each, lacks = _stations(oscillators), mechanism.output.lacks
    return {
        **{name: None if name in lacks else _known(x) for name, x in numbers.items()},
        "speeds_to_avoid_rpm": tuple(a.rpm for a in avoid),
        "avoid": rows_table(SpeedToAvoid._fields, avoid),
        "stations": rows_table(STATION_COLUMNS, each) if len(each) > 1 else None,
        "warnings": tuple(_warnings(mechanism, load, float(oscillators.ratio.min()))),
    }


def _unknown(mechanism: Mechanism, load: Oscillator[float] | None) -> str:
    """Return the reason why no value is computed; empty where there is none."""
    if load is None:
        return NO_INERTIA
    ratio = float(stiffness_ratio(mechanism, np.array([load.ratio])).max())
    if ratio <= STIFFEST:
        return ""
    return (
        "the centrifugal force of bodies off the wheel's axis acts as a spring of "
        f"{ratio:.3g} times the shaft's stiffness, above {STIFFEST:g}: use a stiffer shaft"
    )


def _stations(oscillators: Oscillators) -> list[tuple[float | None, ...]]:
    """Return a row of ``STATION_COLUMNS`` for each kind of index in a period."""
    factor = oscillators.swung_deg / oscillators.windup_deg
    every = (
        oscillators.ratio,
        oscillators.share,
        oscillators.residual_deg,
        factor,
        oscillators.windup_deg,
    )
    rows = np.array([*every, oscillators.steady_share])[:, :, 0].T
    return [tuple(_known(x) for x in row) for row in rows.tolist()]


def _known(number: float) -> float | None:
    """Return None for NaN, a number that is not known."""
    return None if math.isnan(number) else number


STATION_COLUMNS = (
    "period_ratio",
    "residual_share",
    "residual_deg",
    "dynamic_factor",
    "windup_deg",
    "steady_share",
)
NUMBERS = (*Vibrations._fields, "speeds_to_avoid_rpm")


def _warnings(mechanism: Mechanism, load: Oscillator[float], least: float) -> list[Notice]:
    out = []
    moment = math.hypot(*unbalance_Nm(mechanism))
    if moment:
        stiffness = mechanism.spec.shaft.stiffness_Nm_rad
        windup = (
            f", and winds it up by {math.degrees(moment / stiffness):.4g}°" if stiffness else ""
        )
        out.append(
            Notice(
                "unbalance-windup",
                "on the carrier the centrifugal force of the bodies off the wheel's axis puts up "
                f"to {moment:.4g} N m on the shaft{windup}, at rest too. The residuals are about "
                "that angle: balance the bodies",
            )
        )
    if least < 1.0:
        out.append(
            Notice(
                "short-motion",
                f"a motion takes only {least:.4g} natural periods of the load, too few to follow: "
                "use a stiffer shaft, less inertia or a lower speed",
            )
        )
    law = mechanism.input_law
    tuned = law.tuned_to if law else None
    # a tuned law may miss its period ratio by a hundredth
    if tuned and not math.isclose(load.ratio, tuned, rel_tol=0.01):
        n_rpm = mechanism.spec.drive.n_rpm * load.ratio / tuned
        out.append(
            Notice(
                "off-tune",
                f"the law is tuned to period ratio {tuned:g}, but this load has {load.ratio:.6g}: "
                f"set n_rpm = {n_rpm:.6g}, or use {(tuned / load.ratio) ** 2:.4g} times the "
                "stiffness",
            )
        )
    if why := _never_steady(mechanism, load):
        out.append(Notice("not-known", f"steady_share is not computed: {why}"))
    return out


def _never_steady(mechanism: Mechanism, load: Oscillator[float]) -> str:
    """Return the reason why there is no steady state; empty where there is one."""
    if mechanism.spec.wheel.stopped:
        return "the stop blocks the crank after z - 1 motions, too few for a steady state"
    if not load.damping:
        return (
            "without damping (damping_ratio in [shaft], or --damping) the vibration never dies "
            "out, and there is no steady state"
        )
    return ""


def vibration_table(mechanism: Mechanism, load: Oscillator[float] | None) -> Table:
    """Record of ``geneva vibration``."""
    title = mechanism.spec.title
    head = {"spec": mechanism.spec.path, "title": title}
    return record_table(head | values(mechanism, load), title)


def spectrum(mechanism: Mechanism, load: Oscillator[float], samples: int) -> Table:
    """Table of ``samples`` speeds from half to twice the design's, in geometric progression."""
    check_samples(samples)
    n_rpm = mechanism.spec.drive.n_rpm
    turns = mechanism.output.turns
    every = n_rpm * np.geomspace(SLOWER, FASTER, samples)

    def rows(begin: int, end: int) -> list[object]:
        speed = every[begin:end]
        ratio = load.ratio * (n_rpm / speed)
        oscillators = Oscillators(mechanism, Oscillator(ratio, np.full(len(speed), load.damping)))
        share, turned = oscillators.share.max(axis=0), oscillators.residual_deg.max(axis=0)
        known = not _never_steady(mechanism, load)
        settled = oscillators.steady_share.max(axis=0) if known else [None] * len(speed)
        if not turns:
            turned = [None] * len(speed)
        return [speed, ratio, share, turned, oscillators.worst_share, settled]

    return computed_table(SPECTRUM_COLUMNS, samples, rows)
