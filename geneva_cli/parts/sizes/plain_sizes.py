"""The record of all sizes, and those that follow from the spec alone; mm."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.numerics.preferred import rounded_below
from geneva_cli.spec.default_sizes import Thicknesses, value_or

if TYPE_CHECKING:
    from geneva_cli.spec.tables import Size


class FirstSizes(NamedTuple):
    """What a load needs of the first wheel's parts, mm."""

    thickness: float  # of the wheel and its crank
    pin: float  # radius of the roller's pin
    shaft: float  # radius of its crank's shaft


class Sizes(NamedTuple):
    """Lengths and radii, mm; bores and hubs are radii too. 0 for parts that do not exist."""

    roller: float
    half_width: float  # of the slot: roller and clearance
    rim: float  # of the wheel; of the opening if it is internal
    outer: float  # of an internal wheel, otherwise 0
    slot_bottom: float  # clearance between the deepest roller and a straight slot's end
    slot_end: float  # distance of the slot's bottom from the wheel's axis
    arm: float  # least distance of a roller's path from the crank's axis
    lock: float  # locking disc
    recess: float  # in the wheel: lock and clearance
    relief: float  # clearance between wheel and relief
    wall_min: float
    wheel_bore: float
    wheel_reach: float  # of the bore with its keyway, from the axis
    wheel_hub: float
    crank_bore: float
    crank_reach: float
    crank_hub: float
    pin: float
    arm_bore: float  # of the shaft in the arm, also where it ends there
    wheel_thickness: float  # along the axis, of the rollers too
    lock_thickness: float
    arm_thickness: float
    link_thickness: float
    first: FirstSizes | None = None  # of a first wheel in front, under a load

    @property
    def horn(self) -> float:
        """Thickness of the horn between slot and recess, thinnest at the mouth."""
        return self.arm - self.half_width - self.recess

    @property
    def outline(self) -> Sizes:
        """The sizes of the outlines of wheel and crank: 0 for those that a load may change."""
        return self._replace(
            wheel_bore=0.0,
            wheel_reach=0.0,
            wheel_hub=0.0,
            crank_bore=0.0,
            crank_reach=0.0,
            crank_hub=0.0,
            pin=0.0,
            arm_bore=0.0,
            wheel_thickness=0.0,
            lock_thickness=0.0,
            arm_thickness=0.0,
            link_thickness=0.0,
            first=None,
        )


def drawn_thicknesses(size: Size, L: float, parts: Sizes | None = None) -> Thicknesses:
    """Return the thicknesses of ``parts``, or else of a spec."""
    if parts:
        own = parts.wheel_thickness, parts.lock_thickness, parts.arm_thickness
        return Thicknesses(*own, parts.link_thickness)
    return size.thicknesses(L, rounded_below)


def pin_radius(size: Size, r: float, parts: Sizes | None = None) -> float:
    """Return the radius of a roller's pin, that of ``parts`` or else of a spec; 0 for none."""
    return parts.pin if parts else 0.5 * size.pin_diameter(r, rounded_below)


def plane_span(
    plane: int, gap: float, first: float, link: float, washer: float
) -> tuple[float, float]:
    """Return lower and upper end, along the axis, of parts in a plane below the wheel's, mm.

    The first plane is ``gap`` mm below the wheel and ``first`` mm thick. Those below it are
    ``link`` mm thick, with washers between.
    """
    high = -gap
    if plane > 1:
        high -= first + washer + (plane - 2) * (link + washer)
    return high - (first if plane == 1 else link), high


def bridge_low(size: Size, sizes: Sizes) -> float:
    """Return the lower face of a bridge over the crank, above wheel, locking disc and hub, mm."""
    gap = size.allowances.pin_gap_mm
    on_arm = max(sizes.lock_thickness, value_or(size.crank_hub_length_mm, 0.0)) - gap
    return max(sizes.wheel_thickness, on_arm) + gap + size.washer_mm


def half_or(diameter: float | None, default: float) -> float:
    """Return half of a diameter, or the default radius if that is None."""
    return default if diameter is None else 0.5 * diameter
