"""The shells of a spherical machine for a full turn: positions, lengths, gaps, largest roller."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.sphere import Region
from geneva_cli.kinds.spherical.ball import Ball, PartDoesNotFit
from geneva_cli.kinds.spherical.crank import sectors
from geneva_cli.kinds.spherical.gaps import BallGaps
from geneva_cli.kinds.spherical.sizes import ball
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.numerics.roots import boundary
from geneva_cli.parts.assembly import Assembly, assembled
from geneva_cli.spec.least_wall import wall_min


def fitted(mechanism: Mechanism, advice: bool = True) -> tuple[Ball, list[Region]]:
    """Return the sizes of a spherical machine, and its locking sectors.

    Raises GenevaError, naming the key, where they leave no wheel or no lock. With ``advice`` the
    message names the largest roller that fits, if there is one.
    """
    try:
        return _sizes_and_sectors(mechanism)
    except PartDoesNotFit as error:
        if not advice:
            raise
        # 10 halvings give the two digits that are shown
        most = boundary(lambda r: _fits(mechanism, r), 0.0, mechanism.roller_radius_mm, 10)
        if not most:
            raise
        text = f"{error}; a roller of {to_digits(most, 2, math.floor):g} mm fits"
        raise GenevaError(text, error.key) from None


def _fits(mechanism: Mechanism, roller_mm: float) -> bool:
    spec = mechanism.spec.with_("size.roller_radius_mm", roller_mm)
    try:
        _sizes_and_sectors(mechanism._replace(spec=spec))
    except GenevaError:
        return False
    return True


def _sizes_and_sectors(mechanism: Mechanism) -> tuple[Ball, list[Region]]:
    sizes = ball(mechanism)
    return sizes, sectors(sizes)


class BallLengths(NamedTuple):
    """Arc lengths on the sphere, mm; ``rim`` and ``outer`` are distances from the wheel's axis."""

    roller: float
    half_width: float
    rim: float
    outer: float  # the sphere's radius, where the rim lies beyond its equator, else 0
    arm: float
    horn: float
    wall_min: float


class Shells(NamedTuple):
    """Wheel and crank on a sphere, and the gaps between them."""

    assembly: Assembly
    ball: Ball
    sizes: BallLengths
    crank: list[Region]
    gaps: BallGaps


def shells(mechanism: Mechanism, advice: bool = True) -> Shells:
    """Return the shells of a machine.

    Raises GenevaError, naming the key, where its sizes leave none. With ``advice`` the message
    names a roller that fits.
    """
    ball, locks = fitted(mechanism, advice)
    L, assembly = ball.radius_mm, assembled(mechanism)
    lengths = BallLengths(
        roller=L * ball.roller,
        half_width=L * ball.half_width,
        rim=L * math.sin(ball.rim),
        outer=L if ball.rim > 0.5 * math.pi else 0.0,
        arm=L * math.sin(ball.arm),
        horn=L * (ball.arm - ball.half_width - ball.recess),
        wall_min=wall_min(mechanism.spec.size, L),
    )
    return Shells(assembly, ball, lengths, locks, BallGaps(assembly, ball, locks))
