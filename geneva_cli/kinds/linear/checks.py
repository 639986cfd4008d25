"""Checks of a rack, its horns, guide, shafts and gears, and the guide's quantities."""

from collections.abc import Collection, Iterator
from functools import partial

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import plates
from geneva_cli.geometry.shapes import as_contour, bounds
from geneva_cli.kinds.linear.guide import RackGuide, guide_place
from geneva_cli.kinds.linear.motion import guided
from geneva_cli.kinds.linear.parts import RackParts
from geneva_cli.kinds.linear.rack import rack_sizes
from geneva_cli.loads.contact import QuantityValue
from geneva_cli.loads.instant import Instant
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.motion.peak_search import greater
from geneva_cli.numerics.arrays import larger, value_or
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.spec.defaults import wall_min
from geneva_cli.verdict.checks import Check, compared
from geneva_cli.verdict.checks.part_checks import cuts, least_gap
from geneva_cli.verdict.quantities.groups import Columns, Designs
from geneva_cli.verdict.shaft_gap import gear_rings, ring_gaps, rings_of
from geneva_cli.verdict.strength import strength


def rack_horn(names: Collection[str], parts: RackParts) -> Iterator[Check]:
    """The wall between slot and recess of a rack that is locked."""
    mechanism = parts.mechanism
    try:
        sizes = rack_sizes(mechanism)
    except GenevaError:
        return  # the check of the parts reports the error
    if sizes.lock:
        least = wall_min(mechanism.spec.size, mechanism.center_distance_mm)
        yield compared("rack_horn_mm", sizes.horn, "at least", least)


def standing(names: Collection[str], parts: RackParts) -> Iterator[Check]:
    """Whether its guide locks, gaps of shafts and gears, and what the process can cut."""
    mechanism, load = parts.mechanism, parts.mechanism.spec.load
    L, friction = mechanism.center_distance_mm, value_or(load.guide_friction, load.friction)
    if friction and "guide_locks" in names:
        value = strength(mechanism)["guide.locks_at_friction"]  # the friction from which it locks
        if value:
            yield compared("guide_locks", value, "at least", friction)
    if not mechanism.spec.no_parts and "beside_shafts_mm" in names:  # there is a frame with shafts
        yield from least_gap("beside_shafts_mm", _shaft_gaps(parts), L)
    if "gear_gap_mm" in names:
        yield from least_gap("gear_gap_mm", _gear_gaps(parts), L)
    rack, lock, arm, _ = parts.sizes.thick
    yield from cuts(mechanism, max(rack, lock, arm), 2.0 * parts.sizes.half_width, rack)


def _shaft_gaps(parts: RackParts) -> Iterator[float]:
    """The gaps between shafts and a rack, of a crank's shaft that ends above the arm."""
    (rack,) = plates(parts.wheel.part)
    edge = bounds(rack.outline).x1
    for shaft in rings_of(parts.shafts):
        if shaft.high - rack.low > SAME_LENGTH * parts.mechanism.center_distance_mm:
            yield shaft.axis[0] - shaft.outer - edge


def _gear_gaps(parts: RackParts) -> Iterator[float]:
    """The gaps of gears before a rack's crank to its guide and to shafts."""
    rings = list(gear_rings(parts.mechanism, None))
    yield from ring_gaps(parts.mechanism, [], rings, parts.shafts)
    near = SAME_LENGTH * parts.mechanism.center_distance_mm
    for plate in (plate for one in parts.guide for plate in plates(one.part)):
        outline = Polyarc([as_contour(plate.outline)])
        for ring in rings:
            if min(ring.high, plate.high) - max(ring.low, plate.low) > near:
                yield float(outline.signed(np.array([ring.axis]))[0]) - ring.outer


def guide(of: Designs) -> Columns:
    """Return the guides of racks; none for a wheel, and for a rack that has no guide."""
    if not guided(of.spec):
        return {}
    place, mu = guide_place(of.machine), of.spec.load.friction
    R, r = of.machine.center_distance_mm, of.machine.roller_radius_mm
    far = R - place.middle
    lever = larger(larger(far - mu * (R - r), mu * (R + r) - far), mu * place.half)
    half = np.where(np.ravel(place.half) > 0.0, np.ravel(place.half), np.nan)
    out = {"length_mm": 2.0 * half, "locks_at_friction": half / np.ravel(lever)}
    if of.machine.spec.is_loaded:
        ends = {str(side): partial(_end_force, side) for side in (1.0, -1.0)}
        most = greater(*load_peaks(of.machine, own=ends).values())
        known = np.where(np.isnan(half), np.nan, of.loaded)
        out |= {"force_N": np.sqrt(most.max) * known, "at_deg": most.at_deg * known}
    return out


def _end_force(side: float, i: Instant) -> QuantityValue:
    """The squared force at one end of a guide, 1 or -1, as a quantity of ``load_peaks``."""
    guide = i.case.guide
    assert isinstance(guide, RackGuide)
    lever = guide.lever(i.case, i.at, i.drives, i.slides) * i.drives
    rub = i.slides * i.case.friction
    force = i.force_N * (lever * (0.5 * side / guide.half) + 0.5 * rub)
    return QuantityValue(force * force, i.grip)
