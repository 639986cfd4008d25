"""Where a turning wheel is stopped: the triangles of its contacts against the gaps themselves."""

import math

import numpy as np
import pytest
import repo
from words import load

from geneva_cli.collisions.free_angles import free_angles, search_deg
from geneva_cli.collisions.play import windows
from geneva_cli.drawings.model import PartsModel
from geneva_cli.machine.mechanism import build

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


def parts_of(name):
    machine = load(str(repo.DESIGNS / f"{name}.toml"))
    if name in LOOSE:
        spec = machine.spec.with_("size.slot_clearance_mm", 0.05)
        machine = build(spec.with_("size.lock_clearance_mm", 0.04))
    return PartsModel(machine).parts


def places(parts):
    """Input angles in all motions and dwells, most of them beside their ends."""
    share = np.array([0.0, 1e-3, 0.02, 0.1, 0.37])
    ends = [(w.start, w.end) for w in windows(parts)]
    return np.concatenate([[a + (b - a) * share, b - (b - a) * share] for a, b in ends]).ravel()


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", [*BARE, *LOOSE])
def test_a_stop_is_the_first_place_where_parts_overlap(name):
    """By gaps that are distances of points, not contacts: none before the stop, one behind it."""
    parts = parts_of(name)
    at = places(parts)
    pose, most = parts.gaps.pose(at), math.radians(search_deg(parts))
    apart = parts.gaps.gap(pose, np.zeros(len(at)), parts.gaps.near) + parts.close >= 0.0
    assert apart.mean() > 0.9
    for way, free in zip((-1.0, 1.0), free_angles(parts, at), strict=True):
        assert ((free >= 0.0) & (free <= most)).all()
        assert (free[~apart] == 0.0).all()
        share = np.linspace(0.0, 1.0, LOOKS)[:, None]
        turned = np.where(apart, share * free, 0.0)
        many = parts.gaps.pose(np.tile(at, LOOKS))
        gap = parts.gaps.gap(many, way * turned.ravel(), parts.gaps.near).reshape(turned.shape)
        assert (gap[:, apart] >= -parts.close - ROUNDING).all()
        stopped = apart & (free < most)
        assert stopped.any()
        behind = parts.gaps.gap(pose, way * (free + PAST), parts.gaps.near)
        assert (behind[stopped] < -parts.close).all()
