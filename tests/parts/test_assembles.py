"""Every machine assembles: bores fit their shafts, what turns with one touches it, none overlap.

Solids are compared as shapely's polygons, which know nothing of the sizes that made them.
"""

import cmath
import random
from itertools import combinations

import numpy as np
import pytest
from drawing_witness import polygon
from sampling import some
from shapely import affinity

from geneva_cli import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group
from geneva_cli.geometry.shapes import Circle
from geneva_cli.motion import registry
from geneva_cli.motion.pivots import Joint
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.links.links import places
from geneva_cli.spec.workshops import PROCESSES
from geneva_cli.specfile.template import template

NEAR = 1e-6  # mm: more than rounding, less than any clearance
SAGITTA = 0.002  # mm
DEEP = 0.02  # mm: more than the sagittas of two polygons, and a groove's tolerance
SAMPLES = some(6, 1)  # of each kind
TURN = np.linspace(-180.0, 180.0, 25)  # deg; the middle one is input angle 0
# of each key a least and a greatest value, as fractions of the centre distance or the key's own
SIZES = {
    "size.link_bore_mm": (0.03, 0.12),
    "size.link_pin_mm": (0.02, 0.06),
    "size.link_width_mm": (0.06, 0.15),
    "size.crank_bore_mm": (0.04, 0.12),
    "size.arm_bore_mm": (0.03, 0.12),
    "shaft.crank_diameter_mm": (0.03, 0.3),
    "size.wheel_hub_mm": (0.0, 0.2),
    "size.roller_radius_mm": (0.03, 0.07),
    "size.washer_mm": (0.0, 0.01),
    "size.pin_gap_mm": (0.0, 0.02),
    "size.shaft_fit_mm": (0.0, 0.004),
}
OWN = {
    "side-crank": {"drive.A": (-0.95, 0.95), "wheel.z": (4, 12)},
    "epicyclic": {"drive.fixed": ("sun", "ring"), "drive.planet_ratio": (-0.11, 0.029)},
    "geneva-pair": {"drive.first_distance_mm": (50.0, 160.0), "drive.first_z": (3, 4)},
    "elliptical-gears": {"drive.eccentricity": (0.1, 0.7)},
}


def samples(tmp_path, kind):
    """The example of a kind, and it with some keys drawn by lot, always the same."""
    spec = tmp_path / f"{kind}.toml"
    spec.write_text(template(kind) if kind != "crank" else "[wheel]\nz = 6\n")
    whole = load(str(spec))
    yield {}, whole
    L, lot = whole.mechanism.center_distance_mm, random.Random(kind)
    for _ in range(SAMPLES):
        given = {}
        for key, (low, high) in OWN.get(kind, {}).items():
            if isinstance(low, str):
                given[key] = f'"{lot.choice((low, high))}"'
            elif isinstance(low, int):
                given[key] = lot.randint(low, high)
            else:
                given[key] = round(lot.uniform(low, high), 3)
        for key in lot.sample(list(SIZES), 3):
            low, high = SIZES[key]
            given[key] = round(L * lot.uniform(low, high), 2)
        try:
            yield given, load(str(spec), [f"{key}={value}" for key, value in given.items()])
        except GenevaError:
            continue


class Solid:
    """A plate where it is at input angle 0: its name, its polygon, its span."""

    def __init__(self, plate, at, turn, body):
        self.name, self.low, self.high, self.body = plate.name, plate.low, plate.high, body
        self.layer, self.at = plate.layer, at
        self.bores = [
            (at + cmath.rect(1.0, turn) * complex(*hole.centre), hole.radius)
            for hole in plate.holes
            if isinstance(hole, Circle) and hole.layer == "BORE"
        ]
        self.radius = plate.outline.radius if isinstance(plate.outline, Circle) else None
        self.shape = plate.outline
        outside, holes = (
            polygon(plate.outline, SAGITTA),
            [polygon(hole, SAGITTA) for hole in plate.holes],
        )
        self.torn = any(not outside.contains(hole) for hole in holes) or any(
            one.intersects(other) for one, other in combinations(holes, 2)
        )
        for hole in holes:
            outside = outside.difference(hole)
        outside = affinity.rotate(outside, turn, (0.0, 0.0), use_radians=True)
        self.polygon = affinity.translate(outside, at.real, at.imag)

    def shares_height(self, other):
        return min(self.high, other.high) - max(self.low, other.low) > NEAR


def flat(part, at, turn, body):
    if isinstance(part, Group):
        for one in part.members:
            there = at + cmath.rect(1.0, turn) * complex(*one.at)
            yield from flat(one.part, there, turn + one.turn, body)
    else:
        yield Solid(part, at, turn, body)


def solids(parts):
    """All solids; ``body`` says what moves with what."""
    moved = {id(member): "link" for member in (*parts.links.cut, *parts.links.joined)}
    moved |= {id(member): "gear" for member in (*parts.round_gears, *parts.gear_pair)}
    moved |= {id(member): "fixed" for member in (*parts.shafts, *parts.standing)}
    moved |= {id(parts.wheel): "wheel", id(parts.crank): "crank"}
    moved |= {id(member): "orbiting" for member in parts.orbiting}
    for member in parts.members:
        body = moved.get(id(member), "first")
        yield from flat(member.part, complex(*member.at), member.turn, body)


def misfits(every, L, fit):
    """Round shafts and the bores about them that are not wider by the fit."""
    for shaft in (one for one in every if one.layer == "SHAFT" and one.radius):
        for one in (one for one in every if one is not shaft and one.shares_height(shaft)):
            for at, radius in one.bores:
                loose = 2.0 * (radius - shaft.radius)
                if abs(at - shaft.at) < NEAR and abs(loose - fit) > 1e-9 * L:
                    yield shaft.name, one.name, radius, shaft.radius


def loose(every, axes):
    """Parts that turn about an axis and touch no shaft there."""
    for name, at in axes:
        shafts = [s for s in every if s.layer == "SHAFT" and abs(s.at - at) < NEAR]
        for one in every:
            if one.name != name or (name == "wheel" and abs(one.at - at) > NEAR):
                continue  # of several wheels each has its own axis
            bored = any(abs(z - at) < NEAR for z, _ in one.bores)
            ends = any(
                min(abs(one.low - s.high), abs(one.high - s.low)) < NEAR
                and one.polygon.intersects(s.polygon)
                for s in shafts
            )
            if not (any(s.shares_height(one) for s in shafts) if bored else ends):
                yield name, at


def turning(design, parts):
    """Names of parts, and the places of the shafts or pivots that they turn about."""
    L = design.mechanism.center_distance_mm
    for link in links_at(design.mechanism, TURN):
        if link.teeth.inside or (link.radius_mm and parts.first):
            continue
        for at, kind in zip(places(link), link.kinds, strict=True):
            stands = np.abs(at - at[0]).max() < NEAR
            if kind is Joint.SHAFT or (kind is Joint.PIN and stands):
                yield link.name, complex(at[len(TURN) // 2])
    for name in [one.part.name for one in parts.first]:
        first = design.mechanism.spec.drive.first_wheel(L)
        yield name, complex(L if name == "first wheel" else L + first[1])
    sizes = design.parts.sizes
    if sizes.wheel_bore:
        yield from (("wheel", complex(*place.at)) for place in design.mechanism.wheel_places)
    if sizes.crank_bore:
        yield "locking disc", complex(L)
    if parts.arm:
        yield "arm", complex(L)


def overlaps(design, every):
    """Pairs of solids that share a place, at some input angle."""
    pairs = [
        (a, b)
        for a, b in combinations(every, 2)
        if a.shares_height(b) and not (a.body == b.body == "gear")
    ]
    places_ = [moved(design, one) for one in every]
    by_solid = dict(zip(map(id, every), places_, strict=True))
    for a, b in pairs:
        ways = by_solid[id(a)], by_solid[id(b)]
        still = None in ways or all(way is STILL for way in ways)
        for k in [len(TURN) // 2] if still else range(len(TURN)):
            one, other = (
                w(k) if callable(w) else s.polygon for w, s in zip(ways, (a, b), strict=True)
            )
            if one.intersects(other) and not one.intersection(other).buffer(-0.5 * DEEP).is_empty:
                yield a.name, b.name, float(TURN[k])
                break


STILL = object()


def moved(design, solid):
    """What gives a solid's polygon at each input angle; None for what is compared at 0 alone."""
    if solid.body == "fixed" and "shaft of" not in solid.name:
        return STILL
    middle = len(TURN) // 2
    for link in links_at(design.mechanism, TURN):
        ways = places(link)
        if solid.name == link.name and len(ways) > 1:
            return rigid(solid, ways[0], ways[1] - ways[0])
        if solid.name == f"{link.name}'s block":
            for way in ways[1:]:
                if abs(way[middle] - solid.at) < NEAR:
                    return rigid(solid, way, way - ways[0])
    if solid.body in ("link", "fixed") or solid.radius is not None:
        for link in links_at(design.mechanism, TURN):
            for way in places(link):
                if abs(way[middle] - solid.at) < NEAR:
                    return rigid(solid, way, np.ones(len(TURN)))
    return None


def rigid(solid, way, ahead):
    middle = len(TURN) // 2

    def at(k):
        turn = float(np.angle(ahead[k] / ahead[middle]))
        there = way[middle]
        out = affinity.rotate(solid.polygon, turn, (there.real, there.imag), use_radians=True)
        step = way[k] - there
        return affinity.translate(out, step.real, step.imag)

    return at


def refused_by_a_check(design):
    # not every kind has a proof of its turn, which is sampled then
    checks = [check for check in design.checks if check.name != "gap_proved_mm"]
    return any(check.passes is not True for check in checks)


@pytest.mark.sampled(12)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("kind", registry.DRIVES)
def test_the_machine_assembles(kind, tmp_path):
    """Of the example and of sizes drawn by lot, of which more than a half leaves parts.

    Parts that share a place, or a hole through an outline, fail a check.
    """
    whole = 0
    for given, design in samples(tmp_path, kind):
        try:
            parts = design.parts
            _ = parts.members
        except GenevaError:
            continue
        whole += 1
        every, L = list(solids(parts)), design.mechanism.center_distance_mm
        fit = design.spec.size.allowances.shaft_fit_mm
        assert not list(misfits(every, L, fit)), given
        assert not list(loose(every, turning(design, parts))), given
        met = [one.name for one in every if one.torn]
        met += overlaps(design, every)
        assert not met or refused_by_a_check(design), (met, given)
    assert whole > SAMPLES / 2


@pytest.mark.sampled(36)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("process", PROCESSES)
@pytest.mark.parametrize("kind", registry.DRIVES)
def test_a_process_leaves_space_for_all_but_press_fits(kind, process, tmp_path):
    """Only pins are wider than their holes, in the arm or a link; shafts go into their bores."""
    spec = tmp_path / f"{kind}.toml"
    spec.write_text(template(kind) if kind != "crank" else "[wheel]\nz = 6\n")
    design = load(str(spec), [f"size.process={process}"])
    require_space(design)


def require_space(design):
    """Nothing overlaps but pins in their press fits, by half the fit; wheel and arm are apart."""
    allowed = design.spec.size.allowances
    parts = design.parts
    every = list(solids(parts))
    assert not list(misfits(every, design.mechanism.center_distance_mm, allowed.shaft_fit_mm))
    met = {tuple(sorted(pair[:2])) for pair in overlaps(design, every)}
    pressed = {pair for pair in met if any("pin" in name.split() for name in pair)}
    assert met == pressed or refused_by_a_check(design), met
    assert not pressed or allowed.press_fit_mm > DEEP
    for pin in (one for one in every if one.name == "pin"):
        holes = [
            radius
            for one in every
            if one.name == "arm" and one.shares_height(pin)
            for at, radius in one.bores
            if abs(at - pin.at) < NEAR
        ]
        assert holes in ([], [pytest.approx(pin.radius - 0.5 * allowed.press_fit_mm)])
    if parts.drawn and parts.arm_plate:
        assert -parts.arm_plate.high == pytest.approx(allowed.pin_gap_mm, abs=1e-12)
