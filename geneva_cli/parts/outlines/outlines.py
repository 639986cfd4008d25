"""The outlines of wheel and crank of one machine, and the wheel as a plate with holes and hub."""

from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, Contour
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import value_or
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.shafts.bores import BoltCircle, bolt_circle, bore_of, has_shape
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.spec.tables import Size


class Outlines(NamedTuple):
    """The outlines of wheel and crank, with the sizes and the positions that they are cut for.

    ``slots`` has the walls of each kind of slot, and ``cut`` those of each slot in its place, as
    roundings and flats leave them. ``close`` is the overlap, mm, that counts as
    rounding or as the walls' tolerance. ``gaps`` has all recesses of a wheel, also that which a
    stop leaves convex.
    """

    assembly: Assembly
    sizes: Sizes
    slots: dict[Engagement, Contour]
    wheel: Contour
    cut: tuple[Contour, ...]
    crank: list[Contour]
    relief: str
    gaps: Gaps
    close: float

    @property
    def relief_depth(self) -> float:
        """The distance of the crank's outline from its axis at the bottom of a relief, mm."""
        return abs(float(Polyarc(self.crank).signed(np.zeros((1, 2)))[0]))

    @property
    def has_arm(self) -> bool:
        """True if the machine has an arm: a crank with rollers on pins."""
        return self.assembly.full.spec.drive.ONE_ARM and self.sizes.pin > 0.0


def wheel_holes(assembly: Assembly, sizes: Sizes) -> tuple[Contour | Circle, ...]:
    """Return the wheel's bore in its shape, if it has one, and the dial's bolts."""
    size, bolts = assembly.mechanism.spec.size, dial_circle(assembly, sizes).holes
    if not (sizes.wheel_bore or has_shape(size, "wheel")):
        return tuple(bolts)
    return (bore_of(size, "wheel", sizes.wheel_bore).shape("BORE", assembly.rests[0]), *bolts)


def dial_circle(assembly: Assembly, sizes: Sizes) -> BoltCircle:
    """Return the bolts of the dial, by default midway between bore and slots or recesses."""
    size = assembly.mechanism.spec.size
    ring = sizes.wheel_reach, sizes.slot_end
    if sizes.outer:
        ring = max(sizes.slot_end, assembly.L + sizes.recess), sizes.outer
    return bolt_circle(size, "dial", assembly.L, ring, assembly.rests[0])


def wheel_hub(assembly: Assembly, sizes: Sizes) -> Plate | None:
    """Return the hub below the wheel; None unless the spec has its diameter or its length."""
    size = assembly.mechanism.spec.size
    if not (size.has_hub("wheel") and sizes.wheel_hub > sizes.wheel_bore):
        return None
    bore = wheel_holes(assembly, sizes)[:1] if sizes.wheel_bore else ()
    outline, low = Circle("HUB", ORIGIN, sizes.wheel_hub), -wheel_hub_length(size, sizes)
    return Plate("wheel's hub", "HUB", outline, bore, low, 0.0)


def wheel_hub_length(size: Size, sizes: Sizes) -> float:
    """Return the length of the wheel's hub: by default as far down as the crank arm."""
    return value_or(size.wheel_hub_length_mm, size.allowances.pin_gap_mm + sizes.arm_thickness)


def wheel_plate(assembly: Assembly, sizes: Sizes, contour: Contour) -> Plate:
    """Return the wheel as a plate; an internal wheel's contour is the opening in its disc."""
    outline: Contour | Circle = contour
    holes = wheel_holes(assembly, sizes)
    if sizes.outer:
        outline, holes = Circle("WHEEL", ORIGIN, sizes.outer), (contour, *holes)
    return Plate("wheel", contour.layer, outline, holes, 0.0, sizes.wheel_thickness)
