"""Gears as blanks: their masses by closed forms, the screws of those that stand, their refusals."""

import math
from functools import cache

import numpy as np
import pytest
import repo

from geneva_cli import Design, Epicyclic, External, load
from geneva_cli.geometry.shapes import Arc, Circle
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.spec.tables import Size

RHO = 7850.0  # kg/m³, steel
# Pitch curves are fitted to 2e-9 of the axes' distance; what they hold, to a few times that.
FITTED = 1e-8
SOFT = Epicyclic(planet_ratio="shockless")
RING = Epicyclic(planet_ratio=0.02, fixed="ring")


@cache
def design(name):
    return load(str(repo.DESIGNS / f"{name}.toml"))


def listed(of):
    """The parts of a design by their names: count, mass, inertia and z."""
    return {row["name"]: row for row in of.part_table("parts").to_rows() if row["row"] == "part"}


def disc(r, thick):
    """Mass and moment of inertia of a disc, radius and thickness in mm."""
    mass = RHO * math.pi * r * r * thick * 1e-9
    return np.array([mass, 0.5 * mass * r * r * 1e-6])


def found(of, name):
    row = listed(of)[name]
    return np.array([row["mass_kg"], row["inertia_kgm2"]])


@pytest.mark.long
def test_elliptical_gears_are_ellipses_that_turn_about_a_focus():
    """a = 50 and e = 0.3: m = rho pi a b h, J = m ((a² + b²)/4 + c²), less the bores."""
    a, c, thick = 50.0, 15.0, 16.0
    b = math.sqrt(a * a - c * c)
    mass = RHO * math.pi * a * b * thick * 1e-9
    whole = np.array([mass, mass * ((a * a + b * b) / 4.0 + c * c) * 1e-6])
    of = design("elliptical-gears")
    for name, bore in (("driven gear", 12.0), ("driver gear", 15.0)):
        assert found(of, name) == pytest.approx(whole - disc(bore / 2.0, thick), rel=FITTED)


def test_planet_and_sun_are_discs_with_their_holes():
    """Radii from theory: the carrier R0 = L sin b (1 + 1/24), the planet R0/5, the sun 4 R0/5."""
    of = design("epicyclic-z4")
    R0 = 120.0 * math.sqrt(0.5) * 25.0 / 24.0
    assert found(of, "planet") == pytest.approx(disc(R0 / 5.0, 12.0) - disc(6.0, 12.0), rel=1e-12)
    sun, bore, bolt = 4.0 * R0 / 5.0, 12.5, 1.45  # M2.5
    far = (sun + bore) / 2.0
    holes = 4.0 * disc(bolt, 12.0)
    holes[1] += holes[0] * far * far * 1e-6  # Steiner
    whole = disc(sun, 12.0) - disc(bore, 12.0) - holes
    assert found(of, "fixed gear") == pytest.approx(whole, rel=1e-12)


def test_gear_sectors_are_hub_and_sectors():
    """L = 120, u = 1: three sectors of 60 degrees on the wheel, one on the crank."""
    of, r = design("gear-sector"), 60.0
    # as wide as the shafts of wheel and arm; hubs are some 1.6 times that
    for name, count, hub, bore in (("wheel gear", 3, 15.0, 10.0), ("crank gear", 1, 9.0, 6.0)):
        share = count * 60.0 / 360.0
        whole = share * disc(r, 12.0) + (1.0 - share) * disc(hub, 12.0) - disc(bore, 12.0)
        assert found(of, name) == pytest.approx(whole, rel=1e-12)


def test_sectors_are_where_gears_mesh():
    """On the line of centres at mid-motion, each half its angle to both sides."""
    bars = drawn_links(design("gear-sector").mechanism, design("gear-sector").parts.outlines)
    for gear, towards in zip(bars.gears, (math.pi, 0.0), strict=True):
        toothed = [
            piece
            for piece in gear.part.outline.segments
            if isinstance(piece, Arc) and piece.radius == pytest.approx(60.0)
        ]
        ends = {round(math.degrees(math.atan2(p.start[1], p.start[0]) - towards)) % 360
                for p in toothed}  # fmt: skip
        assert 330 in ends  # half of 60 degrees before


def test_a_ring_is_round_its_pitch_circle():
    of = Design(External(6), RING)
    ring = drawn_links(of.mechanism, of.parts.outlines).gears[1].part
    (pitch, *bolts) = ring.holes
    # c = 1 - 2z/(z - 2) = -2: the planet has R0/2 and the ring three times that, R0 = 0.52 L
    assert (ring.bore, pitch.radius) == (None, pytest.approx(78.0, rel=1e-14))
    assert len(bolts) == 4
    assert all(pitch.radius < math.hypot(*b.centre) - b.radius for b in bolts)
    assert all(math.hypot(*b.centre) + b.radius < ring.outline.radius for b in bolts)
    whole = disc(ring.outline.radius, 10.0) - disc(pitch.radius, 10.0)
    far = math.hypot(*bolts[0].centre)
    holes = 4.0 * disc(bolts[0].radius, 10.0)
    holes[1] += holes[0] * far * far * 1e-6
    assert found(of, "fixed gear") == pytest.approx(whole - holes, rel=1e-12)


@pytest.mark.parametrize(
    "keys", [{}, {"gear_bolts": 5, "gear_bolt_mm": 4.0, "gear_bolt_circle_mm": 90.0}]
)
def test_the_screws_of_a_fixed_gear_are_in_the_frame(keys):
    of = Design(External(4), SOFT, size=Size(**keys))
    drawn = of.drawing("gears")
    count = 5 if keys else 4
    holes = {(round(s.centre[0] + 100.0, 9), round(s.centre[1], 9), s.radius)
             for s in drawn.shapes if isinstance(s, Circle) and s.layer == "BORE"}  # fmt: skip
    # M3 passes 4 mm, M2 the default below L/40 = 2.5 mm: clearance hole and core of the thread
    through, core = (2.0, 1.25) if keys else (1.2, 0.8)
    framed = {(round(s.centre[0], 9), round(s.centre[1], 9), through)
              for s in of.drawing("frame").shapes
              if isinstance(s, Circle) and s.radius == core}  # fmt: skip
    screws = {hole for hole in holes & framed if math.dist(hole[:2], (100.0, 0.0)) > 1.0}
    assert len(screws) == count
    if keys:
        assert {round(math.dist(s[:2], (100.0, 0.0)), 6) for s in screws} == {45.0}
        assert {s[2] for s in screws} == {2.0}


@pytest.mark.sampled(2)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize(
    ("keys", "gap"),
    [
        # the driven gear, to 65/100 of the gears' distance from the crank's axis, and the wheel's
        # shaft of 25 mm, 160 mm off; or the driver, likewise, and the crank's shaft of 17 mm
        ({"drive.gear_distance_mm": 240.0}, 160.0 - 0.65 * 240.0 - 12.5),
        ({"drive.eccentricity": 0.95}, 50.0 * 0.05 - 8.5),
    ],
)
def test_gears_that_meet_a_shaft_fail_their_check(keys, gap):
    of = design("elliptical-gears")
    for key, value in keys.items():
        of = of.with_(key, value)
    (check,) = (c for c in of.checks if c.name == "gear_gap_mm")
    assert check.value == pytest.approx(gap, rel=1e-6)  # of 721 places on a pitch curve
    assert not check.passes
