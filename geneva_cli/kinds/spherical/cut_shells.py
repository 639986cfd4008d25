"""Shells as they are cut within the tolerances: their locks, and the extremes of their machines."""

from __future__ import annotations

import math

from geneva_cli.kinds.spherical.locking import SphereLock
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.kinds.spherical.shells import Shells
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.parts.parts import Parts
from geneva_cli.verdict.tolerance.lock_tolerances import SAME, Corners, CutParts


class CutShells(CutParts):
    """Shells as they are cut."""

    def __init__(self, parts: Parts) -> None:
        assert isinstance(parts, SphereParts)
        self.shells = parts.shells

    def locks(self) -> list[SphereLock]:
        """Return the locks, one for each shape; none without locking sectors."""
        return sphere_locks(self.shells)

    def corners(self, spec: Spec, sizes: dict[str, float], slot: float) -> Corners:
        """Return the clearance of the lock, an arc, and the specs of tightest and loosest machine.

        The radii that deviate are from the crank's axis, L times the sine of the angle from it.
        """
        ball = self.shells.ball
        size, L = spec.size, ball.radius_mm
        least = _arc_increase_mm(ball.lock, sizes["lock_radius_mm"] + sizes["recess_radius_mm"], L)

        def corner(sign: float) -> Spec:
            roller = L * ball.roller - sign * 0.5 * sizes["roller_diameter_mm"]
            clearance = max(size.allowances.slot_clearance_mm + sign * slot, 0.0)
            beyond = L * (ball.half_width - ball.bottom) - roller - clearance
            disc = L * math.sin(ball.lock) - sign * sizes["lock_radius_mm"]
            changed = size.replace(
                roller_radius_mm=roller,
                slot_clearance_mm=clearance,
                slot_bottom_clearance_mm=max(beyond + L * (ball.axes - ball.arm), 0.0),
                lock_radius_mm=disc,
            )
            if ball.lock:
                recess = (
                    ball.recess
                    + _arc_increase_mm(ball.recess, sign * sizes["recess_radius_mm"], L) / L
                )
                changed = changed.replace(
                    lock_clearance_mm=max(L * (recess - math.asin(disc / L)), 0.0)
                )
            return spec.replace(size=changed)

        return least if ball.lock else None, corner


def sphere_locks(shells: Shells) -> list[SphereLock]:
    """Return a recess with each locking sector of a spherical crank; empty without one."""
    ball = shells.ball
    halves = {
        round(edge.sweep / SAME): 0.5 * edge.sweep
        for region in shells.crank
        for edge in region.boundary[:1]  # it begins with the locking edge
    }
    return [
        SphereLock(ball.radius_mm, ball.axes, ball.lock, ball.recess, ball.rim, half)
        for half in halves.values()
    ]


def _arc_increase_mm(angle: float, by: float, L: float) -> float:
    """Return the arc, mm, by which an angle grows if its radius L sin(angle) grows ``by``."""
    return L * (math.asin(min(1.0, max(-1.0, math.sin(angle) + by / L))) - angle)
