"""Crank and rotating coulisse (Whitworth): the transmission of the side-crank drive.

With the input crank, of length 1 and at the offset A, at phi, the coulisse is at f, along
(A + cos phi, sin phi).
"""

from typing import NamedTuple

from geneva_cli.drives.transmission import LocalTransmission, Transmission
from geneva_cli.errors import refuse_text
from geneva_cli.numerics.angles import sin_cos_deg
from geneva_cli.numerics.arrays import choose, enclosed, library
from geneva_cli.numerics.jet import Jet, Number, cosines_after, sine_versine_of


class Whitworth(Transmission, kw_only=True):
    """A transmission with the ratio of a side-crank of the offset ``A``."""

    A: float

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse_near_one("A", self.A)
        vars(self)["side_crank"] = self.A

    def about(self, crank_deg: float) -> LocalTransmission:
        A = self.A
        m = library(A, crank_deg)
        s, c = sin_cos_deg(crank_deg)
        # cos h and the coulisse's length are sums of positive terms for A near +-1.
        sin_h = A * s
        cos_h = m.hypot(c, s * m.sqrt((1.0 - A) * (1.0 + A)))
        level = s == 0.0  # on the line of centres, where most peaks are
        long = cos_h + abs(A * c)
        short = (1.0 - A) * (1.0 + A) / long
        ahead = A * c > 0.0
        length = choose(level, 1.0 + A * c, choose(ahead, long, short))
        rest = choose(level, 1.0 - A * c, choose(ahead, short, long))
        # phi = f + h, or the angle of the input crank itself if the two nearly cancel
        added = crank_deg + m.degrees(m.atan2(sin_h, cos_h))
        turns = crank_deg / 360.0
        whole = 360.0 * (round(turns) if isinstance(turns, float) else m.rint(turns))
        up = m.copysign(length * s, crank_deg - whole)  # half a turn back is not half a turn ahead
        own = whole + m.degrees(m.atan2(up, length * c - A))
        phi = choose(A < 0.0, own, added)
        grows = (A * c < 0.0) & level
        return phi, Coulisse(A, s, c, sin_h, cos_h, length, rest, grows)


def refuse_near_one(key: str, value: float) -> None:
    """Raise GenevaError for a value whose size is too close to 1 to be computed."""
    text = "{key} = {value!r}: too close to 1 to be computed; its size must be at most 1 - 1e-12"
    # 1 - 1e-12, as a double, passes
    refuse_text(abs(value) > 1.0 - 0.999e-12, ("drive", key), text, key=key, value=value)


class Coulisse(NamedTuple):
    """The coulisse's rotation from one of its angles f.

    h = asin(A sin f) is between input crank and coulisse, whose ``length`` is cos h + A cos f;
    ``rest`` is cos h - A cos f. ``grows`` selects a sum of positive terms for W = x² + y².
    """

    A: float
    sin_f: float
    cos_f: float
    sin_h: float
    cos_h: float
    length: float
    rest: float
    grows: bool  # an array for a batch

    def __call__(self, tau: Number, order: int) -> tuple[Jet, Jet]:
        """sin d and 1 - cos d of the coulisse's rotation d, ``tau`` input radians later."""
        A, s, c, sin_h, cos_h, length, rest, grows = enclosed(tau, self)
        m = library(tau, A, s)
        sin_t, cos_t = m.sin(0.5 * tau), m.cos(0.5 * tau)
        x = cos_t * cos_t * length - 2.0 * sin_t * cos_t * sin_h - sin_t * sin_t * rest
        y = 2.0 * sin_t * (cos_t * cos_h - sin_t * sin_h)
        # df/dphi = (1 + (1 - A²)/W)/2 with W = x² + y² = 1 + A² + 2 A cos phi. As A nears 1 the
        # coulisse turns at half speed, and nothing cancels.
        sine, cosine = x * s + y * c, x * c - y * s - A
        cosines = cosines_after(sine, cosine, max(order - 1, 0))
        W = choose(grows, length * length - 4.0 * A * c * sin_t * sin_t, x * x + y * y)
        square = Jet((W, *[2.0 * A * t for t in cosines[1:]]))
        rate = 0.5 + (0.5 * (1.0 - A) * (1.0 + A)) / square
        return sine_versine_of(rate, y, x, order)
