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
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from geneva_cli.analysis.loads.contact import NEAR, mirrored
from geneva_cli.analysis.loads.cycle import AHEAD, SHARES, Cycle
from geneva_cli.analysis.loads.forces import setting
from geneva_cli.analysis.loads.loaded_many import (
    REACTIONS,
    At,
    Loaded,
    Machine,
    Wanted,
    look,
    machine,
)
from geneva_cli.analysis.loads.means import NOUGHT, square_of
from geneva_cli.analysis.loads.quantities import FORCE, SQUARED, STRESS
from geneva_cli.analysis.loads.stretches_many import mirror_images, spans_of, stretches_of
from geneva_cli.analysis.loads.summary import ends_told, shares
from geneva_cli.analysis.peaks_many import PeakOfMany, greater
from geneva_cli.machine.many import taken
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.quadrature_many import integrals_many
from geneva_cli.numerics.roots import TIE
from geneva_cli.numerics.signed_many import Found, search

if TYPE_CHECKING:
    from geneva_cli.machine.spec import Spec
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array

GROUP = 4096  # designs whose stretches are found together
NONE: Mapping[str, Wanted] = MappingProxyType({})  # quantities of one's own


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
    quadrature leaves of 1e-13, over stretches that may cancel. ``told`` says which of the two are
    asked for; of ``REACTIONS`` there are no means. One that is not told is None.
    """
    known = shares(Cycle(mechanism))
    lent = {n: known.get(n, (n, 1.0, ""))[:2] for n in names}
    sources = list(dict.fromkeys(source for source, _ in lent.values()))
    best: dict[str, SummaryOfMany] = {}
    sums: Array | None = None
    for found, at_deg, total in _over_all(mechanism, sources, sized=False, told=told):
        for i, name in enumerate(sources):
            here = SummaryOfMany(found[2 * i], at_deg[2 * i], -found[2 * i + 1], at_deg[2 * i + 1])
            best[name] = _outer(best[name], here) if name in best else here
        if total is not None:
            sums = total if sums is None else sums + total
    joined = any(engagement.reactions for engagement in mechanism.engagements)
    period = np.ravel(mechanism.period_deg) * DEGREE
    for i, name in enumerate(sources):
        one = best[name]
        bounded = np.isfinite(one.max) & np.isfinite(one.min)
        most, least = ends_told(name, one.max, one.min)
        one = one._replace(max=most, min=least)
        if sums is not None:
            square = np.where(bounded, sums[i] / period, np.inf)
            one = one._replace(rms=np.sqrt(square))
            if "mean" in told and not (joined and name in REACTIONS):
                mean = np.where(bounded, sums[len(sources) + i] / period, np.inf)
                nought = bounded & (mean * mean <= NOUGHT * square)
                one = one._replace(mean=np.where(nought, 0.0, mean))
        best[name] = one
    return {
        name: best[source].times(np.ravel(share))
        for name, (source, share) in lent.items()
        if share is not None
    }


def _over_all(
    mechanism: Mechanism,
    names: Sequence[str],
    *,
    sized: bool,
    told: Collection[str],
    own: Mapping[str, Wanted] = NONE,
) -> list[tuple[Array, Array, Array | None]]:
    """For each engagement the greatest values, their input angles as shown, and the integrals."""
    given, analytic = setting(mechanism), is_analytic(mechanism.spec)
    out = []
    for engagement in mechanism.engagements:
        every = machine(engagement, given, names, own)
        most, x, sums = _of(every, names, sized, told, analytic)
        places = np.reshape(engagement.mid_deg, (-1, 1)) + x.T
        shown = [mechanism.shown_deg(cast("float", places[:, i : i + 1])) for i in range(len(x))]
        out.append((most, np.hstack([np.broadcast_to(s, (x.shape[1], 1)) for s in shown]).T, sums))
    return out


def is_analytic(spec: Spec) -> bool:
    """Whether loads are analytic within their stretches: points have knots."""
    return spec.drive.ANALYTIC and (spec.motion is None or spec.motion.law.ANALYTIC)


def count(every: Machine) -> int:
    """How many designs they are."""
    engagement, given, wanted = every
    motion = engagement.motion
    own = [value for one in wanted if isinstance(one, tuple) for value in one]
    known = (motion(motion.entry_deg, 1).c[1], motion.entry_deg, *given, *own)
    return max(np.size(value) for value in known if isinstance(value, np.ndarray | float))


def _of(
    every: Machine, names: Sequence[str], sized: bool, told: Collection[str], analytic: bool
) -> tuple[Array, Array, Array | None]:
    """The same for one engagement, at its own input angles."""
    m, parts = count(every), []
    for i in range(0, m, GROUP):
        some = taken(every, slice(i, i + GROUP))
        parts.append(_group(Loaded(some, names), min(GROUP, m - i), sized, told, analytic))
    most, x, sums = (np.concatenate(part, axis=1) for part in zip(*parts, strict=True))
    return most, x, sums if told else None


def _group(
    load: Loaded, n: int, sized: bool, told: Collection[str], analytic: bool
) -> tuple[Array, Array, Array]:
    spans = spans_of(load.machine[0], n)
    if sized and load.repeats:
        spans = spans[: len(spans) // 2]
    found = search(load, spans, n, sized, load.at_mid_motion(n))
    sums = _sums(load, found, spans, n, "mean" in told, analytic) if told else found.most
    return found.most, found.x, sums


def _sums(
    load: Loaded,
    found: Found,
    spans: Sequence[tuple[Array, Array]],
    n: int,
    plain: bool,
    analytic: bool,
) -> Array:
    """The integrals by the angle in radians of the squares, and of the quantities where ``plain``.

    Only a quantity whose square is looked for goes with a root at the ends of its stretches.
    """
    pieces = stretches_of(load, spans, found.cuts)
    every = np.arange(len(pieces.design))
    # of a mirrored motion the second half goes with the first, as functions of their own
    other = mirror_images(pieces) if load.mirrored else every
    kept = np.flatnonzero(every <= other)
    # those of one span together: a motion of several pieces is asked for one of them at a time
    kept = kept[np.argsort(pieces.span[kept], kind="stable")]
    design, (a, b), other = pieces.design[kept], pieces.x[:, kept], other[kept]
    signs = np.where(pieces.positive, 1.0, -1.0)
    sides = signs[:, kept], signs[:, other]
    paired = other != every[kept]

    def rows(x: Array, which: Whole) -> Array:
        given, at, shape, wanted = state = load.at(x, design[which], 0)
        here = _powers(load, state, sides[0][:, which, None], plain)
        if not paired.any():
            return here
        image = given, mirrored(at), shape, wanted
        back = _powers(load, image, sides[1][:, which, None], plain)
        back[:, ~paired[which]] = 0.0
        return np.concatenate((here, back))

    rooted = plain and any(name in SQUARED for name in load.names)
    parts = (2 if plain else 1) * (2 if paired.any() else 1)
    with np.errstate(all="ignore"):
        # of what has no bound there is no mean
        bounded = np.isfinite(found.most).reshape(len(load.names), 2, n).all(axis=1)
        total = integrals_many(rows, a, b, design, np.tile(bounded, (parts, 1)), rooted, analytic)
        if paired.any():
            total = total[: len(total) // 2] + total[len(total) // 2 :]
        engagement = load.machine[0]
        if engagement.slot.curved:  # the way to mid-motion, which no stretch reaches
            for end in (engagement.entry_deg, engagement.exit_deg):
                near = np.broadcast_to(np.reshape(NEAR * end, (-1, 1)), (n, 1))
                beside = _powers(load, load.at(near * AHEAD, np.arange(n), 0), None, plain)
                total += (beside @ SHARES) * np.abs(near[:, 0])
    return total * DEGREE


def _powers(load: Loaded, state: At, signs: Array | None, plain: bool) -> Array:
    """The squares of the quantities, and where ``plain`` they themselves after those."""
    given, at, shape, wanted = state
    here = look(load.kinds, given, at, signs).instant
    count = len(load.names)
    out = np.empty((2 * count if plain else count, *shape[::-1])).swapaxes(1, 2)
    for i, (name, quantity) in enumerate(zip(load.names, wanted, strict=True)):
        value = array(quantity(here, at).value.c[0])
        out[i] = square_of(value, name)
        if plain:
            out[count + i] = np.sqrt(abs(value)) if name in SQUARED else value
    return out


def _outer(one: SummaryOfMany, other: SummaryOfMany) -> SummaryOfMany:
    """The greater maximum and the lesser minimum; of two that are one, where the first is."""
    more = other.max > one.max + np.where(np.isfinite(one.max), TIE * np.abs(one.max), 0.0)
    less = other.min < one.min - np.where(np.isfinite(one.min), TIE * np.abs(one.min), 0.0)
    return SummaryOfMany(
        np.maximum(one.max, other.max),
        np.where(more, other.max_at_deg, one.max_at_deg),
        np.minimum(one.min, other.min),
        np.where(less, other.min_at_deg, one.min_at_deg),
    )
