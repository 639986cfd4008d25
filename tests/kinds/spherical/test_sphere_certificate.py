"""Certificates of the full turn on a sphere, against dense samples and collisions of known depth.

The witnesses: points that lie densely on the edges, gaps at positions that lie densely in an
interval, parts that are larger by a known amount, and sectors that are turned out of their place.
"""

import math
import random

import numpy as np
import pytest
import repo
from other_shape import with_shape
from sampling import some
from turn_witness import TO_MM, check_bounds, check_overlap, check_proof
from words import load

from geneva_cli import Crank, Design, Size, Spherical
from geneva_cli.errors import GenevaError
from geneva_cli.kinds.spherical.gaps import BallGaps
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.full_turn import full_turn

MACHINES = some(300, 5)
DESIGNS = sorted(path.name for path in repo.DESIGNS.glob("spherical-*.toml"))


def named(name):
    return parts_of(load(repo.DESIGNS / name))


def random_parts(seed):
    """The shells of a random machine; None if it cannot be."""
    rng = random.Random(seed)
    z, L = rng.randint(3, 16), 100.0
    axes_deg = rng.uniform(15.0, 165.0)
    arm = math.asin(math.sin(math.radians(axes_deg)) * math.sin(math.pi / z))
    size = Size(
        L,
        L * arm * rng.uniform(0.02, 0.25),
        slot_clearance_mm=rng.choice([0.0, 0.02, 0.3]),
        lock_clearance_mm=rng.choice([0.0, 0.03, 0.5]),
    )
    drive = Crank(rollers=rng.choice((1, 1, 2)))
    try:
        return parts_of(Design(Spherical(z, axes_deg=axes_deg), drive, size=size).mechanism).built
    except GenevaError:
        return None


def random_machines(first):
    machines = (random_parts(seed) for seed in range(first, first + MACHINES))
    return [parts for parts in machines if parts is not None]


def spoilt(parts, **larger_mm):
    """The parts, of which some angles are larger by lengths on the sphere."""
    L, ball = parts.ball.radius_mm, parts.ball
    ball = ball._replace(**{k: getattr(ball, k) + v / L for k, v in larger_mm.items()})
    return with_shape(parts, gaps=BallGaps(parts.assembly, ball, parts.shape.crank))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", DESIGNS)
def test_no_gap_within_an_interval_is_below_its_bound(name):
    check_bounds(named(name), np.random.default_rng(3))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", DESIGNS)
def test_designs_are_proved_to_a_micrometre_of_their_smallest_gap(name):
    parts = named(name)
    found = check_proof(parts, full_turn(parts).smallest.mm)
    assert found.open is None
    assert found.intervals < 2000


def test_a_bound_that_is_reached_by_rounding_proves_its_interval():
    """A target in mm is no larger than the distance up to which parts count."""
    parts = named("spherical-z6.toml")
    spec = parts.mechanism.spec.with_("size.slot_clearance_mm", 0.3)
    parts = parts_of(build(spec.with_("size.lock_clearance_mm", 0.2)))
    assert check_proof(parts, full_turn(parts).smallest.mm).open is None


@pytest.mark.long
def test_random_machines_keep_what_is_proved():
    """Gaps at dense positions of a turn are at least the proved bound; most are proved."""
    every = [check_proof(parts, full_turn(parts).smallest.mm) for parts in random_machines(0)]
    assert sum(one.open is None for one in every) > 0.9 * len(every)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("depth", [0.5 * TO_MM, 0.9 * TO_MM, 1.1 * TO_MM, 0.05, 0.5])
@pytest.mark.parametrize("name", DESIGNS)
def test_a_collision_of_known_depth_is_proved_to_no_less(name, depth):
    """A roller larger than its slot, and a locking sector larger than its recess."""
    parts = named(name)
    for worse in (spoilt(parts, roller=depth), spoilt(parts, recess=-depth)):
        check_overlap(worse, depth)
