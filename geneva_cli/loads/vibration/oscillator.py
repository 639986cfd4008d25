"""The load as an oscillator, from the spec's shaft and inertia, or from a period ratio."""

from __future__ import annotations

import math
from typing import Generic, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.carried import inertia_kgm2
from geneva_cli.motion.engagement import K
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.timing import timings
from geneva_cli.numerics.arrays import Complex, library
from geneva_cli.spec.rules import Range

PERIOD_RATIO = Range(1e-6, 1e5)  # the range that is computed
RATIOS = f"{PERIOD_RATIO.low:g} to {PERIOD_RATIO.high:g}"
STIFFNESS = ("shaft", "stiffness_Nm_rad")
NO_INERTIA = (
    "a load without inertia has no natural period; set inertia_kgm2 in [load] or a [[mass]], or "
    "use --period-ratio"
)


class Oscillator(NamedTuple, Generic[K]):
    """Loads on their shafts: period ratios of the first motion, and damping ratios below 1.

    Floats of one load, arrays of several.
    """

    ratio: K
    damping: K

    @property
    def p(self) -> Complex:
        """Complex rate p of each, by the motion's time."""
        zeta = np.asarray(self.damping)
        return 2.0 * np.pi * self.ratio * (-zeta + 1j * np.sqrt(1.0 - zeta * zeta))


def oscillator(
    mechanism: Mechanism, period_ratio: float | None = None, damping: float | None = None
) -> Oscillator[float] | None:
    """The load from [shaft], or from the arguments; None if no inertia is known.

    Raises GenevaError without a stiffness, and for values out of range.
    """
    shaft = mechanism.spec.shaft
    allowed = Range(0.0, 1.0, "[)")
    if damping is not None and damping not in allowed:
        raise GenevaError(f"--damping {damping:g}: must be {allowed}: at 1 nothing oscillates")
    zeta = shaft.damping_ratio if damping is None else damping
    if period_ratio is not None:
        if period_ratio not in PERIOD_RATIO:
            raise GenevaError(f"--period-ratio {period_ratio:g}: must be {RATIOS}")
        return Oscillator(period_ratio, zeta)
    if not mechanism.output.turns:
        raise GenevaError(
            f"a {mechanism.output.noun} has no shaft: use --period-ratio, the motion's time over "
            "the load's natural period",
            ("wheel", "gearing"),
        )
    if shaft.stiffness_Nm_rad is None:
        raise GenevaError(
            "no stiffness_Nm_rad in [shaft]: set the stiffness between wheel and load, or use "
            "--period-ratio, the motion's time over the load's natural period",
            STIFFNESS,
        )
    inertia = inertia_kgm2(mechanism.spec)
    if not inertia:
        return None
    ratio = period_ratio_of(mechanism, shaft.stiffness_Nm_rad, inertia)
    if ratio not in PERIOD_RATIO:
        raise GenevaError(
            f"stiffness_Nm_rad = {shaft.stiffness_Nm_rad:g} with {inertia:g} kg m² gives a period "
            f"ratio (motion time / natural period) of {ratio:.4g}: it must be {RATIOS}",
            STIFFNESS,
        )
    return Oscillator(ratio, zeta)


def period_ratio_of(mechanism: Mechanism, stiffness_Nm_rad: float, inertia_kgm2: float) -> float:
    """Time of the first motion over the load's natural period; (m, 1) for m designs."""
    squared = stiffness_Nm_rad / inertia_kgm2
    natural_hz = library(squared).sqrt(squared) / (2.0 * math.pi)
    return timings(mechanism)[0].motion_s * natural_hz


def required_oscillator(
    mechanism: Mechanism, period_ratio: float | None = None, damping: float | None = None
) -> Oscillator[float]:
    """The load as an oscillator. Raises GenevaError if no inertia is known."""
    load = oscillator(mechanism, period_ratio, damping)
    if load is None:
        raise GenevaError(NO_INERTIA, STIFFNESS)
    return load
