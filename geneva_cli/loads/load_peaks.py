"""The greatest, least and mean loads of designs; a single design is a batch of one."""

from collections.abc import Collection, Mapping, Sequence
from functools import lru_cache
from operator import itemgetter
from typing import Generic, NamedTuple, TypeVar, cast

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads import contact
from geneva_cli.loads.instant import NO_FUNCTIONS, Instant, LoadQuantity
from geneva_cli.loads.load_case import load_case, sources
from geneva_cli.loads.load_functions import LoadFunctions, on_breaks
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import retraces
from geneva_cli.motion.peak_search import PeakArray, greater
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, array, parameter
from geneva_cli.numerics.extremes import SearchResult, bar

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


def load_peaks(
    mechanism: Mechanism,
    names: Sequence[str] = (),
    own: Mapping[str, LoadQuantity] = NO_FUNCTIONS,
    case: contact.LoadCase | None = None,
) -> dict[str, PeakArray]:
    """The greatest sizes of quantities, and the first input angles that have them: (m,).

    ``own`` are functions, by their names, besides the ``names`` of known quantities.
    """
    mechanism = mechanism.under_load
    case, best = case or load_case(mechanism), dict[str, PeakArray]()
    for engagement in mechanism.engagements:
        load = LoadFunctions(engagement, case, names, own)
        result = load.search(sized=True)
        at_deg = shown_deg(mechanism, engagement, result.x)
        for name, most, *places in zip(load.names, result.most, at_deg, strict=True):
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
    peak = load_peaks(mechanism, own=own, case=case)["tangent"]
    angle = np.degrees(np.arctan(peak.max))
    return PeakArray(angle, np.where(angle > 0.0, peak.at_deg, 0.0))  # 0 throughout a radial slot


def reported_peaks(
    mechanism: Mechanism, names: Collection[str] = REPORTED_PEAKS.keys()
) -> dict[str, PeakArray]:
    """The greatest sizes of those of ``REPORTED_PEAKS`` that a machine has, by their names."""
    known, out = sources(mechanism), dict[str, PeakArray]()
    own = {name: load for name, load in REPORTED_PEAKS.items() if name in names and load in known}
    ends = load_summaries(mechanism, [*own.values()], means=False) if own else {}
    for name, load in own.items():
        one = ends[load]
        least = PeakArray(-one.min, one.min_at_deg)
        out[name] = greater(PeakArray(one.max, one.max_at_deg), least)
    return out


def load_summaries(
    mechanism: Mechanism, names: Sequence[str], means: bool = True
) -> dict[str, LoadSummary[Array]]:
    """The summaries of quantities over a period, by their names; signs kept.

    Extremes are exact to some units in the last place of a quantity's greatest size, means and root
    mean squares to 1e-12 of it.
    """
    known, single = sources(mechanism), isinstance(mechanism.design, int)
    if single and known.keys() >= {*names}:  # all are computed at once, and kept
        every = [*known.values()]
    else:
        every = [known.get(name, (name, 1.0)) for name in names]
    sought = tuple(dict.fromkeys(map(itemgetter(0), every)))
    found = (_single_summaries if single else _Summaries)(mechanism, sought)
    rows, out = found.extremes, dict[str, LoadSummary[Array]]()
    if means:
        rows = np.concatenate((rows, found.means))
    for name in names:
        source, factor = known.get(name, (name, 1.0))
        own = rows[:, sought.index(source)]
        scaled = own * np.ravel(factor)
        scaled[[1, 3]] = own[[1, 3]]  # input angles
        out[name] = LoadSummary(*scaled)
    return out


class _Summaries:
    """The summaries of quantities of m designs by their names, each computed at its first use."""

    def __init__(self, mechanism: Mechanism, names: tuple[str, ...]) -> None:
        self.mechanism, self.names = mechanism.under_load, names
        case, self.searches = load_case(mechanism), list[tuple[LoadFunctions, SearchResult]]()
        for engagement in self.mechanism.engagements:
            load = LoadFunctions(engagement, case, names)
            self.searches.append((load, load.search()))

    @cached_property
    def extremes(self) -> Array:
        """Greatest and least values, each with its input angles: (4, names, m)."""
        rows = list[tuple[Array, Array]]()
        for load, result in self.searches:
            rows.append((result.most, shown_deg(self.mechanism, load.engagement, result.x)))
        # of each engagement first the values, then those of the negatives
        shape = len(rows), 2, 2, len(self.names), self.mechanism.designs
        value, place = np.reshape(rows, shape).swapaxes(0, 1)
        size = np.where(np.isfinite(value), np.abs(value), 0.0).max(axis=(0, 1))
        most = value.max(axis=0)
        first = np.argmax(value >= bar(most, size), axis=0)
        at_deg = np.take_along_axis(place, first[None], axis=0)[0]
        names, ends = np.array(self.names, dtype=str)[:, None], np.stack((most[0], -most[1]))
        ends = np.where(np.isin(names, contact.NEVER_NEGATIVE), np.maximum(ends, 0.0), ends)
        squared, pressed = np.isin(names, contact.SQUARED), np.isin(names, contact.PRESSED)
        with np.errstate(invalid="ignore"):  # of values that are no squares
            ends = np.where(squared & ~pressed, np.sqrt(ends), ends)
            # where the torque changes sign, rounding may leave a size of 1e-14 of the other
            level = 1e-14 * np.where(np.isfinite(ends), np.abs(ends), 0.0).max(axis=0)
            ends = np.where(np.abs(ends) > level, ends, 0.0)
            # the square of a stress goes with the force, and has its rounding
            ends = np.where(pressed, np.sqrt(ends), ends)
        return np.stack((ends[0], at_deg[0], ends[1], at_deg[1]))

    @cached_property
    def means(self) -> Array:
        """Mean and root mean square over a period, dwells included: (2, names, m).

        Of bearings they are the greatest crank's, of wheels one wheel's: the cranks work in turn,
        and so do the wheels on a carrier.
        """
        of_wheel = ("omega_rad_s", "alpha_rad_s2", "wheel_torque_Nm", "wheel_bearing_N")
        each, drive = np.array([_sums_of(*one) for one in self.searches]), self.mechanism.spec.drive
        total, cranks = each.sum(axis=0), len(drive.cranks)
        for i, name in enumerate(self.names):
            if name in of_wheel:
                total[:, i] /= max(1, drive.wheels_on_carrier)
            if name == "crank_bearing_N" and cranks > 1:
                own = [each[k::cranks, :, i].sum(axis=0) for k in range(min(cranks, len(each)))]
                total[:, i] = np.max(own, axis=0) * min(1.0, len(each) / cranks)
        squares, sums = total / (np.ravel(self.mechanism.lasting_deg) * DEGREE)
        # a mean whose square is so small a fraction of the mean square is rounding
        nought = np.isfinite(squares) & (sums * sums <= 1e-30 * squares)
        return np.stack((np.where(nought, 0.0, sums), np.sqrt(squares)))


_single_summaries = lru_cache(maxsize=16)(_Summaries)


def shown_deg(mechanism: Mechanism, engagement: Engagement, x: Array) -> Array:
    """Input angles of an engagement, (rows, m), as they are shown."""
    places = np.reshape(engagement.mid_deg, (-1, 1)) + on_breaks(x, engagement).T
    return np.broadcast_to(mechanism.shown_deg(parameter(places)), places.shape).T


def _sums_of(load: LoadFunctions, result: SearchResult) -> Array:
    """The integrals by the angle in radians of the squares of the quantities, and of them.

    They are over the stretches of a search, (2, names, n), and infinite for quantities without a
    bound.
    """
    pieces, n = load.stretches(result), load.n
    needed = np.tile(np.isfinite(result.most).reshape(2, -1, n).all(axis=0), (2, 1))

    def functions(here: Instant, every: Sequence[LoadQuantity]) -> list[Array]:
        values = [array(of(here).value.c[0]) for of in every]
        both = list(zip(load.names, values, strict=True))
        squares = [value if name in contact.SQUARED else value * value for name, value in both]
        return [*squares, *(contact.plain_values(value, name) for name, value in both)]

    each = load.integrals(pieces, functions, needed)
    return np.reshape([np.bincount(pieces.design, row, n) for row in each], (2, -1, n))
