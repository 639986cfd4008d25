"""Whether every part can be built, and whether the process can cut it."""

from __future__ import annotations

import math
from collections.abc import Callable

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.parts import EdgedParts
from geneva_cli.spec.workshops import workshop
from geneva_cli.verdict.checks.check import Check, compared, refused


def thickest_plate(name: str, parts: FlatParts) -> Check | None:
    """The thickest plate of wheel, disc and arm, where the process has a limit."""
    sizes = parts.outlines.sizes
    thick = max(sizes.wheel_thickness, sizes.lock_thickness, sizes.arm_thickness)
    return plate_thickness(name, parts.mechanism, thick)


def slot_width(name: str, parts: FlatParts) -> Check | None:
    """The slots' width, where the process cuts none that is narrow for its plate."""
    sizes = parts.outlines.sizes
    return cut_width(name, parts.mechanism, 2.0 * sizes.half_width, sizes.wheel_thickness)


def plate_thickness(name: str, mechanism: Mechanism, thick: float) -> Check | None:
    """A thickness, where the process has a limit."""
    most = workshop(mechanism.spec.size.process).plate_mm
    return None if most == math.inf else compared(name, thick, "at most", most)


def cut_width(name: str, mechanism: Mechanism, wide: float, thick: float) -> Check | None:
    """A width, where the process cuts none that is narrow for its plate."""
    least = workshop(mechanism.spec.size.process).hole
    return compared(name, wide, "at least", least * thick) if least else None


def plates_built(name: str, parts: EdgedParts) -> Check | None:
    """The check that fails if a plate of a machine cannot be built; else None."""
    return built(name, parts.require)


def built(name: str, build: Callable[[], object]) -> Check | None:
    """The check that fails if something cannot be built; else None."""
    try:
        build()
    except GenevaError as error:
        return refused(name, error)
    return None
