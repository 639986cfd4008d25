"""Where a turning wheel is stopped: the triangles of its contacts against the gaps themselves."""

import math

import numpy as np
import pytest
import repo
from other_shape import with_shape
from test_outline import made
from words import load

from geneva_cli.geometry.measure import at
from geneva_cli.geometry.shapes import Arc, Line
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.play import search_deg, smallest_clearance, wheel_stops, windows

BARE = ("turret", "internal-z6", "four-bar-z4", "press-curved", "three-rollers-z4", "spherical-z6")
LOOSE = (
    "internal-curved-z8",
    "offset-slots",
    "unequal-steps",
    "cam-geneva",
    "press-345",
    "spherical-60deg",
)
LOOKS = 50  # turns of the wheel, short of a stop
PAST = 1e-5  # radians: what grazes at 100 mm overlaps by some 1e-7 mm more, as much as counts
ROUNDING = 1e-10  # mm: of gaps of some hundred mm


def named(name):
    machine = load(str(repo.DESIGNS / f"{name}.toml"))
    if name in LOOSE:
        spec = machine.spec.with_("size.slot_clearance_mm", 0.05)
        machine = build(spec.with_("size.lock_clearance_mm", 0.04))
    return parts_of(machine)


def places(parts):
    """Input angles in all motions and dwells, most of them beside their ends."""
    share = np.array([0.0, 1e-3, 0.02, 0.1, 0.37])
    ends = [(w.start, w.end) for w in windows(parts)]
    return np.concatenate([[a + (b - a) * share, b - (b - a) * share] for a, b in ends]).ravel()


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", [*BARE, *LOOSE])
def test_a_stop_is_the_first_place_where_parts_overlap(name):
    """By gaps that are distances of points, not contacts: none before the stop, one behind it."""
    parts = named(name)
    at = places(parts)
    pose, most = parts.gaps.pose(at), math.radians(search_deg(parts))
    apart = (
        smallest_clearance(parts.gaps, pose, np.zeros(len(at)), parts.gaps.near) + parts.close
        >= 0.0
    )
    assert apart.mean() > 0.9
    for way, free in zip((-1.0, 1.0), wheel_stops(parts, at)[0], strict=True):
        assert ((free >= 0.0) & (free <= most)).all()
        assert (free[~apart] == 0.0).all()
        share = np.linspace(0.0, 1.0, LOOKS)[:, None]
        turned = np.where(apart, share * free, 0.0)
        many = parts.gaps.pose(np.tile(at, LOOKS))
        gap = smallest_clearance(parts.gaps, many, way * turned.ravel(), parts.gaps.near).reshape(
            turned.shape
        )
        assert (gap[:, apart] >= -parts.close - ROUNDING).all()
        stopped = apart & (free < most)
        assert stopped.any()
        behind = smallest_clearance(parts.gaps, pose, way * (free + PAST), parts.gaps.near)
        assert (behind[stopped] < -parts.close).all()


def bent(contour, sagitta):
    """A contour with the walls of its slots in four, each bowed by a sagitta, in and out."""
    pieces = []
    for piece in contour.segments:
        wall = isinstance(piece, Line) and math.dist(*piece) > 1.0
        parts = np.linspace(0.0, 1.0, 5) if wall else (0.0, 1.0)
        for i, (p, q) in enumerate(zip(parts[:-1], parts[1:], strict=True)):
            ends = at(piece, p), at(piece, q)
            bulge = 2.0 * (-1.0) ** i * sagitta / math.dist(*ends)
            pieces.append(Arc(*ends, bulge) if wall else piece)
    return contour._replace(segments=tuple(pieces))


@pytest.mark.parametrize("sagitta", [1e-3, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12])
def test_nearly_straight_walls_stop_like_straight_ones(sagitta):
    """Fitted arcs may have a radius of kilometres: stops were missed."""
    parts = made(6, roller_radius_mm=5.0, slot_clearance_mm=0.1, lock_clearance_mm=0.05)
    gaps = Gaps(
        parts.assembly, parts.sizes, bent(parts.outlines.wheel, sagitta), parts.outlines.crank
    )
    at_deg = parts.assembly.start_deg + np.linspace(0.0, 359.0, 360)
    pose, lead = parts.gaps.pose(at_deg), np.linspace(-0.1, 0.1, 360)
    for own, other in ((parts.gaps.rollers, gaps.rollers), (parts.gaps.locking, gaps.locking)):
        # the walls' own difference, and rounding of 100 mm
        assert np.abs(own(pose, lead) - other(pose, lead)).max() < sagitta + 1e-13
    straight, _ = wheel_stops(parts, at_deg)
    curved, _ = wheel_stops(with_shape(parts, gaps=gaps), at_deg)
    # where the roller is 50 mm or more from the wheel's axis; contacts of corners graze
    assert np.abs(np.subtract(straight, curved)).max() < sagitta / 50.0 + 1e-7
