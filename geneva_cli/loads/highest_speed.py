"""The greatest pressure angle of a machine, and the highest speed that keeps its limits."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.carried import inertia_kgm2
from geneva_cli.loads.contact import LoadCase, QuantityValue
from geneva_cli.loads.cycle_quantities import FORCE, STRESS, TORQUE
from geneva_cli.loads.instant import Instant, LoadQuantity
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_functions import LoadFunctions
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import PeakArray
from geneva_cli.motion.pitch_curve import retraces
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import parameter
from geneva_cli.numerics.jet import Jet
from geneva_cli.spec.load_limits import load_limits


def _slope_squared(i: Instant[Jet]) -> QuantityValue[Jet]:
    """The square of the pressure angle's tangent."""
    slope = i.at.offset / i.at.lever
    return QuantityValue(slope * slope)


def greatest_pressure(mechanism: Mechanism) -> PeakArray:
    """The greatest pressure angles of m designs, degrees, and their input angles: (m,).

    It is 90 at mid-motion if the pin crosses the radius there; NaN for a batch whose designs
    differ.
    """
    for engagement in mechanism.engagements:
        crosses = np.logical_not(retraces(engagement)) & engagement.slot.curved
        if np.any(crosses):
            at_deg = np.ravel(mechanism.shown_deg(engagement.mid_deg))
            known = np.full(mechanism.designs, 0.0 if np.all(crosses) else np.nan)
            return PeakArray(90.0 + known, at_deg + known)
    own: dict[str, LoadQuantity] = {"slope": _slope_squared}
    case = load_case(mechanism)._replace(inertia_Nm=0.0, hertz=None, efficiency=1.0).frictionless
    peak = load_peaks(mechanism, tuple(own), own, case)["slope"]
    angle = np.degrees(np.arctan(np.sqrt(peak.max)))
    return PeakArray(angle, np.where(angle > 0.0, peak.at_deg, 0.0))  # 0 throughout a radial slot


@lru_cache(maxsize=16)
def fastest_rpm(mechanism: Mechanism) -> float | None:
    """The highest input speed at which the limits on force, torque and stress hold.

    Infinite if they hold at any speed or there are none; None if no speed keeps them.
    """
    mechanism, limited = mechanism.under_load, load_limits(mechanism.spec.limits)
    n_rpm = mechanism.spec.drive.n_rpm
    at_one = load_case(mechanism).at_speed(1.0 / omega(n_rpm))  # at 1 rad/s
    at_one = at_one._replace(inertia_Nm=inertia_kgm2(mechanism.spec))  # with all its digits
    if at_one.hertz is None:
        limited.pop(STRESS, None)
    if not limited:
        return math.inf
    own, eta = dict[str, LoadQuantity](), at_one.efficiency
    for name, limit in limited.items():
        if name == FORCE:
            own[name] = Slowness(lambda i: i.force_N, limit, at_one)
        elif name == STRESS:
            own[name] = Slowness(lambda i: i.stress_squared, limit * limit, at_one)
        else:
            own[TORQUE] = Slowness(lambda i: i.lossless_torque_Nm * (1.0 / eta), limit, at_one)
            own["driven"] = Slowness(lambda i: -i.lossless_torque_Nm, limit, at_one)
    still, least = at_one._replace(resists_Nm=0.0), 0.0
    for engagement in mechanism.engagements:
        result = LoadFunctions(engagement, still, tuple(own), own).search()
        least = max(least, float(result.most[: len(own)].max()))
    rpm = math.sqrt(1.0 / least) / omega(1.0) if least > 0.0 else math.inf
    # Lower speeds may break a limit where inertia helps against the resistance, and so may this
    # speed.
    tried = at_one.at_speed(omega(n_rpm if math.isinf(rpm) else rpm))
    peaks = load_peaks(mechanism, tuple(limited), case=tried)
    # a limit that is reached at the highest speed may be exceeded by rounding
    kept = all(peaks[name].max[0] <= limit * (1.0 + 1e-9) for name, limit in limited.items())
    return rpm if kept else None


class Slowness(NamedTuple):
    """1 / (highest speed that a place allows)²: w² = (limit - q1 M) / q, q1 the load of M = 1."""

    of: Callable[[Instant[Jet]], Jet | None]
    limit: float
    case: LoadCase  # at 1 rad/s

    def __call__(self, i: Instant[Jet]) -> QuantityValue[Jet]:
        """The quantity, which is unbounded where the place allows no speed."""
        unit = self.case.at_speed(0.0)._replace(resists_Nm=1.0)
        factor, load = self.of(Instant(unit, i.at, i.drives, i.slides, i.feeds)), self.of(i)
        assert factor is not None and load is not None  # there is a face width
        left = self.limit - factor * self.case.resists_Nm
        # Where the wheel is not driven, any speed keeps the limit. The margin is then that next to
        # it, as at rest the load's sign is rounding.
        over = (np.asarray(load.c[0]) <= 0.0) & (np.asarray(left.c[0]) < 0.0)
        return QuantityValue(load / left, Jet([np.where(over, -c, c) for c in left.c]))


def kinetic_power_W(mechanism: Mechanism, power_invariant: float) -> float:
    """Peak power that the inertia takes from the input, W: I epsilon omega / eta."""
    spec, w = mechanism.spec, omega(mechanism.spec.drive.n_rpm)
    if not mechanism.frame:
        return inertia_kgm2(spec) * power_invariant * w**3 / spec.load.efficiency
    case = load_case(mechanism)._replace(resists_Nm=0.0, efficiency=1.0).frictionless
    torque = load_peaks(mechanism, (TORQUE,), case=case)[TORQUE].max
    one = isinstance(power_invariant, float)
    return (float(torque[0]) if one else parameter(torque[:, None])) * w / spec.load.efficiency
