"""Every machine assembles: bores fit their shafts, what turns with one touches it, none overlap.

Solids are compared as shapely's polygons, which know nothing of the sizes that made them.
"""

import cmath
import math
import random
import re
from itertools import combinations

import numpy as np
import pytest
from drawing_witness import polygon
from sampling import some
from shapely import affinity

from geneva_cli import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Stack
from geneva_cli.geometry.shapes import Circle
from geneva_cli.motion import registry
from geneva_cli.motion.pivots import Joint
from geneva_cli.parts.links.link_positions import links_at
from geneva_cli.parts.links.link_sizes import places
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
    elif isinstance(part, Stack):
        for plate in part.plates:
            yield Solid(plate._replace(name=part.name), at, turn, body)
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
        for one in (one for one in every if one.shares_height(shaft)):
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
        yield name, complex(L if name == "first wheel" else L + first.distance_mm)
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


@pytest.mark.sampled(3)
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


@pytest.mark.sampled(6)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("process", PROCESSES)
@pytest.mark.parametrize("kind", registry.DRIVES)
def test_a_process_leaves_space_for_all_but_press_fits(kind, process, tmp_path):
    """Only pins are wider than their holes, in the arm or a link; shafts go into their bores."""
    spec = tmp_path / f"{kind}.toml"
    spec.write_text(template(kind) if kind != "crank" else "[wheel]\nz = 6\n")
    design = load(str(spec), [f"size.process={process}"])
    require_space(design)


@pytest.mark.sampled(3)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("kind", registry.DRIVES)
def test_turned_shafts_leave_space(kind, tmp_path):
    """Of every kind; shoulders and circlips meet no part that passes them in a turn."""
    spec = tmp_path / f"{kind}.toml"
    spec.write_text(template(kind) if kind != "crank" else "[wheel]\nz = 6\n")
    keys = ["size.shafts=turned"]
    keys += ["size.link_bore_mm=5"] if kind == "geneva-pair" else []
    design = load(str(spec), keys)
    assert "turned" not in " ".join(check.why for check in design.checks)
    require_space(design)


@pytest.mark.sampled(3)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("process", [None, *PROCESSES])
@pytest.mark.parametrize("shafts", ["plain", "turned"])
@pytest.mark.parametrize(
    "shape", ['="round"', '="D"', '="hex"', '_mm=16 {part}_keyway="DIN 6885-1"']
)
def test_mountings_leave_space(shape, shafts, process, tmp_path):
    """Each shape of the bores, with plain and turned shafts."""
    keys = [f"size.shafts={shafts}", *([f"size.process={process}"] if process else [])]
    for part in ("wheel", "crank"):
        text = f"{part}_bore{shape}".format(part=part)
        keys += [f"size.{one}" for one in re.split(r" (?=wheel|crank)", text)]
    design = of(tmp_path, "wheel = {z = 4}\nsize = {center_distance_mm = 150}", *keys)
    require_space(design)


def require_space(design):
    """Nothing overlaps but pins in their press fits, by half the fit; wheel and arm are apart."""
    allowed = design.spec.size.allowances
    parts = design.parts
    every = list(solids(parts))
    if design.spec.size.shafts == "plain":  # turned ones have bearings and grooves
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


def spans(design, *names):
    """Radius, if it is round, and lower and upper end of the parts of some names."""
    every = solids(design.parts)
    return [(one.radius, one.low, one.high) for one in every if one.name in names]


def bores(design, name):
    (one,) = (one for one in solids(design.parts) if one.name == name)
    return [2.0 * radius for _, radius in one.bores]


def of(tmp_path, text, *given):
    spec = tmp_path / "spec.toml"
    spec.write_text(text)
    return load(str(spec), given)


RING = """
wheel = {z = 4}
drive = {kind = "epicyclic", planet_ratio = "shockless", fixed = "ring"}
size = {roller_radius_mm = 3.04, wheel_hub_mm = 0}
"""


def test_a_planets_arm_and_carrier_have_one_shaft(tmp_path):
    """As thick as the arm's room allows: 35/100 of what is beside the roller's pin."""
    design = of(tmp_path, RING)
    # rp = L sin b / (c² - 1) for z = 4 in a ring, c = 1 - 4; the pin's hole has r/2
    room = 100.0 * math.sqrt(0.5) / 8.0 - 1.52
    (shaft,) = spans(design, "shaft of carrier, planet's arm, planet")
    assert 2.0 * shaft[0] == pytest.approx(5.0)
    assert 5.0 < 2.0 * 0.35 * room < 6.0  # the next bore of bearings
    for name in ("carrier", "planet's arm", "planet"):
        assert any(bore == 2.0 * shaft[0] for bore in bores(design, name))
    assert not refused_by_a_check(design)


SIDE = """
wheel = {{z = {z}}}
drive = {{kind = "side-crank", A = {A}}}
"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("z", "A"), [(8, 0.9), (9, 0.6), (10, 0.6), (11, 0.6), (12, 0.6), (16, 0.6), (24, 0.6)]
)
def test_a_coulisse_without_room_is_one_piece_with_its_shaft(tmp_path, z, A):
    """The shaft ends on it, where nothing slides, and neither counts what the other fills."""
    design = of(tmp_path, SIDE.format(z=z, A=A))
    ((radius, low, high),) = spans(design, "crank's shaft")
    ((_, bottom, top),) = spans(design, "coulisse")
    near = 100.0 * math.sin(math.pi / z) * (1.0 - A)  # of the pin in the slot, from the axis
    pin = min(2.5, 0.2 * near)
    slot = near - pin * (1.6 + 0.8 + 0.25)  # a block's half width and length, and what is spare
    fits = radius + 0.5 <= slot  # wall_min_mm is L/200
    assert fits == (z in (9, 10))
    assert (low, bores(design, "coulisse")) == ((bottom, [2.0 * radius]) if fits else (top, []))
    assert bottom < top < high
    for other in ("coulisse's block", "pin of coulisse and input crank"):
        ((_, _, end),) = spans(design, other)
        assert end <= low or near - pin * 2.4 > radius


@pytest.mark.usefixtures("no_advice")
def test_links_on_the_cranks_shaft_have_its_bore(tmp_path):
    """``link_bore_mm`` bores for shafts that carry links alone, and is refused without one."""
    design = of(tmp_path, SIDE.format(z=6, A=0.6), "size.link_bore_mm=4")
    ((radius, *_),) = spans(design, "crank's shaft")
    assert 2.0 * radius == 9.0  # the bore of bearings below 9.6 mm
    assert bores(design, "coulisse") == bores(design, "arm")[:1] == [2.0 * radius]
    assert 4.0 in bores(design, "input crank")
    cam = of(tmp_path, template("cam"), "size.link_bore_mm=4")
    with pytest.raises(GenevaError, match="link_bore_mm = 4: it applies to no link"):
        cam.drawing("links")
    (row,) = [check for check in cam.checks if check.name == "link_wall_mm"]
    assert row.passes is False


def test_arm_and_disc_have_one_shaft(tmp_path):
    """The disc is bored as wide as the arm, or not at all; two sizes are refused."""
    text = "wheel = {z = 6}"
    for bore, disc in ((8.0, [8.0]), (16.0, [])):
        design = of(tmp_path, text, f"size.arm_bore_mm={bore}", "size.lock_bolts=0")
        assert bores(design, "locking disc") == disc
        assert bores(design, "arm")[0] == 2.0 * spans(design, "crank's shaft")[0][0] == bore
    both = of(tmp_path, text, "size.arm_bore_mm=8", "size.crank_bore_mm=6")
    with pytest.raises(GenevaError, match="crank_bore_mm = 6 must be equal, or 0"):
        both.drawing("wheel")
    apart = of(tmp_path, text, "size.arm_bore_mm=8", "size.crank_bore_mm=0")
    assert 8.0 not in bores(apart, "locking disc")


def test_a_given_crank_shaft_goes_through_all_that_is_on_it(tmp_path):
    """Frame, arm and disc are bored for it; the disc is not where its relief has no room."""
    for wide, disc in ((8.0, [8.0]), (30.0, [])):
        own = f"shaft.crank_diameter_mm={wide}", "size.lock_bolts=0"
        design = of(tmp_path, "wheel = {z = 6}", *own)
        ((radius, low, _),) = spans(design, "crank's shaft")
        assert bores(design, "arm")[0] == bores(design, "frame")[1] == 2.0 * radius == wide
        assert bores(design, "locking disc") == disc
        assert low == spans(design, "frame")[0][1]
    own = of(tmp_path, "wheel = {z = 6}", "shaft.crank_diameter_mm=8", "size.crank_bore_mm=6")
    assert bores(own, "frame")[1] == bores(own, "arm")[0] == 2.0 * spans(own, "crank's shaft")[0][0]
    thick = of(tmp_path, "wheel = {z = 6}", "shaft.wheel_diameter_mm=30")
    assert bores(thick, "frame")[0] == bores(thick, "wheel")[0] == 30.0


def test_the_crank_of_gears_has_a_shaft_without_an_arm(tmp_path):
    """Where neither arm nor disc has a bore, it carries the driven gear, up to its upper face."""
    text = template("elliptical-gears")
    for given in (("size.pin_mm=0", "size.crank_bore_mm=0"), ("wheel.z=400",)):
        design = of(tmp_path, text, *given)
        rows = {r["name"]: r for r in design.part_table("parts").to_rows() if r["row"] == "part"}
        shaft, gear = rows["crank's shaft"], rows["driven gear"]
        assert (shaft["z_low_mm"], shaft["z_high_mm"]) == (
            rows["frame"]["z_low_mm"],
            gear["z_high_mm"],
        )


def test_a_first_cranks_shaft_reaches_its_locking_disc(tmp_path):
    """From the frame, through the first crank, up to the face of the disc that it carries."""
    design = of(tmp_path, template("geneva-pair"))
    ((radius, low, high),) = spans(design, "first crank's shaft")
    ((_, _, top),) = spans(design, "first locking disc")
    ((_, frame, _),) = spans(design, "frame")
    assert (low, high) == (frame, top)
    assert bores(design, "first locking disc") == [2.0 * radius]


def test_a_short_input_crank_stands_on_its_shaft(tmp_path):
    """A crank of 3 mm leaves no room for a bore: the shaft of L/10 ends below it."""
    design = of(tmp_path, SIDE.format(z=6, A=0.5), "drive.input_crank_mm=3")
    ((radius, _, high),) = spans(design, "input crank's shaft")
    ((_, bottom, _),) = spans(design, "input crank")
    assert (2.0 * radius, high) == (10.0, bottom)
    assert len(bores(design, "input crank")) == 1
