"""Where a turning wheel is stopped: the triangles of its contacts against the gaps themselves."""

import math

import numpy as np
import pytest
import repo
from other_shape import with_shape
from test_outline import made
from turn_witness import check_first_contacts
from words import load

from geneva_cli.geometry.shapes import Arc, Line, at
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.turned_parts import wheel_stops, windows

BARE = ("turret", "internal-z6", "four-bar-z4", "press-curved", "three-rollers-z4", "spherical-z6")
LOOSE = (
    "internal-curved-z8",
    "offset-slots",
    "unequal-steps",
    "cam-geneva",
    "press-345",
    "spherical-60deg",
)


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
    for apart, stopped in check_first_contacts(parts, places(parts)):
        assert apart.mean() > 0.9
        assert stopped.any()


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
