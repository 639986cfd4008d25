"""Noncircular gears in front of the crank, for a chosen ratio i = crank speed / input speed.

The ratio is the side-crank's (``A``), or comes from a CSV of input_deg,ratio points over a turn
(``ratio_file``). A periodic quintic spline passes through the points, four times continuously
differentiable. The gears close if the mean of the ratio over a turn is 1. They cannot be made if
the ratio reaches 0.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, ClassVar, NamedTuple, Self

from geneva_cli.drives import whitworth
from geneva_cli.drives.pushed import Mesh, PushedCrank
from geneva_cli.drives.transmission import LocalTransmission, Transmission
from geneva_cli.errors import GenevaError
from geneva_cli.motion.drive import Gears, Plan
from geneva_cli.motion.engagement import ClosedPeaks, Path
from geneva_cli.motion.pivots import Dimension, Layout, Pivot, ShaftPlace
from geneva_cli.motion.wheels.gearing import Gearing, RollerPlace
from geneva_cli.numerics.arrays import library
from geneva_cli.numerics.jet import Jet, Number, sine_versine_of
from geneva_cli.numerics.roots import boundary
from geneva_cli.spec.rules import POSITIVE, Csv, Range
from geneva_cli.spec.schema import Example, Points

if TYPE_CHECKING:
    from geneva_cli.numerics.spline import Doubt, PiecewisePolynomial


class NoncircularGears(Transmission, kw_only=True):
    """Gears of any ratio that closes over a turn.

    The ratio is the side-crank's ``A``, or comes from points: output speed over input speed, by the
    input angle in degrees over a turn. Points are pairs, or the name of a CSV file.

    >>> round(Design(External(6), NoncircularGears(A=0.6)).peaks.velocity.max, 12)
    0.625
    """

    NAME: ClassVar[str] = "noncircular-gears"
    WORDS: ClassVar[str] = "a crank behind noncircular gears"
    IN_FRONT: ClassVar[str] = "noncircular gears"
    EXAMPLE: ClassVar[Example] = Example(
        "noncircular gears in front, with the ratio of a side-crank",
        {"wheel": {"z": 6}, "drive": {"A": 0.6}},
    )
    A: Annotated[float | None, Range(-1.0, 1.0, "()"), "ratio of a side-crank with this A"] = None
    ratio: Annotated[
        Points | None,
        # from 18,001 points a second derivative is known to 1e-9, as from doubles
        Csv("ratio_file", "input_deg", "ratio", 0.0199, 1e3, 7),
        "CSV file of input_deg,ratio points over a turn",
    ] = None
    gear_distance_mm: Annotated[float, POSITIVE, "distance between the two gears' axes, C"] = 100.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if (self.A is None) == (self.ratio is None):
            raise GenevaError(
                "noncircular gears need A (the side-crank's ratio) or ratio_file, and not both",
                ("drive", "kind"),
            )
        if self.A is not None:
            whitworth.refuse_rounding(self.A)

    def may_vary(self, table: str, key: str) -> bool:
        at = table in ("wheel", "drive", "motion") and key != "n_rpm"
        return self.ratio is None or not (at or (table, key) == ("size", "center_distance_mm"))

    def backwards(self, plan: Plan) -> Self:
        turned = super().backwards(plan)
        if self.ratio is None:
            return turned
        pairs = tuple((360.0 - x, i) for x, i in reversed(self.ratio.pairs))
        return turned.replace(ratio=Points(pairs, self.ratio.file))

    @property
    def gears(self) -> Gears:
        return Gears(self.gear_distance_mm, self.about(0.0).advance)

    def input_shaft(self, plan: Plan, sign: float, sense: float) -> ShaftPlace:
        return ShaftPlace(plan.center_distance_mm + self.gear_distance_mm, -sense)

    def layout(self, plan: Plan, sign: float) -> Layout:
        law: Dimension = (
            Dimension("gears' ratio", self.ratio.file)
            if self.ratio is not None
            else Dimension("gears' ratio as of side-crank A", self.A or 0.0)
        )
        return (
            Pivot("driver gear axis", plan.center_distance_mm + self.gear_distance_mm, 0.0),
            Dimension("gears' axes", self.gear_distance_mm, "mm"),
            law,
        )

    def reactions(self, wheel: Gearing, path: Path, mid_deg: float, L: float) -> PushedCrank | None:
        return Mesh(path, self.gear_distance_mm / L)

    def about(self, crank_deg: float) -> LocalTransmission:
        if self.A is not None:
            return whitworth.about(self.A, crank_deg)
        assert self.ratio is not None  # ``__post_init__`` requires one of the two
        return _through(_turned(self.ratio.pairs), self.ratio.pairs, crank_deg)

    def closed_peaks(self, wheel: Gearing, place: RollerPlace) -> ClosedPeaks | None:
        return None if self.A is None else whitworth.closed_peaks(self.A, wheel, place)

    def doubt(self, input_deg: float) -> Doubt | None:
        if self.ratio is None:
            return None
        from geneva_cli.numerics.spline import doubt

        x, i = zip(*self.ratio.pairs, strict=True)
        rounding = doubt([math.radians(v) for v in x], i, True, 2)
        return rounding._replace(move=rounding.move / i[bisect_right(x, input_deg % 360.0) - 1])


@lru_cache(4)  # advice builds one machine many times
def _turned(points: tuple[tuple[float, float], ...]) -> PiecewisePolynomial:
    """Crank angle over a turn, scaled to close. GenevaError for an impossible ratio."""
    # a list of the kinds needs no splines
    from geneva_cli.numerics.spline import PiecewisePolynomial, periodic

    key = ("drive", "ratio_file")
    x, i = zip(*points, strict=True)
    if x[0] != 0.0 or x[-1] != 360.0 or i[0] != i[-1]:
        raise GenevaError(
            "the ratio must run from 0 to 360 deg, and end at the value it began with", key
        )
    if min(i) <= 0.0:
        raise GenevaError(
            f"not realisable as gears: the ratio falls to {min(i):g}, and must stay above 0", key
        )
    whole = periodic([math.radians(v) for v in x], i).integral()
    mean = whole(math.tau, 0)[0] / math.tau
    # a smaller error of the mean ratio is scaled away
    if abs(mean - 1.0) > 1e-6:
        raise GenevaError(
            f"the gears do not close: the mean ratio over a turn is {mean:.9g}, and must "
            f"be 1; divide all ratios by {mean:.9g}",
            key,
        )
    return PiecewisePolynomial(whole.cuts, whole.origins, whole.rows / mean)


class CrankRotation(NamedTuple):
    """The crank's rotation since a moment, as a function of the input's rotation since then."""

    since: PiecewisePolynomial

    def __call__(self, tau: Number, order: int) -> tuple[Jet, Jet]:
        """sin d and 1 - cos d of the crank's rotation d, ``tau`` input radians later."""
        m = library(tau)
        turns = m.floor(tau / math.tau + 0.5)
        turn, *rate = self.since(tau - turns * math.tau, max(order, 1))
        terms = [k * c for k, c in enumerate(rate, 1)]
        return sine_versine_of(Jet(terms), m.sin(turn), m.cos(turn), order)


def _through(
    crank: PiecewisePolynomial, points: tuple[tuple[float, float], ...], crank_deg: float
) -> LocalTransmission:
    turns, wanted = divmod(math.radians(crank_deg), math.tau)
    phi = boundary(lambda x: crank(x, 0)[0] < wanted, 0.0, math.tau)
    since = _since(crank, [at for at, _ in points[:-1]], phi)
    return LocalTransmission(
        math.degrees(phi + turns * math.tau), CrankRotation(since), False, since.seams
    )


def _since(crank: PiecewisePolynomial, starts_deg: list[float], phi: float) -> PiecewisePolynomial:
    """The crank's rotation since the input angle phi, by the input's rotation, over three turns."""
    import numpy as np

    from geneva_cli.numerics.spline import SPLINE_DEGREE, PiecewisePolynomial, taylor

    here = crank(phi, SPLINE_DEGREE + 1)
    origins = np.radians(np.add.outer([-360.0, 0.0, 360.0], starts_deg).ravel()) - phi
    cuts = origins[1:].copy()
    middle = len(starts_deg) + int(crank.cuts.searchsorted(phi))
    origins[middle] = 0.0
    rows = np.tile(crank.rows, (3, 1))
    rows[:, 0], rows[middle] = 0.0, [0.0, *here[1:]]
    ends = taylor(cuts - origins[:-1], list(rows[:-1].T), 0)[0]
    first = taylor(cuts[middle - 1], list(rows[middle]), 0)[0]
    rows[middle + 1 :, 0] = np.cumsum(ends[middle:])
    rows[:middle, 0] = first - np.cumsum(ends[:middle][::-1])[::-1]
    return PiecewisePolynomial(cuts, origins, rows)
