"""Loads of many designs at once: what ``summary`` and ``loads.greatest`` give of one.

Every machine is answered for: friction, curved slots, linkages, several rollers. The formulas are
those of one design; all its stretches are found together, a block of designs after the other.

    >>> import numpy as np
    >>> from geneva_cli import External, Load, SideCrank
    >>> from geneva_cli.machine.many import many
    >>> from geneva_cli.machine.spec import Spec
    >>> spec = Spec(External(6), SideCrank(A=0.0), load=Load(inertia_kgm2=2.0, friction=0.1))
    >>> found = many(spec, {"drive.A": np.array([0.0, 0.6])})
    >>> greatest_of_many(found.machine, ["pin_force_N"])["pin_force_N"].max.round(4)
    array([1905.0702,  731.1404])
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from geneva_cli.analysis.loads.forces import setting
from geneva_cli.analysis.loads.groups_many import of_groups
from geneva_cli.analysis.loads.loaded_many import NONE, Loaded, Machine, Wanted, machine
from geneva_cli.analysis.loads.means_many import means_from, sources_of, sums
from geneva_cli.analysis.loads.quantities import FORCE, SQUARED, STRESS, outermost
from geneva_cli.analysis.loads.stretches_many import spans_of
from geneva_cli.analysis.loads.summary import ends_told
from geneva_cli.analysis.peaks_many import PeakOfMany, greater
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.search import search

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


class SummaryOfMany(NamedTuple):
    """As ``Summary``, of m designs: (m,) each; infinite where nothing bounds a value."""

    max: Array
    max_at_deg: Array
    min: Array
    min_at_deg: Array
    mean: Array | None = None  # None where not asked for
    rms: Array | None = None

    def times(self, share: Array) -> SummaryOfMany:
        """The summary of so many times the quantity."""
        mean, rms = (None if v is None else v * share for v in self[4:])
        return SummaryOfMany(
            self.max * share, self.max_at_deg, self.min * share, self.min_at_deg, mean, rms
        )


def greatest_of_many(
    mechanism: Mechanism, names: Sequence[str], own: Mapping[str, Wanted] = NONE
) -> dict[str, PeakOfMany]:
    """The greatest sizes of quantities, and the first input angles that have them: (m,).

    As ``loads.greatest`` gives them for one design; its ``torque_Nm`` is ``wheel_torque_Nm``.
    ``own`` are quantities that the cycle does not know, by their names.
    """
    given, best = setting(mechanism), dict[str, PeakOfMany]()
    flat = all(e.slot.walls_flat for e in mechanism.engagements)
    lent = {n: FORCE if flat and n == STRESS and given.hertz is not None else n for n in names}
    sought = list(dict.fromkeys(lent.values()))
    for found, at_deg, _ in _over_all(mechanism, sought, sized=True, told=(), own=own):
        for name, most, at in zip(sought, found, at_deg, strict=True):
            here = PeakOfMany(most, at)
            best[name] = greater(best[name], here) if name in best else here
    out = {}
    for name, source in lent.items():
        one = best[source]
        if source != name:  # the square of the stress on a flat wall goes with the force
            assert given.hertz is not None
            one = one._replace(max=one.max * np.ravel(given.hertz))
        out[name] = one._replace(max=np.sqrt(one.max)) if name in SQUARED else one
    return out


def summaries_of_many(
    mechanism: Mechanism, names: Sequence[str], told: Collection[str] = ("mean", "rms")
) -> dict[str, SummaryOfMany]:
    """The summaries of quantities over a period, by their names; signs kept.

    Extremes are within some units in the last place of a quantity's greatest size of those of one
    design; means, and roots of the mean square, within 1e-12 of that size: both are sums of what
    quadrature leaves of 2e-13, over stretches that may cancel. ``told`` says which of the two are
    asked for; of ``REACTIONS`` there are no means. One that is not told is None.
    """
    lent, sources = sources_of(mechanism, names)
    each: dict[str, list[Array]] = {name: [] for name in sources}
    whole: Array | None = None
    for found, at_deg, total in _over_all(mechanism, sources, sized=False, told=told):
        (most, low), (most_at, low_at) = np.split(found, 2), np.split(at_deg, 2)
        for i, name in enumerate(sources):
            each[name].append(np.stack((most[i], most_at[i], -low[i], low_at[i])))
        if total is not None:
            whole = total if whole is None else whole + total
    means = {} if whole is None else means_from(mechanism, sources, whole, "mean" in told)
    best: dict[str, SummaryOfMany] = {}
    for name, rows in each.items():
        one = SummaryOfMany(*outermost(np.stack(rows)))
        most, least = ends_told(name, one.max, one.min)
        one = one._replace(max=most, min=least)
        best[name] = one._replace(**means[name]._asdict()) if name in means else one
    return {name: best[source].times(share) for name, (source, share) in lent.items()}


def _over_all(
    mechanism: Mechanism,
    names: Sequence[str],
    *,
    sized: bool,
    told: Collection[str],
    own: Mapping[str, Wanted] = NONE,
) -> list[tuple[Array, Array, Array | None]]:
    """For each engagement the greatest values, their input angles as shown, and the integrals."""
    given = setting(mechanism)
    out = []
    for engagement in mechanism.engagements:
        every = machine(engagement, given, names, own)
        most, x, whole = _of(every, names, sized, told)
        places = np.reshape(engagement.mid_deg, (-1, 1)) + x.T
        shown = [mechanism.shown_deg(cast("float", places[:, i : i + 1])) for i in range(len(x))]
        out.append((most, np.hstack([np.broadcast_to(s, (x.shape[1], 1)) for s in shown]).T, whole))
    return out


def _of(
    every: Machine, names: Sequence[str], sized: bool, told: Collection[str]
) -> tuple[Array, Array, Array | None]:
    """The same for one engagement, at its own input angles."""

    def found(some: Machine, n: int) -> tuple[Array, Array, Array]:
        return _group(Loaded(some, names), n, sized, told)

    most, x, whole = of_groups(every, found)
    return most, x, whole if told else None


def _group(load: Loaded, n: int, sized: bool, told: Collection[str]) -> tuple[Array, Array, Array]:
    spans = spans_of(load.machine[0], n)
    if sized and load.repeats:
        spans = spans[: len(spans) // 2]
    known = load.at_mid_motion(n)
    found = search(load, spans, n, sized, known, load.spread)
    if not told:
        return found.most, found.x, found.most
    pieces = found.stretches
    bounded = np.asarray(np.isfinite(found.most).reshape(2, -1, n).all(axis=0))
    return found.most, found.x, sums(load, pieces, bounded, n, "mean" in told)
