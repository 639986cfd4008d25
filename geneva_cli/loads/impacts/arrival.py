"""Check that the wheel follows a roller that stops it with one wall only.

If gears drive between two rollers, the slot of the second one has a wall behind its roller only
(see ``parts.outlines.wheel_outline``). The wheel's inertia must hold it on that wall, against the
torque that resists. From the handover at s the wheel coasts, psi'' = -m with m = M_r / (I w²),
while the slot needs less deceleration, psi'' > -m. It lags by

    d(x) = psi(x) - psi(s) - psi'(s) (x - s) + m (x - s)²/2

and meets the wall where d is 0 again. -psi'' of a straight slot has one peak, and is not 0 at the
exit e. So the wheel reaches its dwell, and stays on the wall until then, if

    m <= -psi''(e)  and  m <= 2 (psi'(s) (e - s) - (psi(e) - psi(s))) / (e - s)².

With a larger m it stops short. Angles are input angles in radians.
"""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.loads.carried import inertia_kgm2, resisting_torque_Nm
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE, omega
from geneva_cli.numerics.roots import boundary


class Lag(NamedTuple):
    """Greatest lag, its place, and the place where the wheel meets the wall again; degrees."""

    deg: float
    at_deg: float
    struck_deg: float


class Arrival(NamedTuple):
    """The resisting torque, and the greatest with which the wheel reaches its dwell.

    ``lag`` is None if the wheel does not reach it, or nothing resists.
    """

    torque_Nm: float
    most_Nm: float
    lag: Lag | None


def arrival(mechanism: Mechanism) -> Arrival | None:
    """Arrival of a machine's wheel at its dwell.

    None if the slots have both walls, or without a load.

    >>> design = Design(External(3), GearSector(sector_deg=60), load=Load(inertia_kgm2=0.01))
    >>> round(arrival(design.mechanism).most_Nm, 6)  # tan b = 0.57735 of I w²
    0.227929
    """
    (engagement, *_), spec = mechanism.engagements, mechanism.spec
    if not engagement.paired or not spec.is_loaded:
        return None
    w = omega(spec.drive.n_rpm)
    unit, torque = inertia_kgm2(spec) * w * w, resisting_torque_Nm(spec)
    most = unit * greatest_drag(engagement)
    reaches = 0.0 < torque <= most
    lag = _lag(mechanism, engagement, torque / unit) if reaches else None
    return Arrival(torque, most, lag)


def greatest_drag(engagement: Engagement) -> float:
    """Greatest M_r / (I w²), without a unit, with which the wheel reaches its dwell."""
    start, u = engagement.motion(_handover(engagement), 1).scalars()[:2]
    end, _, last = engagement.motion(engagement.exit_deg, 2).scalars()[:3]
    span = (engagement.exit_deg - _handover(engagement)) * DEGREE
    return max(0.0, min(-last, 2.0 * (u * span - (end - start)) / (span * span)))


def _handover(engagement: Engagement) -> float:
    """Input angle at which the second roller takes over, from mid-motion, degrees."""
    *_, handover, _ = engagement.motion.breaks_deg
    return handover


def _lag(mechanism: Mechanism, engagement: Engagement, drag: float) -> Lag:
    """Lag of a wheel that reaches its dwell with a drag M_r / (I w²)."""
    begin = _handover(engagement)
    start, u = engagement.motion(begin, 1).scalars()[:2]

    def lags(x: float) -> tuple[float, float]:
        """Lag, and its rate."""
        span = (x - begin) * DEGREE
        turned, speed = engagement.motion(x, 1).scalars()[:2]
        return turned - start - span * (u - 0.5 * drag * span), speed - u + drag * span

    most = boundary(lambda x: lags(x)[1] > 0.0, begin, engagement.exit_deg)
    struck = boundary(lambda x: lags(x)[0] > 0.0, most, engagement.exit_deg)
    at = (mechanism.shown_deg(engagement.mid_deg + x) for x in (most, struck))
    return Lag(lags(most)[0] / DEGREE, *at)
