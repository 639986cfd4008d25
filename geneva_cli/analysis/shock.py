"""Shocks: a roller that meets its slot off its line, and the change of sides through the play.

The crank's radius R and the centre distance L are never quite right. The roller should come into
the resting slot along its axis; with R/L too large by a share eps its path crosses that axis
instead, before the entry, and the wheel is struck back at about tan b sqrt(2 eps) of the input's
speed: by the root of the error. With R/L too small it never reaches the axis, and meets the mouth.

Where the wheel's torque changes its sign the roller leaves one wall for the other: the wheel coasts
through the play and is struck by its difference in speed.

Speeds are in units of the input's, angles of the wheel in radians, input angles in degrees from
the engagement's own mid-motion.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.carried import inertia_kgm2, resisting_torque_Nm
from geneva_cli.machine.engagement import Engagement, Motion
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE, omega
from geneva_cli.numerics.arrays import N
from geneva_cli.numerics.roots import extrema, root

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

STEPS = 64  # halvings, every half an octave, in which a crossing is bracketed
SCAN = 720  # places at which the torque's sign is looked at
ROUNDING_DEG = 1e-12  # nearer to mid-motion a change of sign is there
NO_TORQUE = 1e-9  # of the greatest: less is rounding
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)  # exact to a double over half a motion


class Contact(NamedTuple):
    """Where a roller first reaches the axis of the slot at rest, and what it does to the wheel."""

    at_deg: float
    jump: float  # of the wheel's velocity, over the input's; < 0: the wheel is struck back


class Line(NamedTuple):
    """The axis of the slot at rest as the roller comes to it, for errors of R and L.

    In the frame of the axis, from the wheel's centre outwards, the roller's place is
    (1 + crank) p - (crank - center) c, p being its true place and c the hub of the crank's arm.
    On a sphere, whose shafts meet whatever its radius, ``center`` has no meaning but 0.
    """

    engagement: Engagement
    beside: float  # of the hub: how far it is ahead of the line through the wheel's centre,
    along: float  # and how far along it

    @staticmethod
    def of(engagement: Engagement) -> Line:
        """Of an engagement with a straight slot."""
        x, y = engagement.slot(0.5 * engagement.entry_deg, 1)  # a straight slot: anywhere
        (px, u), (py, v) = x.scalars(), y.scalars()
        way = math.copysign(1.0, px * u + py * v)
        hub, ahead = engagement.hub, engagement.half_step - math.atan2(way * v, way * u)
        return Line(engagement, hub * math.sin(ahead), hub * math.cos(ahead))

    def aside(self, crank: N, center: N) -> N:
        """How far the true path is from the axis where the one with errors crosses it, over L."""
        arm = self.beside + self.engagement.slot.offset  # from the slot's axis
        return (crank * arm - center * self.beside) / (1.0 + crank)

    def way(self, tau: float) -> tuple[float, float]:
        """How far the true path is from the axis ``tau`` radians after entry, and its slope."""
        anchor = self.engagement.motion.entry
        assert anchor is not None  # ``contact`` asks for it
        _, across = anchor.displacement(tau, 1)
        value, slope = across.scalars()
        return value, slope

    def jump(self, tau: float, crank: float, center: float) -> float:
        """The velocity that the roller gives to the wheel on the axis."""
        anchor = self.engagement.motion.entry
        assert anchor is not None  # ``contact`` asks for it
        along, across = anchor.displacement(tau, 1)
        lever = anchor.along + along.c[0] + (center - crank) / (1.0 + crank) * self.along
        return float(across.c[1] / lever)


def contact(engagement: Engagement, crank: float, center: float = 0.0) -> Contact | None:
    """The first contact for relative errors of the crank's radius and of the centre distance.

    Of a roller on a crank's arm; elsewhere only ``center`` has a meaning. None where the roller
    never reaches the slot's axis, and meets the mouth; where there are no errors; and for slots
    and grooves that are solved for. A radial slot has sin(phi + b) = sin b / l there.

        >>> from geneva_cli import Design, External
        >>> contact(Design(External(3)).mechanism.engagements[0], crank=1e-4)
        Contact(at_deg=-30.81025092485702, jump=-0.023909826405751...)
    """
    if engagement.motion.entry is None:
        return None
    line = Line.of(engagement)
    aside = line.aside(crank, center)
    tau = reached(line, aside)
    if tau is None:
        return None
    return Contact(engagement.entry_deg + tau / DEGREE, line.jump(tau, crank, center))


def reached(line: Line, aside: float) -> float | None:
    """Input radians after the true entry at which the roller reaches the axis; None: it does not.

    The roller comes from one side, ``before``, and at a true entry stays on it (a circle) or goes
    over to the other (a path with an inflection).
    """
    span = 0.5 * line.engagement.motion_deg * DEGREE
    before = line.way(-1e-3 * span)[0]
    if aside == 0.0:
        return None
    if aside * before > 0.0:
        side = -span
    elif aside > 0.0:
        side = span
    else:
        return None
    near = 0.0
    for k in range(STEPS, -1, -1):
        far = side * 0.5 ** (0.5 * k)
        if abs(line.way(far)[0]) >= abs(aside):
            return root(lambda t: _less(line.way(t), aside), near, far)
        near = far
    return None


def _less(value: tuple[float, float], by: float) -> tuple[float, float]:
    return value[0] - by, value[1]


class Impact(NamedTuple):
    """A change of sides: where the wheel begins to coast, where it is struck, and how fast."""

    from_deg: float
    at_deg: float
    speed: float  # of the wheel against the slot, over the input's


def impacts(engagement: Engagement, play: float, drag: float = 0.0) -> list[Impact]:
    """The changes of sides in a motion, for a play of the wheel in radians, both ways together.

    ``drag`` is M_r / (I w²). The wheel coasts from where psi2 = -drag, slowed by it alone, until it
    is ``play`` ahead of the slot (or behind it, where the torque comes back). None of it where a
    drag holds the roller on one wall, or where the motion ends before.

        >>> from geneva_cli import Design, External
        >>> impacts(Design(External(3)).mechanism.engagements[0], 1e-4)
        [Impact(from_deg=0.0, at_deg=0.55220712276288..., speed=0.03107164009469...)]
    """
    found = [impact(engagement, start, play, drag) for start in changes(engagement, drag)]
    return [one for one in found if one]


def impact(engagement: Engagement, start: float, play: float, drag: float = 0.0) -> Impact | None:
    """The one change of sides that begins at ``start``; None: not taken up before the motion ends.

    The sign of what the wheel gains tells which way it goes.
    """
    span = (engagement.exit_deg - start) * DEGREE
    whole = _gained(engagement, start, drag, span)[0]
    if not 0.0 < play <= abs(whole):
        return None

    def over(x: float) -> tuple[float, float]:
        ahead, faster = _gained(engagement, start, drag, x)
        way = math.copysign(1.0, ahead)
        return way * ahead - play, way * faster

    at = root(over, 0.0, span)
    return Impact(start, start + at / DEGREE, abs(_gained(engagement, start, drag, at)[1]))


def changes(engagement: Engagement, drag: float) -> list[float]:
    """Where the wheel's torque changes its sign inside a motion: psi2 = -drag."""
    motion = engagement.motion
    breaks = motion.breaks_deg
    parts = zip(breaks[:-1], breaks[1:], strict=True)
    grid = np.unique([x for a, b in parts for x in np.linspace(a, b, SCAN // (len(breaks) - 1))])
    # beside the breaks, where a derivative may jump; and the peaks, of which none is stepped over
    grid = np.unique([*(0.5 * (grid[1:] + grid[:-1])), *_peaks(motion)])
    torque = motion(grid, 2).arrays()[2] + drag
    # a law may run at constant speed for a while
    kept = abs(torque) > NO_TORQUE * abs(torque).max()
    grid, torque = grid[kept], torque[kept]
    at = np.flatnonzero(torque[:-1] * torque[1:] < 0.0)

    def slope(x: float) -> tuple[float, float]:
        _, _, a, j = motion(x, 3).scalars()
        return a + drag, j * DEGREE

    found = [root(slope, float(grid[i]), float(grid[i + 1])) for i in at]
    return [0.0 if abs(x) < ROUNDING_DEG else x for x in found]


def _gained(engagement: Engagement, start: float, drag: float, x: float) -> tuple[float, float]:
    """By how much the wheel is ahead of the slot, and faster, x radians after it began to coast.

    d = -int (x - t) (psi2 + drag) dt, which loses no digits however small the play.
    """
    motion, end = engagement.motion, start + x / DEGREE
    inner = [start, *[b for b in motion.breaks_deg if start < b < end], end]
    ahead = faster = 0.0
    for a, b in zip(inner[:-1], inner[1:], strict=True):
        t: Array = 0.5 * (a + b) + 0.5 * (b - a) * NODES
        torque = (motion(t, 2).arrays()[2] + drag) * WEIGHTS * (0.5 * (b - a) * DEGREE)
        ahead -= float((torque * ((end - t) * DEGREE)).sum())
        faster -= float(torque.sum())
    return ahead, faster


def drag_over(mechanism: Mechanism) -> float:
    """M_r / (I w²) of the spec's load; infinite without an inertia: nothing coasts."""
    inertia = inertia_kgm2(mechanism.spec)
    w = omega(mechanism.spec.drive.n_rpm)
    drag = resisting_torque_Nm(mechanism.spec)
    return drag / (inertia * w * w) if inertia else math.inf


def lasting_drag_Nm(mechanism: Mechanism) -> float:
    """The torque that must be added for the roller to stay on one wall: I w² max(-psi2) - M_r.

    0 where it stays there already.
    """
    inertia = inertia_kgm2(mechanism.spec)
    w = omega(mechanism.spec.drive.n_rpm)
    most = max(braking(engagement) for engagement in mechanism.engagements)
    return max(inertia * w * w * most - resisting_torque_Nm(mechanism.spec), 0.0)


def braking(engagement: Engagement) -> float:
    """The greatest -psi2 of a motion."""
    motion = engagement.motion
    places = (*motion.breaks_deg, *_peaks(motion))
    return max(-motion(x, 2).scalars()[2] for x in places)


def _peaks(motion: Motion) -> list[float]:
    """Where the acceleration is stationary."""

    def curve(x: float) -> tuple[float, float, float]:
        _, _, a, j, s = motion(x, 4).scalars()
        return a, j * DEGREE, s * DEGREE * DEGREE

    breaks = motion.breaks_deg
    return [x for a, b in zip(breaks[:-1], breaks[1:], strict=True) for x in extrema(curve, a, b)]
