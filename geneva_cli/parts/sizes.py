"""The sizes of a machine's parts, mm, and rules for hubs, bores, eyes and pins of all kinds."""

import math
from collections.abc import Iterable
from functools import reduce
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import refuse_size
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.arrays import choose, half_or, larger, smaller, value_or
from geneva_cli.numerics.tolerances import bore_radius, rounded_below, rounded_radius
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.shafts.bores import bore_of, has_shape, reach_or_bore
from geneva_cli.spec.defaults import eye_about
from geneva_cli.spec.tables import Size, Thicknesses
from geneva_cli.spec.workshops import Allowances

HUB = 1.6  # outside diameter of a hub, as a multiple of its bore
CLEARANCES = Allowances._fields[:-1]  # without their source
LARGEST_HUB = 0.75  # of the slots' ends: a quarter of the wheel up to them stays free


class Sizes(NamedTuple):
    """Lengths and radii, mm; bores and hubs are radii too. 0 for parts that do not exist."""

    roller: float
    half_width: float  # of the slot: roller and clearance
    rim: float  # of the wheel; of the opening if it is internal
    outer: float  # of an internal wheel, otherwise 0
    slot_bottom: float  # clearance between the deepest roller and a straight slot's end
    slot_end: float  # distance of the slot's bottom from the wheel's axis
    arm: float  # least distance of a roller's path from the crank's axis
    reaches: tuple[float, float]  # least and greatest, of the rollers at mid-motion, from that axis
    lock: float  # locking disc
    recess: float  # in the wheel: lock and clearance
    relief: float  # clearance between wheel and relief
    wall_min: float
    mouth_radius: float = 0.0  # of the rounded corners of straight slots' mouths
    horn_tip: float = 0.0  # width of the flats to which thinner horns are cut back
    space: float = 0.0  # radius about the crank's axis inside the relief
    # a load may change those below
    wheel_bore: float = 0.0
    wheel_reach: float = 0.0  # of the bore with its keyway, from the axis
    wheel_hub: float = 0.0
    crank_bore: float = 0.0
    crank_reach: float = 0.0
    crank_hub: float = 0.0
    pin: float = 0.0
    arm_bore: float = 0.0  # of the shaft in the arm, also where it ends there
    wheel_thickness: float = 0.0  # along the axis, of the rollers too
    lock_thickness: float = 0.0
    arm_thickness: float = 0.0
    link_thickness: float = 0.0
    first_pin: float = 0.0  # of the roller of a first wheel in front, under a load
    first_shaft: float = 0.0  # of that wheel's crank

    @property
    def horn(self) -> float:
        """Thickness of the horn between slot and recess, thinnest at the mouth or at its tip."""
        own = self.arm - self.half_width - self.recess
        return max(own, self.horn_tip) if self.horn_tip else own

    def passing_eye(self, away: float) -> float:
        """Return the radius of the largest eye, ``away`` from the axis, that passes the hub."""
        hub = larger(self.wheel_bore, self.wheel_hub)
        return choose(self.outer > 0.0, math.inf, away - hub)


Layout: TypeAlias = tuple[Assembly, Sizes]  # of one machine, or of m designs
Span: TypeAlias = tuple[float, float]  # lower and upper face, or two radii, mm
# The sizes of a machine's parts by keys of ``[size]``, mm and diameters as the keys say; and those
# of the keys that the spec leaves out and the load chooses.
KeySizes: TypeAlias = tuple[dict[str, float], tuple[str, ...]]


def drawn_thicknesses(size: Size, L: float) -> Thicknesses:
    """Return the thicknesses of a spec without a load."""
    return size.thicknesses(rounded_below(L / 10.0))


def pin_radius(size: Size, r: float) -> float:
    """Return the radius of a roller's pin of a spec without a load; 0 for none."""
    return 0.5 * value_or(size.pin_mm, rounded_below(r))


def plane_span(plane: int, gap: float, first: float, link: float, washer: float) -> Span:
    """Return lower and upper end, along the axis, of parts in a plane below the wheel's, mm."""
    high = -gap
    if plane > 1:
        high -= first + washer + (plane - 2) * (link + washer)
    return high - (first if plane == 1 else link), high


def bridge_low(size: Size, sizes: Sizes) -> float:
    """Return the lower face of a bridge over the crank, above wheel, locking disc and hub, mm."""
    gap = size.allowances.pin_gap_mm
    on_arm = larger(sizes.lock_thickness, value_or(size.crank_hub_length_mm, 0.0)) - gap
    return larger(sizes.wheel_thickness, on_arm) + gap + size.washer_mm


def hub_and_eye(
    size: Size, wall: float, hole: float, bore: float, passing: float, standing: float = 0.0
) -> tuple[float, float]:
    """Return the radii of an arm about the ``bore`` of its shaft and about the ``hole`` of a pin.

    ``passing`` is the largest eye that passes the wheel, ``standing`` that of a disc on the hub.
    """
    deep = bore_of(size, "crank", bore).reach
    hub = arm_hub(size, deep, bore, wall, standing)
    eye = arm_eye(size, hole, wall, passing)
    text = f"the hub must be above {2.0 * deep:.6g}, the diameter over its bore and keyway"
    refuse_size(hub <= deep, "arm_hub_mm", text, 2.0 * hub)
    text = f"the eye must be above {2.0 * hole:.6g}, the pin's hole"
    refuse_size(eye <= hole, "arm_eye_mm", text, 2.0 * eye)
    return hub, eye


def arm_hub(size: Size, bored: float, bore: float, wall: float, standing: float = 0.0) -> float:
    """Return the arm's radius about a bore that reaches to ``bored`` with its keyway."""
    least = larger(rounded_radius(HUB * bore), bored + wall)
    return half_or(size.arm_hub_mm, larger(least, standing))


def arm_eye(size: Size, hole: float, wall: float, passing: float) -> float:
    """Return the arm's radius about a pin's hole, by default at most ``passing``."""
    return half_or(size.arm_eye_mm, eye_about(hole, wall, passing))


def hole_radius(size: Size, pin: float) -> float:
    """Return the radius of the hole that holds a pin, not above 0 where none is left."""
    return pin - 0.5 * size.allowances.press_fit_mm


def pin_hole(size: Size, pin: float) -> float:
    """Return the radius of the hole that holds a pin. Raises GenevaError where none is left."""
    hole = hole_radius(size, pin)
    text = f"there is no hole for a pin of pin_mm = {2.0 * pin:g} with press_fit_mm = "
    text += f"{2.0 * (pin - hole):g}; the pin must be the larger"
    refuse_size(hole <= 0.0, "press_fit_mm" if pin else "pin_mm", text)
    return hole


def refuse_pin_and_edges(size: Size, pin: float, roller: float, thin: float) -> None:
    """Raise GenevaError for a pin, or edges, that leave nothing of a part.

    The pin's hole is in a roller with its least radius; the thinnest plate is ``thin`` mm thick.
    """
    loose, key = size.allowances.shaft_fit_mm, "edge_fillet_mm"
    text = "it must be below {least:.6g}, the roller's least diameter less shaft_fit_mm"
    wide = (pin > 0.0) & (2.0 * pin + loose >= 2.0 * roller)
    refuse_size(wide, "pin_mm", text, 2.0 * pin, least=2.0 * roller - loose)
    chamfer = size.edge_chamfer_mm is not None
    text = f"{key}: edges are either chamfered or rounded; remove one of edge_chamfer_mm and {key}"
    refuse_size(chamfer and size.edge_fillet_mm is not None, key, text)
    text = "it must be below {half:.6g}, half of the thinnest plate"
    key = "edge_chamfer_mm" if chamfer else key
    refuse_size(2.0 * size.edge_mm >= thin, key, text, size.edge_mm, half=0.5 * thin)


def arm_bore(spec: Spec, disc: float, L: float, space: float) -> float:
    """Return the radius of the arm's bore: of the spec, the ``disc``, or within a ``space``."""
    usual = bore_radius(smaller(L / 20.0, 0.35 * space))
    usual = choose(disc > 0.0, disc, half_or(spec.shaft.crank_diameter_mm, usual))
    return half_or(spec.size.arm_bore_mm, usual)


def within_hub(size: Size, part: str) -> float:
    """Return the largest default bore in the hub of a part, infinite without a hub."""
    hub_mm: float | None = vars(size)[f"{part}_hub_mm"]
    # a keyway is up to 0.39 of the bore's radius deep, and a hexagon's corner less
    most = ((0.5 / 1.6) if has_shape(size, part) else 0.4) * value_or(hub_mm, 0.0)
    return choose(most > 0.0, most, math.inf)


def wheel_bore(spec: Spec, end: float, wall: float, L: float) -> float:
    """Return the radius of the wheel's bore, by default with a wall to the slots' ends."""
    size, shaft = spec.size, spec.shaft.wheel_diameter_mm
    most = L / 12.0, 0.4 * end, end - wall, within_hub(size, "wheel")
    usual = bore_radius(reduce(smaller, most))
    if shaft is not None:
        usual = choose(0.5 * shaft <= end - wall, 0.5 * shaft, usual)
    return half_or(size.wheel_bore_mm, usual)


def refuse_bored_hub(part: str, hub: float, bored: float, bore: float) -> None:
    """Raise GenevaError for a hub that its bore, which reaches to ``bored``, cuts through."""
    text = "it must be above {over:.6g}, the diameter over bore and keyway; a smaller "
    text += f"{part}_bore_mm leaves more of it"
    wrong = (bore < hub) & (hub <= bored)
    refuse_size(wrong, f"{part}_hub_mm", text, 2.0 * hub, over=2.0 * bored)


def reach_and_hub(size: Size, part: str, bore: float, wall: float, end: float = 0.0) -> Span:
    """Return how far a part's bore reaches with its shape, and the radius of its hub."""
    usual = smaller(HUB * bore, LARGEST_HUB * end) if part == "wheel" else 1.5 * bore
    reach, usual = reach_or_bore(size, part, bore), rounded_radius(usual)
    default = choose(reach > bore, larger(usual, reach + wall), usual)
    return reach, half_or(vars(size)[f"{part}_hub_mm"], default)


def lock_bolt_directions(sectors: Iterable[tuple[float, float]], count: int) -> list[list[float]]:
    """Return the directions of the bolts of locking sectors, each its start and width, radians."""
    directions = list[list[float]]()
    for start, width in sectors if count else ():
        directions.append((start + width * (np.arange(count) + 0.5) / count).tolist())
    text = "lock_bolts: there is no locking disc to fix; remove it"
    refuse_size(count and not directions, "lock_bolts", text)
    return directions
