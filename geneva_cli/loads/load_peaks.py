"""The greatest, least and mean loads of designs; a single design is a batch of one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Generic, NamedTuple, TypeAlias, TypeVar, cast

import numpy as np

from geneva_cli.loads import contact
from geneva_cli.loads.instant import Instant, LoadQuantity, Own
from geneva_cli.loads.load_case import load_case, sources
from geneva_cli.loads.load_functions import LoadFunctions, on_breaks
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import retraces
from geneva_cli.motion.peak_search import PeakArray, greater
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import array, parameter
from geneva_cli.numerics.extremes import SearchResult, bar
from geneva_cli.numerics.jet import Array

# Loads whose greatest size a report shows, and their names in the cycle.
REPORTED_PEAKS = {
    "torque_Nm": "wheel_torque_Nm",
    "rack_force_N": "rack_force_N",
    "pin_force_N": "pin_force_N",
    "input_torque_Nm": "input_torque_Nm",
    "contact_stress_MPa": "contact_stress_MPa",
}

S = TypeVar("S", float, "float | None", Array)  # of one design, as printed, of a batch


class LoadSummary(NamedTuple, Generic[S]):
    """Greatest and least over the motions, mean and root mean square over a period: (m,) each."""

    max: S
    max_at_deg: S
    min: S
    min_at_deg: S
    mean: S | None = None  # None if not requested
    rms: S | None = None


def only(one: LoadSummary[Array]) -> LoadSummary[float]:
    """The summary of a single design."""
    known = one[:4] if one.mean is None else one
    return LoadSummary(*np.concatenate(cast("tuple[Array, ...]", known)).tolist())


Search: TypeAlias = tuple[LoadFunctions, SearchResult]  # of an engagement
Found: TypeAlias = tuple[dict[str, LoadSummary[Array]], list[Search]]


def load_peaks(
    mechanism: Mechanism,
    names: Sequence[str],
    own: Own = None,
    case: contact.LoadCase | None = None,
) -> dict[str, PeakArray]:
    """The greatest sizes of quantities, and the first input angles that have them: (m,)."""
    mechanism = mechanism.under_load
    case, best = case or load_case(mechanism), dict[str, PeakArray]()
    for engagement in mechanism.engagements:
        result = LoadFunctions(engagement, case, names, own).search(sized=True)
        at_deg = shown_deg(mechanism, engagement, result.x)
        for name, most, *places in zip(names, result.most, at_deg, strict=True):
            here = PeakArray(np.sqrt(most) if name in contact.SQUARED else most, *places)
            best[name] = greater(best[name], here) if name in best else here
    return best


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
    own: dict[str, LoadQuantity] = {
        "tangent": lambda i: contact.QuantityValue(i.at.offset / i.at.lever)
    }
    case = load_case(mechanism).lossless()._replace(inertia_Nm=0.0)
    peak = load_peaks(mechanism, tuple(own), own, case)["tangent"]
    angle = np.degrees(np.arctan(peak.max))
    return PeakArray(angle, np.where(angle > 0.0, peak.at_deg, 0.0))  # 0 throughout a radial slot


def reported_peaks(
    mechanism: Mechanism, names: Iterable[str] = REPORTED_PEAKS
) -> Mapping[str, PeakArray]:
    """The greatest sizes of those of ``REPORTED_PEAKS`` that a machine has, by their names."""
    single = isinstance(mechanism.design, int)
    return _single_peaks(mechanism) if single else _reported(mechanism, names)


def _reported(mechanism: Mechanism, names: Iterable[str] = REPORTED_PEAKS) -> dict[str, PeakArray]:
    known = sources(mechanism)
    factors = {name: known[own] for name in names if (own := REPORTED_PEAKS[name]) in known}
    peaks = load_peaks(mechanism, [s for s, _ in factors.values()]) if factors else {}
    return {
        name: PeakArray(peaks[source].max * np.ravel(factor), peaks[source].at_deg)
        for name, (source, factor) in factors.items()
    }


_single_peaks = lru_cache(maxsize=16)(_reported)


def load_summaries(
    mechanism: Mechanism, names: Sequence[str], means: bool = True
) -> Mapping[str, LoadSummary[Array]]:
    """The summaries of quantities over a period, by their names; signs kept.

    Extremes are exact to some units in the last place of a quantity's greatest size, means and root
    mean squares to 1e-12 of it.
    """
    if isinstance(mechanism.design, int) and set(names) <= sources(mechanism).keys():
        known_ones = single_summaries(mechanism) if means else single_extremes(mechanism)[0]
        return {name: known_ones[name] for name in names}
    found = _extremes(mechanism, names)
    return _with_means(mechanism.under_load, *found) if means else found[0]


@lru_cache(maxsize=16)
def single_summaries(mechanism: Mechanism) -> Mapping[str, LoadSummary[Array]]:
    """The summaries of all quantities that a single design has."""
    return _with_means(mechanism.under_load, *single_extremes(mechanism))


def _extremes(mechanism: Mechanism, names: Sequence[str] | None = None) -> Found:
    """The summaries of quantities without their means, and the searches for them.

    They are those of all quantities that the designs have, or of some by their names.
    """
    mechanism = mechanism.under_load
    known, every, sought = sources(mechanism), dict[str, tuple[str, float]](), list[str]()
    for name in known if names is None else names:
        source, _ = every[name] = known.get(name, (name, 1.0))
        sought += [source] if source not in sought else []
    case, searches, places = load_case(mechanism), list[Search](), list[Array]()
    for engagement in mechanism.engagements:
        load = LoadFunctions(engagement, case, sought)
        result = load.search()
        searches.append((load, result))
        places.append(np.stack((result.most, shown_deg(mechanism, engagement, result.x))))
    # by value and place, engagement, quantity: first the values, then those of the negatives
    rows, best = np.stack(places, axis=1), dict[str, LoadSummary[Array]]()
    for i, name in enumerate(sought):
        value, place = rows[:, :, i :: len(sought)]
        size = np.where(np.isfinite(value), np.abs(value), 0.0).max(axis=(0, 1))
        most = value.max(axis=0)
        first = np.argmax(value >= bar(most, size), axis=0)
        at_deg = np.take_along_axis(place, first[None], axis=0)[0]
        ends = most * [[1.0], [-1.0]]
        if name in contact.NEVER_NEGATIVE:
            ends = np.maximum(ends, 0.0)
        if name in contact.SQUARED and name not in contact.PRESSED:
            ends = np.sqrt(ends)
        # where the torque changes sign, rounding may leave a size of 1e-14 of the other
        level = 1e-14 * np.where(np.isfinite(ends), np.abs(ends), 0.0).max(axis=0)
        ends = np.where(np.abs(ends) > level, ends, 0.0)
        if name in contact.PRESSED:  # its square goes with the force, and has its rounding
            ends = np.sqrt(ends)
        best[name] = LoadSummary(ends[0], at_deg[0], ends[1], at_deg[1])
    out = {}
    for name, (source, factor) in every.items():
        one, by = best[source], np.ravel(factor)
        out[name] = one._replace(max=one.max * by, min=one.min * by)
    return out, searches


single_extremes = lru_cache(maxsize=16)(_extremes)  # of a single design


def _with_means(
    mechanism: Mechanism, ends: Mapping[str, LoadSummary[Array]], searches: Sequence[Search]
) -> dict[str, LoadSummary[Array]]:
    """Summaries with mean and root mean square over a period, dwells included.

    Of bearings they are the greatest crank's, of wheels one wheel's: the cranks work in turn, and
    so do the wheels on a carrier.
    """
    of_wheel = ("omega_rad_s", "alpha_rad_s2", "wheel_torque_Nm", "wheel_bearing_N")
    drive, names = mechanism.spec.drive, searches[0][0].names
    cranks, wheels = len(drive.cranks), max(1, drive.wheels_on_carrier)
    each = [_sums_of(load, result) for load, result in searches]
    total: Array = np.sum(each, axis=0)
    for i in range(len(total)):
        if names[i % len(names)] in of_wheel:
            total[i] /= wheels
        if names[i % len(names)] == "crank_bearing_N" and cranks > 1:
            own = [sum(one[i] for one in each[k::cranks]) for k in range(min(cranks, len(each)))]
            total[i] = np.max(own, axis=0) * min(1.0, len(each) / cranks)
    total /= np.ravel(mechanism.lasting_deg) * DEGREE
    squares, sums = total[: len(names)], total[len(names) :]
    # a mean whose square is so small a fraction of the mean square is rounding
    nought = np.isfinite(squares) & (sums * sums <= 1e-30 * squares)
    means, roots = np.where(nought, 0.0, sums), np.sqrt(squares)
    known, out = sources(mechanism), {}
    for name, one in ends.items():
        source, factor = known.get(name, (name, 1.0))
        i, by = names.index(source), np.ravel(factor)
        out[name] = one._replace(mean=means[i] * by, rms=roots[i] * by)
    return out


def shown_deg(mechanism: Mechanism, engagement: Engagement, x: Array) -> Array:
    """Input angles of an engagement, (rows, m), as they are shown."""
    places = np.reshape(engagement.mid_deg, (-1, 1)) + on_breaks(x, engagement).T
    return np.broadcast_to(mechanism.shown_deg(parameter(places)), places.shape).T


def _sums_of(load: LoadFunctions, result: SearchResult) -> Array:
    """The integrals by the angle in radians of the squares of the quantities, and of them.

    They are over the stretches of a search, (names, n), and infinite for quantities without a
    bound.
    """
    pieces, n = load.stretches(result), load.n
    needed = np.tile(np.isfinite(result.most).reshape(2, -1, n).all(axis=0), (2, 1))

    def functions(here: Instant, every: Sequence[str | LoadQuantity]) -> list[Array]:
        values = [array(here.quantity(of).value.c[0]) for of in every]
        both = list(zip(load.names, values, strict=True))
        squares = [value if name in contact.SQUARED else value * value for name, value in both]
        return [*squares, *(contact.plain_values(value, name) for name, value in both)]

    each = load.integrals(pieces, functions, needed)
    return np.array([np.bincount(pieces.design, row, n) for row in each])
