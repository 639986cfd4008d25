"""Whether every part can be built, and whether the process can cut it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.sizes.plain_sizes import drawn_thicknesses
from geneva_cli.spec.workshops import workshop
from geneva_cli.verdict.checks.check import Check, compared, refused

if TYPE_CHECKING:
    from geneva_cli.kinds.linear.parts import RackParts
    from geneva_cli.kinds.spherical.parts import SphereParts


def thickest_plate(name: str, parts: FlatParts) -> Check | None:
    """The thickest plate of wheel, disc and arm, where the process has a limit."""
    sizes = parts.outlines.sizes
    thick = max(sizes.wheel_thickness, sizes.lock_thickness, sizes.arm_thickness)
    return _thickness(name, parts.mechanism, thick)


def thickest_shell(name: str, parts: SphereParts) -> Check | None:
    """The thickest shell of a sphere, where the process has a limit for plates."""
    ball = parts.ball
    spans = ball.span_mm, ball.lock_span_mm, ball.arm_span_mm
    return _thickness(name, parts.mechanism, max(outer - inner for inner, outer in spans))


def thickest_of_rack(name: str, parts: RackParts) -> Check | None:
    """The thickest plate of a rack's machine, where the process has a limit.

    Bar, rail and wall of the guide are bars, which may be cut from stock.
    """
    thick = drawn_thicknesses(parts.mechanism.spec.size, parts.sizes.arm)
    return _thickness(name, parts.mechanism, max(thick.wheel, thick.lock, thick.arm))


def slot_width(name: str, parts: FlatParts) -> Check | None:
    """The slots' width, where the process cuts none that is narrow for its plate."""
    sizes = parts.outlines.sizes
    return _width(name, parts.mechanism, 2.0 * sizes.half_width, sizes.wheel_thickness)


def width_in_shell(name: str, parts: SphereParts) -> Check | None:
    """The width of a sphere's slots inside, where the process cuts none that is narrow."""
    inner, outer = parts.ball.span_mm
    wide = 2.0 * inner * math.sin(parts.ball.half_width)
    return _width(name, parts.mechanism, wide, outer - inner)


def width_in_rack(name: str, parts: RackParts) -> Check | None:
    """The width of a rack's slots, where the process cuts none that is narrow for its plate."""
    thick = drawn_thicknesses(parts.mechanism.spec.size, parts.sizes.arm).wheel
    return _width(name, parts.mechanism, 2.0 * parts.sizes.half_width, thick)


def _thickness(name: str, mechanism: Mechanism, thick: float) -> Check | None:
    most = workshop(mechanism.spec.size.process).plate_mm
    return None if most == math.inf else compared(name, thick, "at most", most)


def _width(name: str, mechanism: Mechanism, wide: float, thick: float) -> Check | None:
    least = workshop(mechanism.spec.size.process).hole
    return compared(name, wide, "at least", least * thick) if least else None


def plates_built(name: str, parts: FlatParts | RackParts) -> Check | None:
    """The check that fails if a plate of a machine cannot be built; else None."""
    return _refusal(name, parts.require)


def solids_built(name: str, parts: SphereParts) -> Check | None:
    """The check that fails if a solid of a spherical machine cannot be built; else None."""
    return _refusal(name, lambda: parts.members)


def _refusal(name: str, build: Callable[[], object]) -> Check | None:
    try:
        build()
    except GenevaError as error:
        return refused(name, error)
    return None
