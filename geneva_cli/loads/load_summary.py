"""The summary of a load over a period, from the results of each engagement."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from geneva_cli.loads.cycle_quantities import NEVER_NEGATIVE, PRESSED, SQUARED, multiples, outermost
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.jet import Array

S = TypeVar("S", float, "float | None", Array)  # of one design, as printed, of a batch


class LoadSummary(NamedTuple, Generic[S]):
    """Greatest and least over the motions, mean and root mean square over a period.

    Input angles are as shown; values are infinite if unbounded. Each is (m,) for m designs, or a
    number of one; as it is printed, None for a value that is not known.
    """

    max: S
    max_at_deg: S
    min: S
    min_at_deg: S
    mean: S | None = None  # None if not requested
    rms: S | None = None


class EngagementExtremes(NamedTuple):
    """Greatest values over one engagement, their places, and the sums; one row for each quantity.

    For signed extremes, the greatest values of the quantities' negatives follow.
    """

    most: Array
    at_deg: Array  # as shown
    total: Array | None  # the result of ``sums_of``


def summaries_from(
    mechanism: Mechanism, names: Sequence[str], each: Sequence[EngagementExtremes], plain: bool
) -> dict[str, LoadSummary[Array]]:
    """The summaries of quantities, from the results of their sources in each engagement.

    With ``plain`` the sums include those of the quantities, besides those of their squares.
    """
    multiple_of, sources = sources_of(mechanism, names)
    totals = [one.total for one in each if one.total is not None]
    means = means_from(mechanism, sources, totals, plain) if totals else {}
    best: dict[str, LoadSummary[Array]] = {}
    for i, name in enumerate(sources):
        k = i + len(sources)
        rows = [(one.most[i], one.at_deg[i], -one.most[k], one.at_deg[k]) for one in each]
        most, most_at, least, least_at = outermost(np.array(rows))
        most, least = _ends_of(name, most, least)
        mean, rms = means.get(name, (None, None))
        best[name] = LoadSummary(most, most_at, least, least_at, mean, rms)
    return {name: _multiple(best[source], factor) for name, (source, factor) in multiple_of.items()}


def _multiple(one: LoadSummary[Array], factor: Array) -> LoadSummary[Array]:
    """The summary of a multiple of the quantity."""
    mean, rms = (None if v is None else v * factor for v in one[4:])
    return LoadSummary(
        one.max * factor, one.max_at_deg, one.min * factor, one.min_at_deg, mean, rms
    )


def _ends_of(name: str, most: Array, least: Array) -> list[Array]:
    """Greatest and least of a quantity, from those of its square or of itself.

    Where the torque changes sign, rounding may leave a size below 0. Either value is replaced by 0
    if it is rounding compared with the other.
    """
    ends = [np.maximum(x, 0.0) if name in NEVER_NEGATIVE else np.asarray(x) for x in (most, least)]
    if name in PRESSED:  # the square goes with the force, and has its rounding
        return [np.sqrt(x) for x in _without_rounding(ends)]
    return _without_rounding([np.sqrt(x) if name in SQUARED else x for x in ends])


def _without_rounding(ends: Sequence[Array]) -> list[Array]:
    """Greatest and least, 0 for one that is below 1e-14 of the other: that is rounding."""
    level = 1e-14 * np.maximum(*[np.where(np.isfinite(x), np.abs(x), 0.0) for x in ends])
    return [np.where(np.abs(x) > level, x, 0.0) for x in ends]


def sources_of(
    mechanism: Mechanism, names: Sequence[str]
) -> tuple[dict[str, tuple[str, Array]], list[str]]:
    """Each quantity's source and its ratio to it, (m,) or (1,); and the names of all sources."""
    known = multiples(mechanism)
    every = {n: known.get(n, (n, 1.0, ""))[:2] for n in names}
    multiple_of = {
        n: (source, np.ravel(factor)) for n, (source, factor) in every.items() if factor is not None
    }
    return multiple_of, list(dict.fromkeys(source for source, _ in every.values()))


def means_from(
    mechanism: Mechanism, names: Sequence[str], each: Sequence[Array], plain: bool
) -> dict[str, tuple[Array | None, Array]]:
    """Mean and root mean square of quantities over a period.

    ``each`` are the integrals over each engagement, as ``sums_of`` returns them. The results are
    (m,) each, dwells included, and infinite if unbounded. Without ``plain`` the mean is None.
    """
    every, out = _in_period(mechanism, names, each), {}
    every /= np.ravel(mechanism.under_load.period_deg) * DEGREE
    for i, name in enumerate(names):
        square, mean = every[i], None
        if plain:
            mean = every[len(names) + i]
            # a mean whose square is so small a fraction of the mean square is rounding
            nought = np.isfinite(square) & (mean * mean <= 1e-30 * square)
            mean = np.where(nought, 0.0, mean)
        out[name] = mean, np.sqrt(square)
    return out


def _in_period(mechanism: Mechanism, names: Sequence[str], each: Sequence[Array]) -> Array:
    """The integrals over a period; of bearings the greatest crank's, of wheels one wheel's.

    The cranks work in turn. So do the wheels on a carrier, which are all alike.
    """
    drive = mechanism.spec.drive
    of_wheel = ("omega_rad_s", "alpha_rad_s2", "wheel_torque_Nm", "wheel_bearing_N")
    cranks, wheels = len(drive.cranks), max(1, drive.wheels_on_carrier)
    total: Array = np.sum(each, axis=0)
    for i in range(len(total)):
        if names[i % len(names)] in of_wheel:
            total[i] /= wheels
        if names[i % len(names)] == "crank_bearing_N" and cranks > 1:
            own = [sum(one[i] for one in each[k::cranks]) for k in range(min(cranks, len(each)))]
            total[i] = np.max(own, axis=0) * min(1.0, len(each) / cranks)
    return total
