"""Gear teeth: published numbers, a rack that cuts them in steps, and the mesh of two outlines."""

import math
from functools import cache

import mpmath
import numpy as np
import pytest
import shapely
from sampling import some
from shapely.affinity import rotate, translate

from geneva_cli import Design, EllipticalGears, Epicyclic, External, NoncircularGears
from geneva_cli.errors import GenevaError
from geneva_cli.geometry import fit
from geneva_cli.geometry.gear_teeth import Rack, RoundTeeth
from geneva_cli.geometry.measure import at, turned
from geneva_cli.geometry.shapes import Contour
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.parts.assembly import assembly
from geneva_cli.parts.gears.gear_mesh import gear_mesh
from geneva_cli.spec.tables import Size

WRITE = {
    "arcs": lambda c, a, b: fit.arcs(c, a, b, 1e-5),
    "cubics": lambda c, a, b: fit.cubics(c, a, b, 1e-6),
}


def polygon(segments, steps=4):
    points = [at(one, k / steps) for one in segments for k in range(steps)]
    return shapely.Polygon(points)


def link(name, radius):
    return Link(name, ((np.zeros(1), np.zeros(1)),), (Joint.SHAFT,), 2, radius)


def whole(teeth, count, write=WRITE["arcs"]):
    """The outline of a round gear with a tooth on the x axis."""
    one = Contour("", (*teeth.one(write), teeth.between()), closed=False)
    return [piece for k in range(count) for piece in turned(one, k * teeth.step).segments]


def test_a_published_pair_with_profile_shift():
    """12 and 24 teeth, m = 3, x = 0.6 and 0.36 on axes 56.5 mm apart.

    Source: D. Bolsover, Profile shifted external spur gears (bolsover.com), printed to the digits
    below. Its shifts have two digits, so that their sum and the tips agree to 0.001 modules.
    """
    links = link("pinion", 56.5 / 3.0), link("gear", 113.0 / 3.0)
    size = Size(gear_module_mm=3.0, gear_teeth=12, gear_shift=0.6)
    mesh = gear_mesh(*links, ((0.0, 0.0), (56.5, 0.0)), size)
    pinion, gear = mesh.gears["pinion"], mesh.gears["gear"]
    assert (pinion.z, gear.z) == (12, 24)
    assert math.degrees(mesh.pressure_angle) == pytest.approx(26.0888, abs=5e-5)
    assert mesh.contact_ratio == pytest.approx(1.202, abs=1e-3)
    assert gear.shift == pytest.approx(0.36, abs=1e-3)
    for one, base, tip, root in (
        (pinion, 33.8289, 44.840, 32.100),
        (gear, 67.6579, 79.400, 66.660),
    ):
        assert 2.0 * one.teeth.base == pytest.approx(base, abs=5e-5)
        assert 2.0 * one.teeth.tip == pytest.approx(tip, abs=3e-3)
        assert 2.0 * one.teeth.root == pytest.approx(root, abs=3e-3)


def test_a_published_span():
    """W over 4 teeth of 24, m = 3, x = 0.4 is 32.8266 (KHK, Gear technical reference, span of spur
    gears); and on the outline, between parallel jaws."""
    teeth = RoundTeeth(Rack(3.0, 0.4), 36.0, 40.2)
    links = link("one", 36.0), link("two", 36.0)
    # on their own axes: the shift of the other is what the distance leaves
    mesh = gear_mesh(*links, ((0.0, 0.0), (72.0, 0.0)), Size(gear_module_mm=3.0, gear_shift=0.4))
    count, span = mesh.gears["one"].span
    assert (count, span) == (4, pytest.approx(32.8266, abs=5e-5))
    for name, fine in (("arcs", 1e-5), ("cubics", 1e-6)):
        points = np.array(polygon(whole(teeth, 24, WRITE[name]), 64).exterior.coords)
        z = points @ (1.0, 1.0j) * np.exp(-1.5j * teeth.step)  # four teeth about the x axis
        ends = np.abs(np.abs(np.angle(z)) - 1.5 * teeth.step) < 0.4 * teeth.step
        reach = z[ends & (z.imag > 0.0)].imag.max() - z[ends & (z.imag < 0.0)].imag.min()
        # samples of a flank some 0.03 mm apart miss the jaw's touch by 1e-5, on either side
        assert reach == pytest.approx(span, abs=2.0 * fine + 4e-5)


def test_tooth_thickness_and_flank_are_an_involutes():
    """s = m (pi/2 + 2 x tan a) on the pitch circle; a flank is unwound from the base circle."""
    teeth, m, x = RoundTeeth(Rack(2.0, 0.25), 20.0, 22.5), 2, mpmath.mpf(1) / 4
    alpha = mpmath.pi / 9
    thick = m * (mpmath.pi / 2 + 2 * x * mpmath.tan(alpha))
    assert teeth.thickness(20.0) == pytest.approx(float(thick), rel=1e-15)
    base, roll0 = 20 * mpmath.cos(alpha), mpmath.tan(alpha)
    start = thick / 40 + (roll0 - alpha)  # of the flank on the base circle
    for segment in teeth.one(WRITE["arcs"]):
        for t in (0.0, 0.3, 0.7):
            p = mpmath.mpc(*at(segment, t))
            r = abs(p)
            if not 19.0 < r < 22.499:
                continue
            roll = mpmath.sqrt((r / base) ** 2 - 1)
            angle = start - (roll - mpmath.atan(roll))
            assert float(abs(abs(mpmath.arg(p)) - angle) * r) < 1.1e-5  # the arcs' tolerance


def cut_in_steps(rack, radius, tip, count, steps=1500):
    """What a rack leaves of a disc when it rolls on its circle, in steps.

    One space, about the direction half a pitch from the x axis.
    """
    m, a = rack.module, rack.angle
    up = rack.shift * m
    depth, r = 1.25 * m, 0.38 * m
    corner = shapely.Point(0.0, 0.0).buffer(r, quad_segs=400)
    half = math.pi * m / 4.0  # of the rack's tooth on its datum line
    centre = half - (depth - r) * math.tan(a) - r / math.cos(a)
    # a tooth of the rack that points down, to the gear: hull of both corners and of its upper end
    wide = half + 3.0 * m * math.tan(a)
    top = [(-wide, 3.0 * m), (wide, 3.0 * m)]
    tool = shapely.unary_union(
        [translate(corner, s * centre, r - depth) for s in (-1.0, 1.0)]
        + [shapely.Point(p).buffer(1e-9) for p in top]
    ).convex_hull
    tool = translate(tool, 0.0, up)
    blank = shapely.Point(0.0, 0.0).buffer(tip, quad_segs=20000)
    sector = shapely.Polygon(
        [(0.0, 0.0)]
        + [(2.0 * radius * math.cos(t), 2.0 * radius * math.sin(t))
           for t in (-0.2 * math.pi / count, 2.2 * math.pi / count)]
    )  # fmt: skip
    left = blank.intersection(sector)
    roll = 5.0 * m
    swept = []
    for s in np.linspace(-roll, roll, steps):
        # the rack's tooth is at s along the pitch line; the gear has turned with it
        turn = math.pi / count + (-s) / radius
        one = translate(tool, s, 0.0)
        # the pitch line is tangent at (radius, 0), and its length runs along y
        one = shapely.transform(one, lambda p: np.column_stack((radius + p[:, 1], p[:, 0])))
        swept.append(rotate(one, turn, (0.0, 0.0), use_radians=True))
    return left.difference(shapely.unary_union(swept))


@pytest.mark.long
@pytest.mark.parametrize(("count", "shift"), [(20, 0.0), (12, 0.45), (60, -0.3)])
def test_a_rack_that_rolls_leaves_these_teeth(count, shift):
    """Flank, fillet and root against the union of 1500 positions of the tool.

    Its facets stand above the envelope by v² R/8 per step, some 1e-4 mm here.
    """
    m = 2.0
    teeth = RoundTeeth(Rack(m, shift), 0.5 * m * count, m * (0.5 * count + 1.0 + shift))
    left = cut_in_steps(teeth.rack, teeth.radius, teeth.tip, count)
    ours = polygon(whole(teeth, count), 16)
    window = shapely.Polygon(
        [(0.0, 0.0)]
        + [(2.0 * teeth.tip * math.cos(t), 2.0 * teeth.tip * math.sin(t))
           for t in (0.0, math.tau / count)]
    )  # fmt: skip
    one, other = left.intersection(window), ours.intersection(window)
    assert one.symmetric_difference(other).area < 2e-4 * m * m
    assert shapely.hausdorff_distance(one.boundary, other.boundary) < 1e-3 * m


RING = Epicyclic(planet_ratio=0.02, fixed="ring")
SOFT = Epicyclic(planet_ratio="shockless")


@cache
def gears(drive, z, **keys):
    """Round gears of a machine as polygons about their axes, with what was drawn."""
    design = Design(External(z), drive, size=Size(center_distance_mm=120.0, **keys))
    flat = design.parts.flat.within(1e-5, "arcs")
    drawn = []
    for gear in flat.toothed:
        ring = gear.teeth.inside
        outline = polygon((gear.plate.holes[0] if ring else gear.plate.outline).segments)
        if ring:
            outline = shapely.Point(0.0, 0.0).buffer(gear.outer).difference(outline)
        drawn.append((outline, gear))
    return design, drawn


def free_turn(still, moved, most):
    """How far a polygon turns about the origin until it overlaps another one by 1e-5 mm²."""
    low, high = 0.0, most
    for _ in range(24):
        turn = 0.5 * (low + high)
        hits = still.intersection(rotate(moved, turn, (0.0, 0.0), use_radians=True)).area > 1e-5
        low, high = (low, turn) if hits else (turn, high)
    return low


@pytest.mark.long
@pytest.mark.parametrize(
    ("drive", "z", "keys"),
    [
        (SOFT, 4, {"gear_module_mm": 2.0}),  # the axes are nearer than without shift
        (SOFT, 4, {"gear_module_mm": 2.5, "gear_shift": 0.4}),
        (RING, 6, {"gear_module_mm": 1.5}),
    ],
)
def test_planet_and_fixed_gear_mesh_with_their_backlash(drive, z, keys):
    """The planet rolls as the machine does: no overlap, and free by the backlash, at five angles.

    The area at which they are taken to touch is a depth of some 1e-3 mm on a line of contact.
    """
    backlash = 0.08
    design, ((planet, at_planet), (fixed, at_fixed)) = gears(
        drive, z, gear_backlash_mm=backlash, **keys
    )
    reactions = design.mechanism.engagements[0].reactions
    (x, _), (far, _) = at_planet.at, at_fixed.at
    for part in (0.0, 0.13, 0.37, 0.5, 0.81):
        # the carrier turns by a part of the fixed gear's pitch; the frame turns with the carrier
        turn = part * math.tau / at_fixed.cut.z
        still = translate(rotate(fixed, turn, (0.0, 0.0), use_radians=True), far - x, 0.0)
        near = shapely.box(-2.0 * abs(far - x), -25.0, 2.0 * abs(far - x), 25.0)
        still = still.intersection(near)
        own = rotate(planet, (1.0 - reactions.c) * turn, (0.0, 0.0), use_radians=True)
        assert still.intersection(own).area < 1e-6
        flipped = [shapely.transform(p, lambda q: q * (1.0, -1.0)) for p in (still, own)]
        play = free_turn(still, own, 0.1) + free_turn(*flipped, 0.1)
        assert play * at_planet.radius == pytest.approx(backlash, abs=4e-3)


@cache
def pair(drive, **keys):
    design = Design(External(6), drive, size=Size(gear_module_mm=2.0, **keys))
    flat = design.parts.flat.within(1e-4, "arcs")
    return design, [(polygon(m.part.outline.segments, 3), m.at) for m in flat.gear_pair]


@pytest.mark.long
@pytest.mark.parametrize("kind", ["elliptical", "side-crank"])
def test_noncircular_gears_mesh(kind):
    """Turned by the ratio in closed form: no overlap, and contact with half the backlash a side."""
    if kind == "elliptical":
        length = 2.0 * float(mpmath.ellipe(0.09))  # of a pitch ellipse, over C
        drive = EllipticalGears(eccentricity=0.3, gear_distance_mm=49.0 * 2.0 * math.pi / length)
    else:
        with pytest.raises(
            GenevaError, match="teeth; for 40 teeth set gear_distance_mm = "
        ) as said:
            _ = pair(NoncircularGears(A=0.4, gear_distance_mm=80.0))
        fits = float(str(said.value).split("gear_distance_mm = ")[1].split(",")[0])
        drive = NoncircularGears(A=0.4, gear_distance_mm=fits)
    design, ((driven, at_driven), (driver, at_driver)) = pair(drive, gear_backlash_mm=0.06)
    where = assembly(design.mechanism)
    sense = math.copysign(1.0, float(np.diff(where.crank(np.array([0.0, 1.0])))[0]))
    C = drive.gear_distance_mm
    assert at_driver[0] - at_driven[0] == pytest.approx(C)
    for degrees in some((0.0, 3.1, 64.0, 181.7, 300.0), (3.1, 181.7)):
        phi = math.radians(degrees)
        turn = drive.gears.advance(np.array([phi]), 1)
        crank = math.atan2(float(turn[0].c[0][0]), 1.0 - float(turn[1].c[0][0]))
        one = rotate(driven, sense * crank, (0.0, 0.0), use_radians=True)
        other = translate(rotate(driver, -sense * phi, (0.0, 0.0), use_radians=True), C)
        near = shapely.box(0.0, -20.0, C, 20.0)
        one, other = one.intersection(near), other.intersection(near)
        assert one.intersection(other).area == 0.0
        # normal to the flanks half the backlash is 0.03 cos 20 deg
        gap = one.distance(other)
        assert gap == pytest.approx(0.03 * math.cos(math.radians(20.0)), abs=1e-3)
