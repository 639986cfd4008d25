"""The play of a spherical wheel in its lock during the dwell, for any deviations.

A recess is cut into the wheel at an angle rho from the crank's axis, which is at S from the
wheel's. The locking sector reaches to k. With the azimuth chi(p, a) about the wheel's axis of a
point at p from it and at a from the crank's axis,

    cos a = cos S cos p + sin S sin p cos chi ,

the wheel turns by d = chi(p, rho) - chi(p, k) until a corner of the recess, at p, meets the sector.
If the recess reaches farther round, an end of the sector, at q, meets it: then d is chi(q, rho)
minus the azimuth of the end.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.loads.tolerance.locking import ROUNDING, Deviations, chosen, positive_root
from geneva_cli.numerics.arrays import Mask, array
from geneva_cli.numerics.jet import Jet, atan2, sqrt
from geneva_cli.verdict.tolerance import Locks


class SphereLock(NamedTuple):
    """One corner of a recess and one locking sector, angles in radians.

    At a right angle, with rim and crank's axis on one great circle, the play is the clearance:

    >>> from geneva_cli.loads.tolerance.locking import deviations
    >>> lock = SphereLock(100.0, 0.5 * math.pi, 0.4, 0.401, 0.5 * math.pi, 0.5 * math.pi)
    >>> round(lock(deviations([0.0] * 7))[0].c[0], 12)
    0.001
    """

    radius_mm: float  # L, of the sphere
    axes: float  # S, between the shafts
    lock: float  # k, sector's edge from the crank's axis
    recess: float  # rho, recess's edge from the crank's axis
    corner: float  # p, recess's corner from the wheel's axis
    half: float  # half the sector, about the crank's axis

    @property
    def reach(self) -> float:
        """Half of the recess, as an angle about the crank's axis."""
        S, rho = self.axes, self.recess
        cosine = math.cos(self.corner) - math.cos(S) * math.cos(rho)
        return math.acos(max(-1.0, min(1.0, cosine / (math.sin(S) * math.sin(rho)))))

    def __call__(self, by: Deviations) -> tuple[Jet, Mask]:
        """Play of the wheel to one side, radians: 0 where sector and recess do not fit together."""
        lock = by.lock_radius_mm / self.radius_mm + math.sin(self.lock)
        recess = by.recess_radius_mm / self.radius_mm + math.sin(self.recess)
        lock_cosine, recess_cosine = (positive_root(1.0 - a * a) for a in (lock, recess))
        if self.reach <= self.half:
            cosine, sine = (0.0 * lock + f(self.corner) for f in (math.cos, math.sin))
            there = self._azimuth(cosine, sine, lock_cosine)
        else:
            up, ahead = math.cos(self.axes), math.sin(self.axes)
            x = lock_cosine * ahead - lock * (math.cos(self.half) * up)
            y = lock * math.sin(self.half)
            cosine = lock_cosine * up + lock * (math.cos(self.half) * ahead)
            sine, there = sqrt(x * x + y * y), atan2(y, x)
        angle = self._azimuth(cosine, sine, recess_cosine) - there
        jams = (array((recess - lock).c[0]) < -ROUNDING) | (array(angle.c[0]) < -ROUNDING)
        return chosen(jams, angle * 0.0, angle), jams

    def _azimuth(self, cosine: Jet, sine: Jet, from_crank: Jet) -> Jet:
        """Azimuth chi, from the cosine and sine of p, and the cosine of a."""
        across = sine * math.sin(self.axes)
        along = from_crank - cosine * math.cos(self.axes)
        return atan2(positive_root(across * across - along * along), along)


def sphere_locks(parts: SphereParts, sizes: Mapping[str, float]) -> Locks:
    """A recess with each locking sector of a spherical crank, and the clearance that they need."""
    ball, L = parts.ball, parts.ball.radius_mm
    angles = L, ball.axes, ball.lock, ball.recess, ball.rim
    locks = [SphereLock(*angles, 0.5 * one.boundary[0].sweep) for one in parts.shape.crank]
    by = sizes["lock_radius_mm"] + sizes["recess_radius_mm"]
    grown = math.asin(min(1.0, math.sin(ball.lock) + by / L)) - ball.lock
    return locks, L * grown if ball.lock else None
