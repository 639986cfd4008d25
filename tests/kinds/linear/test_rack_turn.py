"""The full turn of a rack: its proof, and the play of the rack in its lock and its slot.

The witnesses: points that lie densely on both outlines, placed by sines and cosines; closed forms
of the clearances; and small moves of the rack until parts overlap.
"""

import math
import random

import numpy as np
import pytest
from other_shape import with_shape
from sampling import some
from scipy.spatial import cKDTree
from turn_witness import TO_MM, check_proof, least_gap, smallest_clearance, turn_of

from geneva_cli import Design, Linear, Size
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.kinds.linear.outlines import turned_rack
from geneva_cli.kinds.linear.rack import locking_sector, rack_contour
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.full_turn import full_turn
from geneva_cli.parts.turn.turn_certificate import certificate

R, r = 50.0, 6.0
MACHINES = some(60, 6)


def rack_of(z: int = 6, **sizes: float):
    size = Size(**{"center_distance_mm": R, "roller_radius_mm": r, **sizes})
    return parts_of(Design(Linear(z), size=size).mechanism).built


def random_parts(seed: int):
    """A rack of random sizes, and with an edge beyond or below the crank's axis."""
    rng = random.Random(seed)
    roller = R * rng.uniform(0.05, 0.3)
    sizes = {
        "roller_radius_mm": roller,
        "slot_clearance_mm": rng.choice([0.0, rng.uniform(0.0, 0.1 * roller)]),
        "lock_clearance_mm": rng.choice([0.0, rng.uniform(0.0, 0.5)]),
        "relief_clearance_mm": rng.uniform(0.05, 2.0),
        "wheel_radius_mm": rng.choice([None, R + rng.uniform(-0.2, 0.05) * roller]),
    }
    if rng.random() < 0.2:
        sizes["lock_radius_mm"] = 0.0
    return rack_of(**sizes)


def rack_and_ring(parts):
    """Points on the rack and on the ring, each in its own frame."""
    s = parts.sizes
    rack = Polyarc([rack_contour(s, 5)]).samples(1e-3, 0.05)
    ring = locking_sector(s)
    return rack, None if ring is None else Polyarc([ring]).samples(1e-3, 0.05)


@pytest.mark.sampled(6)
@pytest.mark.parametrize("seed", range(MACHINES))
def test_gaps_are_those_of_points_on_the_outlines(seed):
    """Every gap is at most that of points 0.05 mm apart, and at least that less their spacing.

    The crank turns by a from mid-motion, and the rack moves by R sin a, or rests.
    """
    parts = random_parts(seed)
    rng = random.Random(seed)
    rack, ring = rack_and_ring(parts)
    near = rack[(rack[:, 0] > -2.0 * r) & (abs(rack[:, 1]) < 3.0 * R)]
    for _ in range(6):
        turn = rng.uniform(-90.0, 270.0)
        a = math.radians(turn)
        travel = R * math.sin(min(a, 0.5 * math.pi))
        pose = parts.gaps.pose(np.array([turn]))
        centre = R - R * math.cos(a), R * math.sin(a) - travel
        away = float(np.hypot(*(near - centre).T).min())
        gap = float(parts.gaps.rollers(pose)[0, 0])
        if gap > -0.5 * parts.sizes.roller:  # deep inside the rack the nearest point is not a wall
            expected = min(abs(gap + parts.sizes.roller), parts.gaps.near + parts.sizes.roller)
            assert min(away, parts.gaps.near + parts.sizes.roller) == pytest.approx(
                expected, abs=0.03
            )
        if ring is None:
            continue
        c, s = -math.cos(a), math.sin(a)  # of the crank's x axis, towards the roller
        x, y = R + ring[:, 0] * c - ring[:, 1] * s, ring[:, 0] * s + ring[:, 1] * c - travel
        least = float(cKDTree(near).query(np.column_stack((x, y)))[0].min())
        gap = float(parts.gaps.locking(pose)[0])
        if gap >= 0.0:
            assert min(least, parts.gaps.near) == pytest.approx(gap, abs=0.03)


@pytest.mark.sampled(6)
@pytest.mark.parametrize("seed", range(MACHINES))
def test_random_racks_keep_what_is_proved(seed):
    parts = random_parts(seed)
    smallest = full_turn(parts).smallest.mm
    proof = check_proof(parts, smallest)
    dense = least_gap(parts, turn_of(parts))
    assert dense >= smallest - 1e-7  # the refined gap is no greater than any sample
    if smallest >= 0.0:
        assert proof.open is None
    elif smallest < -TO_MM:
        assert proof.open is not None
        assert proof.open[2] < 0.0


@pytest.mark.parametrize("by", [0.002, 0.01, 0.1])
def test_an_overlap_of_a_known_depth_is_not_proved(by):
    """The ring is larger than its recess by so much, and so is the overlap, in every dwell."""
    parts = rack_of()
    s = parts.sizes
    large = with_shape(parts, turned_rack(parts.assembly, s._replace(lock=s.recess + by)))
    smallest = full_turn(large).smallest.mm
    assert smallest == pytest.approx(-by, rel=1e-9)
    proof = certificate(large, smallest, TO_MM)
    assert proof.open is not None
    assert proof.between == "locking disc and wheel"


@pytest.mark.sampled(6)
@pytest.mark.parametrize("slot", [0.02, 0.1, 0.7])
@pytest.mark.parametrize("lock", [0.01, 0.2])
def test_play_is_the_clearance(slot, lock):
    """The ring's axis is on that of the recess, and the slot's walls are along x."""
    parts = rack_of(slot_clearance_mm=slot, lock_clearance_mm=lock)
    turn = full_turn(parts)
    assert R * math.radians(turn.dwell.deg) == pytest.approx(lock, rel=1e-5)
    assert R * math.radians(turn.motion.deg) == pytest.approx(slot, rel=1e-5)
    assert turn.holds


@pytest.mark.sampled(6)
@pytest.mark.parametrize("seed", range(MACHINES))
def test_a_stop_is_where_parts_begin_to_overlap(seed):
    """Short of a stop no parts overlap, and beyond it some do: 1000 moves up to it, one beyond."""
    parts = random_parts(seed)
    at = np.random.default_rng(seed).uniform(-90.0, 270.0, 12)
    pose = parts.gaps.pose(at)
    free = smallest_clearance(parts, pose) >= -1e-9
    leads, _ = parts.gaps.stops.first(pose, 1.0, parts.close)
    for way, stop in zip((-1.0, 1.0), leads, strict=True):
        # 1e-6 radians short of a stop a part may still overlap by its rounding
        for fraction in np.linspace(0.0, 1.0, some(1000, 100)):
            lead = way * np.maximum(fraction * stop - 1e-6, 0.0)
            assert (smallest_clearance(parts, pose, lead)[free] >= -1e-8).all()
        stopped = free & (stop < 1.0)
        assert (smallest_clearance(parts, pose, way * (stop + 1e-3))[stopped] < 0.0).all()
