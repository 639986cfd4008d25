"""A requirement for a machine that is not designed yet.

Every requirement about time or angle restricts the motion angle M of one engagement and the cycle
time T, for m motions in a turn of the input, one of each roller:

    tau = m M/360    k = tau/(1 - tau)    dwell_deg = 360/m - M    motion_s = tau T
    dwell_s = (1 - tau) T

All of them together leave a range of M, and for each M in it a range of T.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, marking
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.given_motion import MOTION_MIN
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.wheels.external import External
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import parameter
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.spec.tables import LIMITED
from geneva_cli.study.batches import Batch
from geneva_cli.study.sweep.constraints import Constraint, Objective
from geneva_cli.verdict.quantities.quantity_names import in_batch

BARE = Spec(External(3))  # the tables of a machine without a frame
# fraction of a turn over m that an open end of a range leaves to motion and to dwell
OPEN_END = 0.01
GEARINGS = ("external", "internal", "spherical")
PEAK = "acceleration.max"
SPACE = 3.0  # centre distances that a linkage may take by default
ROLLERS_MAX = 60  # on a crank; more run into each other
TURNS = (3, 4, 5, 6)  # of the input in a cycle behind a first wheel: its step is a crank's motion


class Target(NamedTuple):
    """All requirements: ranges by their names in ``SPANS``, and other conditions of a row.

    ``frame`` is a spec whose sizes, loads and limits every machine has.
    """

    words: str
    z: tuple[int, ...]
    gearings: tuple[str, ...] = GEARINGS
    rollers: int | None = None
    laws: tuple[str, ...] = ("modified-sine",)
    spans: dict[str, AllowedSpan] = {}  # noqa: RUF012 - a NamedTuple's default, never changed
    frame: Spec | None = None
    sort: Objective | None = None  # the goal by which rows are sorted
    bounds: tuple[Constraint, ...] = ()
    space: float = SPACE  # of a linkage: its joints' distance from the crank's axis, over L

    @property
    def own(self) -> Spec:
        """The frame, or a spec without sizes, loads and limits."""
        return self.frame or BARE

    @property
    def timed(self) -> bool:
        """Return True if times in seconds are required, or given with the frame."""
        return self.frame is not None or not {"cycle", "motion_s", "dwell_s"}.isdisjoint(self.spans)

    @property
    def peak(self) -> str:
        """The name of the peak acceleration, the default goal; per s² if times are required."""
        return f"{PEAK}_rad_s2" if self.timed else PEAK

    @property
    def any_motion(self) -> bool:
        """Return True if any motion is allowed, and there is some bound."""
        return bool(self.bounds) and self.allows_any_motion(1)

    @property
    def soft_bounds(self) -> dict[str, Constraint]:
        """The limits of the frame that a batch can compute, by their keys: better kept than not."""
        values = self.own.limits.as_dict()
        return {
            key: Constraint(name, ">=" if "_min" in key else "<=", float(values[key]))
            for key, name in LIMITED.items()
            if values[key] is not None and in_batch([name])
        }

    @property
    def names(self) -> tuple[str, ...]:
        """The quantities of its goal and its bounds, which are columns of its rows."""
        goal = [self.sort.name] if self.sort else []
        return tuple(dict.fromkeys([*goal, *(bound.name for bound in self.bounds)]))

    def with_times(self) -> Target:
        """The requirement with its bounds on a motion's times and angles as ranges.

        Returned unchanged if those ranges allow any motion.
        """
        # bounds on times restrict the motion angle if the cycle is known
        times = ("motion_s", "dwell_s") if self.frame or "cycle" in self.spans else ()
        names = {f"timing.{x}": x for x in ("tau", "k", "motion_deg", "dwell_deg", *times)}
        spans = dict(self.spans)
        for bound in self.bounds:
            if name := names.get(bound.name):
                spans[name] = spans.get(name, AllowedSpan()).within(AllowedSpan(*bound.span))
        left = tuple(bound for bound in self.bounds if bound.name not in names)
        narrowed = self._replace(spans=spans, bounds=left)
        return self if narrowed.allows_any_motion(1) else narrowed

    def cycle_s(self, m: float) -> AllowedSpan:
        """The required cycle times; with a frame and no other requirement, the frame's own."""
        if "cycle" in self.spans:
            return self.spans["cycle"]
        if self.frame is not None:
            own = 60.0 / (m * self.frame.drive.n_rpm)
            return AllowedSpan(own, own)
        return AllowedSpan(0.0, math.inf)

    def demands(self, m: float) -> Iterator[tuple[str, AllowedSpan]]:
        """The range of motion angles that each requirement leaves for m rollers, with its name."""
        spans, turn, cycle = self.spans, 360.0 / m, self.cycle_s(m)
        options = {name: f"--{name.replace('_', '-')} {_typed(s)}" for name, s in spans.items()}
        speed = options.pop("cycle", "the spec's n_rpm" if self.frame else "")
        if "motion_s" in spans and "dwell_s" in spans:
            k = spans["motion_s"].over(spans["dwell_s"])
            yield f"{options['motion_s']} with {options['dwell_s']}", _of_k(k).times(turn)
        for name, option in options.items():
            span, is_time = spans[name], name.endswith("_s")
            if is_time and not speed:
                continue
            span = span.over(cycle) if is_time else _of_k(span) if name == "k" else span
            span = span if name.endswith("_deg") else span.times(turn)
            span = span.mirrored(turn) if name.startswith("dwell") else span
            yield f"{option} with {speed}" if is_time else option, span

    def allows_any_motion(self, m: float) -> bool:
        """Return True if any motion angle is allowed."""
        return not any(s.low > 0.0 or s.high < 360.0 / m for _, s in self.demands(m))

    def motions(self, m: float, natural: float) -> AllowedSpan:
        """The motion angles allowed for m rollers: required, any, or the plain crank's.

        The range may be empty. It may include 0 or a whole turn over m, where no motion or no dwell
        is left.
        """
        allowed = AllowedSpan(0.0, 360.0 / m)
        # the motions of several rollers are short, whatever is required
        if self.allows_any_motion(1) and self.allows_any_motion(m):
            return allowed if self.any_motion else AllowedSpan(natural, natural)
        for _, demand in self.demands(m):
            allowed = allowed.within(demand)
        return allowed

    def free_motions(self, m: int, natural: float) -> AllowedSpan | None:
        """Those motions, with open ends near their limits; None if there are none."""
        motion, whole = self.motions(m, natural), 360.0 / m
        if motion.low >= whole or motion.high <= 0.0 or motion.empty:
            return None
        low = motion.low if motion.low > 0.0 else OPEN_END * whole
        high = motion.high if motion.high < whole else (1.0 - OPEN_END) * whole
        return motion if motion.exact else AllowedSpan(min(low, high), high)

    def machine(self, wheel: Gearing, drive: Drive, motion: Motion | None = None) -> Spec:
        """A machine with the sizes, loads and limits of the frame, still without its speed."""
        size, L = self.own.size, self.own.size.center_distance_mm
        if L is None and not drive.ONE_ARM:  # it has no crank of one radius: the frame's distance
            L = size.derived_distance_mm
        as_built = L is not None and size.crank_radius_mm is not None  # it has its own R/L
        if size.center_distance_mm != L or as_built:
            size = size.replace(center_distance_mm=L, crank_radius_mm=None)
        shape = {"wheel": wheel, "drive": drive, "motion": motion, "size": size}
        return self.own.replace(**shape, title="", path="", files=())

    def at_speed(self, batches: Iterable[Batch]) -> Iterator[Batch]:
        """Batches of those machines, at the speeds that their motions require."""
        for members, machine in batches:
            if self.timed:
                drive, motion_deg = machine.spec.drive, machine.engagements[0].motion_deg
                both = np.broadcast_arrays(drive.rollers / drive.turns, motion_deg, machine.design)
                own = zip(*(x.ravel().tolist() for x in both[:2]), strict=True)
                n_rpm = parameter(np.array([[self.n_rpm(*one)] for one in own]))
                with marking():  # a single one out of its range is refused, when it is shown
                    drive = drive.replace(n_rpm=n_rpm)
                machine = machine._replace(spec=machine.spec.replace(drive=drive))
            yield members, machine

    def n_rpm(self, m: float, motion_deg: float) -> float:
        """The input speed for m cycles in a turn: the usual one, or the nearest that is allowed."""
        fraction, usual = m * motion_deg / 360.0, self.own.drive.n_rpm
        cycle = self.cycle_s(m)
        if not cycle.exact:
            if "motion_s" in self.spans:
                cycle = cycle.within(self.spans["motion_s"].times(1.0 / fraction))
            if "dwell_s" in self.spans and fraction < 1.0:  # else there is none, whatever the speed
                cycle = cycle.within(self.spans["dwell_s"].times(1.0 / (1.0 - fraction)))
        whole = min(max(60.0 / (m * usual), cycle.low), cycle.high)
        return usual if whole == 60.0 / (m * usual) else 60.0 / (m * whole)

    @property
    def counts(self) -> list[float]:
        """The numbers of motions in a turn that allow a machine."""
        return [m for m in self._every_count if not self._contradiction(m)]

    def refuse_contradictions(self) -> None:
        """Raise GenevaError for requirements that no machine meets, alone or together."""
        if all(map(self._contradiction, self._every_count)):
            raise GenevaError(self._contradiction(self._every_count[0]))

    @property
    def _every_count(self) -> Sequence[float]:
        """All numbers of motions in a turn: of rollers, or of turns behind a first wheel."""
        several = (self.rollers,) if self.rollers else range(1, ROLLERS_MAX + 1)
        behind = [1.0 / turns for turns in TURNS] if self.rollers in (None, 1) else []
        return [*several, *behind]

    def _contradiction(self, m: float) -> str:
        """The reason why no machine has m motions in a turn; empty if one may."""
        left, names = AllowedSpan(), list[str]()
        for name, demand in self.demands(m):
            left = left.within(demand)
            names.append(name)
            if left.empty or left.high * m <= MOTION_MIN or left.low * m >= 360.0 - MOTION_MIN:
                several = f" of {m} rollers" if m > 1 else ""
                limits = f"above 0 and below {360.0 / m:.7g} deg"
                return f"{' and '.join(names)}: no motion{several} {limits} does so"
        return ""


def _of_k(k: AllowedSpan) -> AllowedSpan:
    """The range of tau for one of k."""
    return AllowedSpan(*(max(x, 0.0) / (1.0 + x) if x < math.inf else 1.0 for x in k))


def _typed(s: AllowedSpan) -> str:
    ends = ("" if abs(x) == math.inf else f"{x:.7g}" for x in s)
    return f"{s.low:.7g}" if s.exact else "..".join(ends)


class AllowedSpan(NamedTuple):
    """All numbers from ``low`` to ``high``, both included; one number if they are equal."""

    low: float = -math.inf
    high: float = math.inf

    @property
    def exact(self) -> bool:
        """Return True for a single number."""
        return self.low == self.high

    def allows(self, natural: float) -> bool:
        """Return True for a motion angle in it, within the tolerance of the plain crank."""
        slack = 1e-6 * natural  # by which it may miss the required one
        return self.low - slack <= natural <= self.high + slack

    @property
    def empty(self) -> bool:
        """Return True if no number is in it."""
        return not self.low <= self.high

    def over(self, other: AllowedSpan) -> AllowedSpan:
        """The range of a/b, for positive a of this range and b of the other."""
        low = self.low / other.high if math.isfinite(other.high) else 0.0
        high = self.high / other.low if other.low > 0.0 else math.inf
        return AllowedSpan(max(low, 0.0), high)

    def mirrored(self, whole: float) -> AllowedSpan:
        """The range of ``whole`` less a number."""
        return AllowedSpan(whole - self.high, whole - self.low)

    def times(self, factor: float) -> AllowedSpan:
        """The range of a positive multiple."""
        return AllowedSpan(self.low * factor, self.high * factor)

    def within(self, other: AllowedSpan) -> AllowedSpan:
        """The common part of two ranges; numbers that differ only by rounding are equal."""
        low, high = max(self.low, other.low), min(self.high, other.high)
        if low > high and math.isclose(low, high, rel_tol=ROUNDED):
            return self if self.exact else other if other.exact else AllowedSpan(low, low)
        return AllowedSpan(low, high)

    def words(self, what: str, unit: str = "") -> str:
        """The requirement in words: ``a dwell of at least 0.8 s``."""
        if self.exact:
            return f"{what} {self.low:.7g}{unit}"
        if not self.low > -math.inf:
            return f"{what} at most {self.high:.7g}{unit}"
        if not self.high < math.inf:
            return f"{what} at least {self.low:.7g}{unit}"
        return f"{what} {self.low:.7g} to {self.high:.7g}{unit}"
