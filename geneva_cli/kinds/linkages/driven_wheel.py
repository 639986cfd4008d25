"""The wheel that a linkage's path can drive, solved for one design or for a batch.

This is the door of the search, which needs NumPy. The search is imported when it is first called,
so that a list of the kinds or of their keys starts without it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError, refuse

if TYPE_CHECKING:
    from geneva_cli.drives.path_wheels.wheels_for_paths import Alone
    from geneva_cli.drives.roller_path import RollerPath
    from geneva_cli.motion.engagement import Engagement
    from geneva_cli.motion.wheels.poses import HalfStep


def solve(
    path: RollerPath, step: HalfStep, wanted: float | None
) -> tuple[Engagement, float] | None:
    """Return the engagement of a path's wheel, and the centre distance in mm; None without a wheel.

    ``wanted`` is the crank angle (radians) near entry that selects one of several wheels.
    """
    from geneva_cli.drives.path_wheels.path_engagement import engagement_of
    from geneva_cli.drives.path_wheels.wheel_for_path import fit

    best = fit(path, step, wanted)
    return engagement_of(path, best, step) if best else None


def solve_batch(
    path: RollerPath, step: HalfStep, wanted: float | None, alone: Alone
) -> tuple[Engagement, float]:
    """Return the engagements of a batch of paths, and their centre distances (n, 1) in mm.

    ``alone(i)`` is the i-th design's path and ``wanted``; it raises GenevaError for a refused one.
    Designs without a wheel are refused.
    """
    from geneva_cli.drives.path_wheels.path_engagement import engagement_of_batch
    from geneva_cli.drives.path_wheels.wheels_for_paths import fits_of_batch, solve_alone

    long_path = path.in_long_doubles()
    fits = fits_of_batch(long_path, step.b, wanted)
    solve_alone(fits, step, alone)
    refuse(fits.entry != fits.entry, lambda: none_fits(step.q))
    return engagement_of_batch(long_path, fits, step)


def none_fits(z: int) -> GenevaError:
    """Error for a path that can drive no wheel of z slots."""
    return GenevaError(
        f"no wheel of z = {z} slots fits this path: change the linkage, or z. The path needs two "
        f"equally long tangents that meet at {360.0 / z:.6g} deg, with the roller nearer to that "
        "point only between them",
        ("drive", "kind"),
    )
