"""The whole cycle under load: states at any input angle, and extremes.

The cycle is a period of the machine from the first entry; with several wheels on a carrier it ends
at the entry of the next wheel. All loads are 0 in a dwell.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads.contact import LoadCase, contact, contact_values
from geneva_cli.loads.cycle_quantities import FORCE, PV, WALL_FORCE, plain_values
from geneva_cli.loads.instant import STATES, Instant, States, bounded
from geneva_cli.loads.load_case import load_case, multiples
from geneva_cli.loads.load_functions import LoadFunctions, on_breaks, refuse_noise
from geneva_cli.loads.load_peaks import LoadSummary, single_extremes, single_summaries
from geneva_cli.loads.mid_motion import at_crossing
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.jet import Array


class Stretch(NamedTuple):
    """Input angles between which the loads are smooth, and the signs that they have there."""

    start: float
    end: float
    drives: float  # sign of the wheel's torque
    slides: float  # sign of the sliding
    feeds: float  # sign of the input's torque: 1 if it drives the machine, -1 if it is driven


class Cycle:
    """A machine under its load, over one period, to some units in the last place of a peak."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.machine, self.mechanism = mechanism, mechanism.under_load
        self.case: LoadCase = load_case(mechanism)

    @property
    def is_loaded(self) -> bool:
        """True if an inertia or a resisting torque is known."""
        return self.mechanism.spec.is_loaded

    def states(self, input_deg: Array) -> States:
        """The loads at ascending input angles of a period from the first entry; 0 in the dwells."""
        from geneva_cli.motion.motion_table import spans

        out: dict[str, Any] = {}
        for span in spans(self.mechanism, input_deg):
            if not len(span.local):
                continue
            for name, row in self.moving(span.engagement, span.local)._asdict().items():
                total = out.setdefault(name, None if row is None else np.zeros(len(input_deg)))
                if total is not None:
                    total[span.moves] = row
        still = np.zeros(len(input_deg))
        return States(**{name: out.get(name, still) for name in States._fields})

    def moving(self, engagement: Engagement, input_deg: Array) -> States:
        """The loads at input angles (n,) of an engagement, degrees from its own mid-motion."""
        with np.errstate(all="ignore"):
            here = Instant(self.case, contact_values(contact(engagement, input_deg)))
        drives = np.array(here.drives)
        none = np.flatnonzero(~self.case.is_loaded(engagement, here.wheel_torque_Nm))
        if len(none):  # where the torque is 0, its sign is that before, or at entry that after
            x, step = input_deg[none], 1e-6 * engagement.motion_deg
            near = np.where(x - step < engagement.entry_deg, x + step, x - step)
            beside = contact(engagement, near, reactions=False)
            drives = np.broadcast_to(drives, input_deg.shape).copy()
            drives[none] = Instant(self.case, beside, feeds=1.0).drives
            with np.errstate(all="ignore"):
                here = Instant(self.case, here.at, drives)
        out, middle = bounded(here), input_deg == 0.0
        limits = at_crossing(engagement, self.case) if middle.any() else None
        for name, limit in (limits or {}).items():
            out = out._replace(**{name: np.where(middle, limit, getattr(out, name))})
        return out

    def along(self, engagement: Engagement, stretch: Stretch, input_deg: Array) -> States:
        """The loads at input angles (n,) of a stretch from mid-motion, with the stretch's signs."""
        with np.errstate(all="ignore"):
            at = contact_values(contact(engagement, input_deg))
            return bounded(Instant(self.case, at, *stretch[2:]))

    def plain(self, states: States, name: str) -> Array:
        """A quantity of ``known``, or a multiple of one, at states of the cycle."""
        source, factor, _ = multiples(self.mechanism).get(name, (name, 1.0, ""))
        assert factor is not None  # known quantities have a factor
        if source == PV:
            assert states.stress_squared is not None  # it is known
            values = states.stress_squared * (states.sliding_m_s * states.sliding_m_s * 1e12)
        else:
            signed = WALL_FORCE if source == FORCE else source
            state = next(key for key, own in STATES.items() if own == signed)
            values = getattr(states, state)
        return plain_values(values, source) * factor

    @cached_property
    def known(self) -> Mapping[str, LoadSummary[Array]]:
        """The summaries of all quantities that have a value, (1,) each."""
        every = single_summaries(self.machine)
        refuse_noise([one.rms for one in every.values()])
        return every

    @cached_property
    def extremes(self) -> Mapping[str, LoadSummary[float]]:
        """The summaries of all quantities that have a value, as numbers."""
        out = dict[str, LoadSummary[float]]()
        for name, one in self.known.items():
            rows = [row for row in one if row is not None]  # all are known
            out[name] = LoadSummary(*np.concatenate(rows).tolist())
        return out

    @cached_property
    def ends(self) -> Mapping[str, LoadSummary[float]]:
        """The same without mean and rms, which take longest."""
        out = dict[str, LoadSummary[float]]()
        for name, one in single_extremes(self.machine)[0].items():
            out[name] = LoadSummary(*np.concatenate(one[:4]).tolist())
        return out

    @cached_property
    def stretches(self) -> list[tuple[Engagement, Stretch]]:
        """The motions, divided at breaks and where torque, sliding or input torque change sign."""
        out = []
        for engagement in self.mechanism.engagements:
            load = LoadFunctions(engagement, self.case, (), more=("slides", "feeds"))
            found = load.stretches()
            signs = dict(zip(load.kinds, np.where(found.positive, 1.0, -1.0), strict=True))
            of = (signs.get(k, np.ones(found.x.shape[1])) for k in ("drives", "slides", "feeds"))
            # where only signs that do not matter here differ, a stretch goes on
            rows = np.array([found.span, *of])
            first = np.append(True, (rows[:, 1:] != rows[:, :-1]).any(axis=0))
            ends = on_breaks(found.x[1, np.append(first[1:], True)], engagement)
            cuts = [engagement.entry_deg, *ends[:-1].tolist(), engagement.exit_deg]
            for (start, end), own in zip(pairwise(cuts), rows[1:, first].T.tolist(), strict=True):
                if start < end:
                    out.append((engagement, Stretch(start, end, *own)))
        return out


# The cycle of a machine, cached for its loads, strength and warnings.
cycle_of = lru_cache(maxsize=16)(Cycle)
