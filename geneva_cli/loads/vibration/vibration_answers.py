"""Results of ``geneva vibration``: a record at the design's speed, a spectrum over speed."""

from __future__ import annotations

import math
from collections.abc import Iterator
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
    *("n_rpm", "period_ratio", "residual_share", "residual_deg", "residual_share_worst"),
    "steady_share",
)
STATION_COLUMNS = (
    *("period_ratio", "residual_share", "residual_deg", "dynamic_factor", "windup_deg"),
    "steady_share",
)
NUMBERS = (*Vibrations._fields, "speeds_to_avoid_rpm")


def values(mechanism: Mechanism, load: Oscillator[float] | None) -> dict[str, Any]:
    """Named values, with equal names for every machine; all None if no inertia is known."""
    why = NO_INERTIA
    if load:
        ratio = float(stiffness_ratio(mechanism, np.array([load.ratio])).max())
        why = (
            ""
            if ratio <= STIFFEST
            else (
                "the centrifugal force of bodies off the wheel's axis acts as a spring of "
                f"{ratio:.3g} times the shaft's stiffness, above {STIFFEST:g}: use a stiffer shaft"
            )
        )
    if load is None or why:
        return dict.fromkeys((*NUMBERS, "avoid", "stations")) | {
            "warnings": (Notice("not-known", f"no value is computed: {why}"),)
        }
    own, lacks = oscillators_of(mechanism, load), mechanism.output.lacks
    avoid = speeds_to_avoid(mechanism, load)
    numbers = {name: float(x[0]) for name, x in vibrations(own)._asdict().items()}
    factor = own.swung_deg / own.windup_deg
    warnings = _warnings(mechanism, load, float(own.ratio.min()))
    rows = (own.ratio, own.share, own.residual_deg, factor, own.windup_deg, own.steady_share)
    each = [tuple(map(_known, row)) for row in np.array(rows)[:, :, 0].T.tolist()]
    return {
        **{name: None if name in lacks else _known(x) for name, x in numbers.items()},
        "speeds_to_avoid_rpm": tuple(a.rpm for a in avoid),
        "avoid": rows_table(SpeedToAvoid._fields, avoid),
        "stations": rows_table(STATION_COLUMNS, each) if len(each) > 1 else None,
        "warnings": tuple(mechanism.spec.accept.applied(warnings)),
    }


def _known(number: float) -> float | None:
    return None if math.isnan(number) else number


def _warnings(mechanism: Mechanism, load: Oscillator[float], least: float) -> Iterator[Notice]:
    moment = math.hypot(*unbalance_Nm(mechanism))
    if moment:
        stiffness = mechanism.spec.shaft.stiffness_Nm_rad
        windup = (
            f", and winds it up by {math.degrees(moment / stiffness):.4g}°" if stiffness else ""
        )
        yield Notice(
            "unbalance-windup",
            "on the carrier the centrifugal force of the bodies off the wheel's axis puts up "
            f"to {moment:.4g} N m on the shaft{windup}, at rest too. The residuals are about "
            "that angle: balance the bodies",
        )
    if least < 1.0:
        yield Notice(
            "short-motion",
            f"a motion takes only {least:.4g} natural periods of the load, too few to follow: "
            "use a stiffer shaft, less inertia or a lower speed",
        )
    law = mechanism.input_law
    tuned = law.tuned_to if law else None
    # a tuned law may miss its period ratio by a hundredth
    if tuned and not math.isclose(load.ratio, tuned, rel_tol=0.01):
        n_rpm = mechanism.spec.drive.n_rpm * load.ratio / tuned
        yield Notice(
            "off-tune",
            f"the law is tuned to period ratio {tuned:g}, but this load has {load.ratio:.6g}: "
            f"set n_rpm = {n_rpm:.6g}, or use {(tuned / load.ratio) ** 2:.4g} times the "
            "stiffness",
        )
    if why := _never_steady(mechanism, load):
        yield Notice("not-known", f"steady_share is not computed: {why}")


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
    head = {"spec": mechanism.spec.path, "title": mechanism.spec.title}
    return record_table(head | values(mechanism, load), mechanism.spec.title)


def spectrum(mechanism: Mechanism, load: Oscillator[float], samples: int) -> Table:
    """Table of ``samples`` speeds from half to twice the design's, in geometric progression."""
    check_samples(samples)
    n_rpm = mechanism.spec.drive.n_rpm
    turns = mechanism.output.turns
    every = n_rpm * np.geomspace(SLOWER, FASTER, samples)

    def rows(begin: int, end: int) -> list[object]:
        speed = every[begin:end]
        ratio = load.ratio * (n_rpm / speed)
        swing = Oscillator(ratio, np.full(len(speed), load.damping))
        oscillators = Oscillators(mechanism, swing, speed / n_rpm)
        share, turned = oscillators.share.max(axis=0), oscillators.residual_deg.max(axis=0)
        known = not _never_steady(mechanism, load)
        settled = oscillators.steady_share.max(axis=0) if known else [None] * len(speed)
        if not turns:
            turned = [None] * len(speed)
        return [speed, ratio, share, turned, oscillators.worst_share, settled]

    return computed_table(SPECTRUM_COLUMNS, samples, rows)
