"""Noncircular gears in front of the crank, for a wanted ratio i = crank speed / input speed.

The ratio is the side-crank's (``A``), or comes from a CSV of input_deg,ratio points over a turn
(``ratio_file``): a periodic quintic spline through them, four times continuously differentiable.
The gears close where the ratio's mean over a turn is 1, and cannot be made where it reaches 0.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from decimal import ROUND_FLOOR, Decimal, localcontext
from functools import lru_cache
from typing import Annotated, ClassVar, NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.drives import whitworth
from geneva_cli.machine.drives.drive import Gears, Plan
from geneva_cli.machine.drives.pushed import Mesh
from geneva_cli.machine.drives.transmission import About, Transmission
from geneva_cli.machine.engagement import CarrierVelocity, ClosedPeaks, Path, Reactions
from geneva_cli.machine.example import Example
from geneva_cli.machine.layout import Dimension, Layout, Pivot
from geneva_cli.machine.wheels.gearing import Gearing, RollerPlace
from geneva_cli.numerics.arrays import library
from geneva_cli.numerics.digits import FIFTY, PI, of_degrees, to_degrees
from geneva_cli.numerics.jet import Jet, Number, sine_versine_of
from geneva_cli.numerics.roots import boundary
from geneva_cli.numerics.spline import ZERO, Doubt, Exact, Pieces, doubt, periodic, shifted
from geneva_cli.spec.rules import POSITIVE, Csv, Range
from geneva_cli.spec.schema import Points

TURN = FIFTY.multiply(2, PI)
MEAN = 1e-6  # by which the mean ratio may miss 1; the rest is scaled away


class NoncircularGears(Transmission, kw_only=True):
    """Gears of any ratio that closes over a turn.

    Either the side-crank's ``A``, or the points of a ratio, output speed over input speed, over a
    turn of the input in degrees: pairs, or a CSV file's.

    >>> round(Design(External(6), NoncircularGears(A=0.6)).peaks.velocity.max, 12)
    0.625
    """

    NAME: ClassVar[str] = "noncircular-gears"
    WORDS: ClassVar[str] = "a crank behind noncircular gears"
    EXAMPLE: ClassVar[Example] = Example(
        "noncircular gears in front, with the ratio of a side-crank",
        {
            "wheel": {"z": 6},
            "drive": {"A": 0.6},
        },
    )
    GEARED: ClassVar[bool] = True
    ANALYTIC: ClassVar[bool] = False  # a ratio of points is a spline
    A: Annotated[float | None, Range(-1.0, 1.0, "()"), "the side-crank's ratio, as gears"] = None
    ratio: Annotated[
        Points | None,
        # of 18,001 points a second derivative is known to 1e-9, as of doubles
        Csv("ratio_file", "input_deg", "ratio", 0.0199, 1e3, 7),
        "CSV of input_deg,ratio points over a turn",
    ] = None
    gear_distance_mm: Annotated[float, POSITIVE, "distance of the two gears' axes, C"] = 100.0

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
        """Points are interpolated for one wheel and one law's angles."""
        at = table in ("wheel", "drive", "motion") and key != "n_rpm"
        return self.ratio is None or not (at or (table, key) == ("size", "center_distance_mm"))

    @property
    def gears(self) -> Gears:
        """The pair."""
        return Gears(self.gear_distance_mm, self.about(0.0).advance)

    def layout(self, plan: Plan, sign: float) -> Layout:
        """The gears' axes and what their pitch curves follow: A of a side-crank, or a file."""
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

    def reactions(self, wheel: Gearing, path: Path, mid_deg: float, L: float) -> Reactions | None:
        """The driver's teeth push the driven gear, which is fast on the crank."""
        return Mesh(path, self.gear_distance_mm / L)

    def about(self, crank_deg: float) -> About:
        """About a crank angle in degrees. Raises GenevaError for a ratio that no gears have."""
        if self.A is not None:
            return whitworth.about(self.A, crank_deg)
        assert self.ratio is not None  # one of the two is
        return _through(_turned(self.ratio.pairs), crank_deg)

    def turning(self, crank_deg: float, sense: float) -> CarrierVelocity | None:
        """That of the side-crank that has this ratio; None for a ratio by points."""
        return None if self.A is None else whitworth.turning(self.A, crank_deg, sense)

    def closed_peaks(self, wheel: Gearing, place: RollerPlace) -> ClosedPeaks | None:
        """The peaks of the side-crank that has this ratio; None for a ratio by points."""
        return None if self.A is None else whitworth.closed_peaks(self.A, wheel, place)

    def doubt(self, input_deg: float) -> Doubt | None:
        """What the rounding of the ratio's points leaves unknown of the crank's jerk."""
        if self.ratio is None:
            return None
        x, i = zip(*self.ratio.pairs, strict=True)
        with localcontext(FIFTY):
            found = doubt([of_degrees(v) for v in x], i, True, 2)
        return found._replace(move=found.move / i[bisect_right(x, input_deg % 360.0) - 1])


@lru_cache(4)  # advice builds one machine many times
def _turned(points: tuple[tuple[float, float], ...]) -> Exact:
    """The crank's angle over a turn, scaled to close. Raises GenevaError where no gears have it."""
    key = ("drive", "ratio_file")
    i = [p[1] for p in points]
    if points[0][0] != 0.0 or points[-1][0] != 360.0 or i[0] != i[-1]:
        raise GenevaError(
            "the ratio runs over a turn: from 0 to 360 deg, and ends as it began", key
        )
    if min(i) <= 0.0:
        raise GenevaError(
            f"not realisable as gears: the ratio falls to {min(i):g}, not above 0", key
        )
    with localcontext(FIFTY):
        x = [of_degrees(p[0]) for p in points]
        whole = periodic(x, [Decimal(v) for v in i]).integral()
        mean = whole.end() / TURN
        scaled = Exact(x, [[v / mean for v in c] for c in whole.c])
    if abs(float(mean) - 1.0) > MEAN:
        raise GenevaError(
            f"the gears do not close: the ratio's mean over a turn is {float(mean):.9g}, and must "
            f"be 1; divide it by {float(mean):.9g}",
            key,
        )
    return scaled


class Since(NamedTuple):
    """The crank's angle since a moment, by the input's since then."""

    since: Pieces

    def __call__(self, tau: Number, order: int) -> tuple[Jet, Jet]:
        """sin d and 1 - cos d of the crank's angle d, ``tau`` input radians later."""
        m = library(tau)
        turns = m.floor(tau / math.tau + 0.5)
        turn, *rate = self.since(tau - turns * math.tau, max(order, 1))
        terms = [k * c for k, c in enumerate(rate, 1)]
        return sine_versine_of(Jet(terms), m.sin(turn), m.cos(turn), order)


def _through(crank: Exact, crank_deg: float) -> About:
    with localcontext(FIFTY):
        phi = _input(crank, of_degrees(crank_deg))
        since = _since(crank, phi).rounded()
    return About(to_degrees(phi), Since(since))


def _input(crank: Exact, wanted: Decimal) -> Decimal:
    """The input angle of a crank angle, radians, by halving down to the last of 50 digits."""
    turns = (wanted / TURN).to_integral_value(ROUND_FLOOR)
    wanted -= turns * TURN
    i = max(bisect_right([c[0] for c in crank.c], wanted) - 1, 0)
    whole = crank.x[i + 1] - crank.x[i]
    since = boundary(lambda t: shifted(crank.c[i], t)[0] < wanted, ZERO, whole)
    return crank.x[i] + since + turns * TURN


def _since(crank: Exact, phi: Decimal) -> Exact:
    """The crank's angle since the input angle phi, by the input's since then: half a turn either
    way, with a knot at phi, so that the least way is written in full."""
    turns = (phi / TURN).to_integral_value(ROUND_FLOOR)
    at = phi - turns * TURN
    i = bisect_right(crank.x, at, hi=len(crank.x) - 1) - 1
    here = shifted(crank.c[i], at - crank.x[i])
    x = [ZERO, *[v - at for v in crank.x[i + 1 :]], *[v - at + TURN for v in crank.x[1 : i + 1]]]
    c = [here, *crank.c[i + 1 :], *[[v[0] + TURN, *v[1:]] for v in crank.c[: i + 1]]]
    if at > crank.x[i]:
        x.append(TURN)
    else:
        c.pop()
    c = [[v[0] - here[0], *v[1:]] for v in c]
    half = bisect_right(x, TURN / 2)  # the first knot past half a turn: its piece serves both ways
    back = [v - TURN for v in x[half - 1 :]]
    return Exact(
        [*back, *x[1 : half + 1]],
        [*[[v[0] - TURN, *v[1:]] for v in c[half - 1 :]], *c[:half]],
    )
