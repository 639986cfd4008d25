"""Links as plates: their holes are where the machine's joints are, and blocks stay in slots."""

import math

import numpy as np
import pytest
import repo
from shapely import affinity
from shapely.geometry import LineString

from geneva_cli import load
from geneva_cli.geometry.shapes import Circle
from geneva_cli.motion.pivots import Joint
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.parts.links.links import link_sizes

# rounding of a few sines of lengths of some hundred mm
NEAR = 1e-10
NAMES = {
    "side-crank-z6": {"input crank", "coulisse", "coulisse's block"},
    "two-rollers-side-crank": {"input crank", "coulisse", "coulisse's block"},
    "four-bar-z4": {"crank", "coupler", "rocker"},
    "slider-crank": {"crank", "rod", "guide", "guide's block"},
    "epicyclic-z4": {"carrier", "planet's arm"},
    "epicyclic-soft-z6": {"carrier", "planet's arm"},
    "geneva-pair": {"first crank"},
    "cam-geneva": {"crank", "crank's block"},
}


@pytest.fixture(params=NAMES)
def made(request):
    design = load(str(repo.DESIGNS / f"{request.param}.toml"))
    found = design.parts.outlines if design.spec.is_flat else None
    return request.param, design, drawn_links(design.mechanism, found)


def holes(plate):
    return [complex(*hole.centre) for hole in plate.holes if isinstance(hole, Circle)]


def test_holes_are_where_the_joints_are(made):
    """Each link moved so that it lies on its first two joints has its other holes on the rest."""
    _, design, links = made
    L, turn = design.mechanism.center_distance_mm, np.linspace(-180.0, 180.0, 17)
    plates = {plate.name: plate for plate in links.plates}
    for link in links_at(design.mechanism, turn):
        if link.radius_mm:
            continue
        bored = holes(plates[link.name])
        joints = [x + 1j * y + 0.0 * turn for x, y in link.joints]
        unit = (joints[1] - joints[0]) / np.abs(joints[1] - joints[0])
        for joint, kind in zip(joints, link.kinds, strict=True):
            own = (joint - joints[0]) / unit
            if kind in (Joint.PIN, Joint.ROLLER):
                assert min(np.abs(own - z).max() for z in bored) < NEAR * L, link.name


def test_blocks_stay_in_their_slots(made):
    """At every input angle, in shapely's polygons."""
    _, design, links = made
    turn = np.linspace(-180.0, 180.0, 721)
    plates = {plate.name: plate for plate in links.plates}
    for link in links_at(design.mechanism, turn):
        slides = [i for i, kind in enumerate(link.kinds) if kind in (Joint.SLIDE, Joint.CARRIED)]
        own = plates[link.name].holes if slides else ()
        slots = [hole for hole in own if not isinstance(hole, Circle)]
        assert len(slots) == len(slides)
        for i, slot in zip(slides, slots, strict=True):
            joints = [x + 1j * y + 0.0 * turn for x, y in link.joints]
            way = np.abs(joints[i] - joints[0])
            ends = [s.centre for s in slot.segments if hasattr(s, "bulge")]
            half = next(s.radius for s in slot.segments if hasattr(s, "bulge"))
            # round ends of slot and block are polygons of chords, inside by 1e-5 of the radius
            room = LineString(ends).buffer(half * 1.0001, 64)
            (block,) = [p for p in links.plates if p.name == f"{link.name}'s block"]
            reach = [s.centre for s in block.outline.segments if hasattr(s, "bulge")]
            along = complex(*ends[1]) / abs(complex(*ends[1]))
            own = LineString(reach).buffer(half, 64)
            own = affinity.rotate(own, math.degrees(np.angle(along)), (0.0, 0.0))
            for d in (way.min(), way.mean(), way.max()):
                at = d * along
                assert room.contains(affinity.translate(own, at.real, at.imag))
            # and the slot is no longer than it must be, by a hole's width
            assert abs(ends[0][0] - ends[1][0]) < np.ptp(way) + 4.0 * half


def test_the_eye_of_the_roller_passes_the_hub():
    """Its radius is the roller's least distance from the wheel's axis, less the hub's."""
    hub_mm = 48.0
    design = load(str(repo.DESIGNS / "epicyclic-z4.toml"), [f"size.wheel_hub_mm={hub_mm}"])
    links = links_at(design.mechanism, np.linspace(-180.0, 180.0, 7201))
    eye = link_sizes(design.mechanism, links, design.parts.outlines).roller_eye
    slot = design.slot(samples=2001)
    # both are least at mid-motion, a sample of each
    assert eye == pytest.approx(np.hypot(slot["x_mm"], slot["y_mm"]).min() - 0.5 * hub_mm)
