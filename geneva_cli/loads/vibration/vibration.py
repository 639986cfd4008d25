"""Vibration of a load on an elastic shaft, for oscillators at several speeds or a batch of designs.

The wheel turns by psi, the load by psi + r: r'' + 2 zeta wn r' + wn² r = -psi'', wn² = k / I. The
period ratio is the motion's time over 2 pi / wn. A residual is the amplitude after a motion that
began at rest; its share is the fraction of the wheel's step.
"""

import math
from collections.abc import Collection
from typing import Any

import numpy as np

from geneva_cli.errors import GenevaError, Notice
from geneva_cli.loads.load_case import inertia_kgm2
from geneva_cli.loads.vibration import swing as swings
from geneva_cli.loads.vibration.swing import Oscillator
from geneva_cli.motion.batch import designs_in, taken
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import check_samples
from geneva_cli.motion.peak_search import motion_peaks
from geneva_cli.motion.timing import timings
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import (
    Array,
    Complex,
    Whole,
    array,
    parameter,
    record_taken,
    value_or,
)
from geneva_cli.spec.rules import Range
from geneva_cli.table import Table, computed_table, rows_table

PERIOD_RATIO = Range(1e-6, 1e5)  # the range that is computed
DAMPING = Range(0.0, 1.0, "[)")
SOFTER, STIFFER = math.sqrt(0.8), math.sqrt(1.2)  # the natural frequency's at 20 % of stiffness
SLOWER, FASTER = 0.5, 2.0  # range of speeds over the design's
AVOIDED_SHARE = 1e-4  # least share of the step that makes a speed one to avoid
NAMES = (
    *("period_ratio", "damping_ratio", "natural_Hz"),
    *("residual_share", "residual_deg", "dynamic_factor", "windup_deg"),
)
SPECTRUM_COLUMNS = ("n_rpm", "period_ratio", "residual_share", "residual_deg")
# a speed with a local maximum of the residual, and its range for a stiffness of +-20 %
AVOID_COLUMNS = ("rpm", "from_rpm", "to_rpm", "residual_share")


def oscillator(
    mechanism: Mechanism, period_ratio: float | None = None, damping: float | None = None
) -> Oscillator:
    """The load from [shaft], or from the arguments.

    Raises GenevaError without a stiffness or an inertia, and for values out of range.
    """
    if damping is not None and damping not in DAMPING:
        raise GenevaError(f"--damping {damping:g}: must be {DAMPING}: at 1 nothing oscillates")
    key = ("shaft", "stiffness_Nm_rad") if period_ratio is None else ()
    own = _on_shafts(mechanism)
    if period_ratio is None:
        needed = "--period-ratio, the motion's time over the load's natural period"
        if not mechanism.output.turns:
            noun = mechanism.output.noun
            raise GenevaError(f"a {noun} has no shaft: use {needed}", ("wheel", "gearing"))
        if not np.isfinite(own.ratio[0]):
            raise GenevaError(
                "no natural period: set stiffness_Nm_rad in [shaft], between wheel and load, and "
                f"inertia_kgm2 in [load] or a [[mass]], or use {needed}",
                key,
            )
    ratio = own.ratio if period_ratio is None else np.array([period_ratio], dtype=float)
    if ratio[0] not in PERIOD_RATIO:
        raise GenevaError(
            f"a period ratio (motion time / natural period) of {ratio[0]:.4g}: must be "
            f"{PERIOD_RATIO.low:g} to {PERIOD_RATIO.high:g}",
            key,
        )
    return Oscillator(ratio, own.damping if damping is None else np.array([damping]))


def _on_shafts(mechanism: Mechanism) -> Oscillator:
    """The loads of m designs: the ratio is not finite without stiffness or inertia."""
    spec, m = mechanism.spec, mechanism.designs
    stiffness, inertia = value_or(spec.shaft.stiffness_Nm_rad, np.nan), array(inertia_kgm2(spec))
    with np.errstate(all="ignore"):
        natural_hz = parameter(np.sqrt(stiffness / inertia) / (2.0 * math.pi))
        ratio = timings(mechanism)[0].motion_s * natural_hz
    each = (np.broadcast_to(np.ravel(x), m) for x in (ratio, spec.shaft.damping_ratio))
    return Oscillator(*each)


class Oscillators:
    """n oscillators on a machine: each on one of its n designs, or all on one design.

    Arrays (stations, n) have a row for each engagement.
    """

    def __init__(self, mechanism: Mechanism, swing: Oscillator) -> None:
        self.mechanism, self.swing = mechanism, swing
        # one shape stands for designs whose motions are alike
        every, n = mechanism.engagements, len(swing.ratio)
        m = designs_in([one.motion for one in every])
        self.motion = np.arange(n) if m > 1 else np.zeros(n, dtype=np.intp)
        self.panels = [swings.motion_shapes(one.motion, m) for one in every]
        # its time over that of the machine's first motion
        self.scale = [np.ravel(one.motion_deg / every[0].motion_deg) for one in every]
        steps = [np.broadcast_to(np.ravel(2.0 * one.half_step), n) for one in every]
        self.steps = np.array(steps)  # radians
        self.ratio = np.array([swing.ratio * scale for scale in self.scale])
        # wind-up of the shaft at an acceleration of 1 step over the motion's time squared
        self.bent_deg = np.degrees(self.steps) / (2.0 * np.pi * self.ratio) ** 2
        self.share = np.abs(self.residuals(swing, self.motion))
        self.residual_deg = np.degrees(self.share * self.steps)

    def residuals(self, swing: Oscillator, motion: Whole) -> Complex:
        """Residual vibrations (stations, k) of k oscillators, as ``residual_swing`` has them."""
        rows = [
            swings.residual_swing(panels, motion, Oscillator(swing.ratio * scale, swing.damping))
            for panels, scale in zip(self.panels, self.scale, strict=True)
        ]
        return np.array(rows)


def vibrations(
    own: Oscillators, requested: Collection[str] = ("dynamic_factor",)
) -> dict[str, Array]:
    """The ``NAMES`` of each oscillator, (n,) each; of several motions the greatest.

    The dynamic factor takes time: it is NaN unless ``requested``.
    """
    windup, has_factor = 0.0 * own.swing.ratio, "dynamic_factor" in requested
    swung = windup if has_factor else windup + np.nan
    # I alpha / k at the greatest acceleration of the wheel, and of the load during the motion
    for i, engagement in enumerate(own.mechanism.engagements):
        most = motion_peaks(engagement.motion, ["acceleration"])["acceleration"].max
        whole = np.ravel(engagement.motion_deg * DEGREE)
        windup = np.maximum(windup, most * whole * whole / own.steps[i] * own.bent_deg[i])
        if has_factor:
            swing = Oscillator(own.ratio[i], own.swing.damping)
            most = swings.greatest_accelerations(own.panels[i], own.motion, swing)
            swung = np.maximum(swung, most * own.bent_deg[i])
    motion_s = np.ravel(timings(own.mechanism)[0].motion_s)
    residuals = own.share.max(axis=0), own.residual_deg.max(axis=0)
    rows = (*own.swing, own.swing.ratio / motion_s, *residuals, swung / windup, windup)
    return dict(zip(NAMES, rows, strict=True))


def design_vibrations(mechanism: Mechanism, requested: Collection[str]) -> dict[str, Array]:
    """The ``NAMES`` of m designs: NaN for one whose period ratio is unknown or out of range."""
    on_shafts = _on_shafts(mechanism)
    known = np.flatnonzero(PERIOD_RATIO.holds(on_shafts.ratio))
    out = np.full((len(NAMES), mechanism.designs), np.nan)
    for i in range(0, len(known), 128):  # designs at a time, whose panels take some 100 MB
        part = known[i : i + 128]
        own = Oscillators(taken(mechanism, part), record_taken(on_shafts, part))
        out[:, part] = list(vibrations(own, requested).values())
    return dict(zip(NAMES, out, strict=True))


def speeds_to_avoid(own: Oscillators) -> list[tuple[float, float, float, float]]:
    """Rows of ``AVOID_COLUMNS``: speeds where one oscillator's residual has a local maximum.

    They range from half to twice the design's. If engagements differ, the greatest residual counts.
    """
    n_rpm, ((own_ratio,), damping) = own.mechanism.spec.drive.n_rpm, own.swing

    def shares(ratio: Array) -> Array:
        swing = Oscillator(ratio, np.repeat(damping, len(ratio)))
        return np.abs(own.residuals(swing, np.zeros(len(ratio), dtype=np.intp)))

    out = []
    for k, (panels, (scale,)) in enumerate(zip(own.panels, own.scale, strict=True)):
        # Above some ratio no residual is that large: it is at most the variation of a derivative
        # over Omega to its order, and over sqrt(1 - zeta²). A panel has one or two extremes.
        variation = 4.0 * panels.left.size * panels.greatest[: 1 if panels.jumps[0] else 2, 0]
        most = variation / math.sqrt(1.0 - damping[0] * damping[0])
        omega = (most / AVOIDED_SHARE) ** (1.0 / np.arange(1, len(most) + 1))
        low = own_ratio / FASTER
        high = min(own_ratio / SLOWER, float(omega.min()) / (2.0 * math.pi) / scale)
        if low >= high:
            continue
        ratios = swings.local_maxima(shares, k, low, high)
        every = shares(ratios)
        # a maximum within 1e-12 of the greatest residual is equal to it
        kept = (every[k] >= AVOIDED_SHARE) & (every[k] >= every.max(axis=0) * (1.0 - 1e-12))
        for ratio, share in zip(ratios[kept].tolist(), every[k][kept].tolist(), strict=True):
            n = float(n_rpm * own_ratio / ratio)
            out.append((n, n * SOFTER, n * STIFFER, share))
    return sorted(out)


def values(mechanism: Mechanism, load: Oscillator) -> dict[str, Any]:
    """Named values of one design, with equal names for every machine."""
    own, lacks = Oscillators(mechanism, load), mechanism.output.lacks
    avoid, warnings = speeds_to_avoid(own), list[Notice]()
    if (least := float(own.ratio.min())) < 1.0:
        text = (
            f"a motion takes only {least:.4g} natural periods of the load, too few to follow: "
            "use a stiffer shaft, less inertia or a lower speed"
        )
        warnings.append(Notice("short-motion", text))
    return {
        **{name: None if name in lacks else x.item() for name, x in vibrations(own).items()},
        "speeds_to_avoid_rpm": tuple(row[0] for row in avoid),
        "avoid": rows_table(AVOID_COLUMNS, avoid),
        "warnings": tuple(mechanism.spec.accept.applied(warnings)),
    }


def spectrum(mechanism: Mechanism, load: Oscillator, samples: int) -> Table:
    """Table of ``samples`` speeds from half to twice the design's, in geometric progression."""
    check_samples(samples)
    n_rpm = mechanism.spec.drive.n_rpm
    every = n_rpm * np.geomspace(SLOWER, FASTER, samples)

    def rows(begin: int, end: int) -> list[object]:
        speed = every[begin:end]
        swing = Oscillator(load.ratio * (n_rpm / speed), np.repeat(load.damping, len(speed)))
        own = Oscillators(mechanism, swing)
        turned = own.residual_deg.max(axis=0) if mechanism.output.turns else [None] * len(speed)
        return [speed, swing.ratio, own.share.max(axis=0), turned]

    return computed_table(SPECTRUM_COLUMNS, samples, rows)
