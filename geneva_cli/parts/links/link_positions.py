"""Positions of a machine's links at input angles."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from geneva_cli.geometry.shapes import Point
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH


def turn_deg(mechanism: Mechanism) -> Array:
    """Return input angles of a whole turn, a quarter of a degree apart; 0 is in the middle."""
    turns = mechanism.spec.turns
    return np.linspace(-180.0 * turns, 180.0 * turns, 1440 * turns + 1)


def links_at(mechanism: Mechanism, input_deg: Array) -> tuple[Link, ...]:
    """Return a machine's links at input angles (n,), in degrees within half a period of mid-motion.

    They are the links of the drive and of the one before it and, for a cam-Geneva, the crank along
    which its rollers slide. The drive cannot describe that crank: in the dwell the rollers follow
    the groove as it is cut.
    """
    own = _own_links(mechanism, input_deg)
    return (*own, *_before(mechanism, input_deg, own))


def _own_links(mechanism: Mechanism, input_deg: Array) -> tuple[Link, ...]:
    """Return the links of the drive itself."""
    sign, own_deg = mechanism.spec.wheel.SIGN, mechanism.own_deg(input_deg)
    own = mechanism.spec.drive.links(mechanism.plan, sign, own_deg)
    groove = mechanism.engagements[0].groove
    if groove is None:
        return own
    from geneva_cli.motion.groove_path import roller_in_groove

    L, m, still = mechanism.center_distance_mm, mechanism.spec.drive.rollers, 0.0 * input_deg
    joints = [(still + L, still)]
    for k in range(m):
        x, y = L * roller_in_groove(groove, own_deg - 360.0 * k / m).T
        joints.append((x, y))
    return (*own, Link("crank", tuple(joints), (Joint.SHAFT, *[Joint.CARRIED] * m), 1))


def _before(mechanism: Mechanism, input_deg: Array, own: tuple[Link, ...]) -> Iterator[Link]:
    """Yield the links of the drive before, on the shaft that it turns, below all others."""
    spec, shaft = mechanism.spec, mechanism.own_shaft
    if spec.drive_before is None:
        return
    sign, names = spec.wheel.SIGN, {link.name for link in own}
    mirror, shift = -sign * shaft.sense, shaft.x_mm - mechanism.center_distance_mm
    below = _deepest(mechanism, own)
    for link in spec.drive_before.links(mechanism.plan, sign, input_deg):
        yield link._replace(
            name=f"first {link.name}" if link.name in names else link.name,
            joints=tuple((x + shift, y * mirror) for x, y in link.joints),
            plane=link.plane - 1 + below,
        )


def _deepest(mechanism: Mechanism, own: Iterable[Link]) -> int:
    """Return the number of the lowest plane of the arm, the drive's links, or a groove plate."""
    if mechanism.engagements[0].groove is not None:
        return 3  # of its base, below the groove and the crank
    return max((link.plane for link in own), default=1)


def gear_plane(mechanism: Mechanism) -> int:
    """Return the number of the plane of noncircular gears: below the arm and the drive's links."""
    return 1 + _deepest(mechanism, _own_links(mechanism, np.zeros(1)))


def is_bridged(mechanism: Mechanism) -> bool:
    """Return True if a bridge bears the crank's shaft, because a link turns over its axis below."""
    spec, size, L = mechanism.spec, mechanism.spec.size, mechanism.center_distance_mm
    single = len(mechanism.wheel_places) == len(mechanism.crank_places) == 1
    own_ends = size.crank_shaft_low_mm is None and size.crank_shaft_high_mm is None
    if spec.drive_before or spec.wheel.SIGN < 0.0 or not (single and own_ends):
        return False
    bars = [link for link in links_at(mechanism, np.array([-180.0, 0.0])) if not link.radius_mm]
    joints = {link.name: [x + 1j * y - L for x, y in link.joints] for link in bars}
    near = SAME_LENGTH * L
    on_shaft = [link.plane for link in bars if np.abs(joints[link.name][0]).max() < near]
    below = (link for link in bars if link.plane > max(on_shaft, default=math.inf))
    # the axis lies between the ends of the link, with which it is in line
    return any(
        bool(np.any((np.abs(np.imag(p * np.conj(q))) < near * L) & (np.real(p * np.conj(q)) < 0.0)))
        for p, q, *_ in (joints[link.name] for link in below)
    )


def same(p: Point, q: Point, L: float) -> bool:
    """Return True if two points coincide, with the centre distance L."""
    return abs(complex(*p) - complex(*q)) < SAME_LENGTH * L
