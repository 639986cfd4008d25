"""Certificates of the full turn, against dense samples and against collisions of known depth.

The witnesses: distances of points that lie densely on the outlines, gaps at positions that lie
densely in an interval, and parts that are enlarged by a known amount.
"""

import copy
import functools
import re

import numpy as np
import pytest
import repo
from other_shape import with_shape
from turn_witness import TO_MM, check_bounds, check_overlap, check_proof
from words import load

from geneva_cli.geometry.shapes import placed
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.full_turn import full_turn
from geneva_cli.verdict.checks.motion_checks import proof as gap_proof

FLAT = [path.name for path in sorted(repo.DESIGNS.glob("*.toml")) if load(path).spec.wheel.FLAT]


@functools.cache
def named(name):
    return parts_of(load(repo.DESIGNS / name))


def with_roller(parts, larger_mm):
    """The parts with larger rollers in the same slots."""
    gaps = copy.copy(parts.gaps)
    gaps.sizes = parts.sizes._replace(roller=parts.sizes.roller + larger_mm)
    return with_shape(parts, sizes=gaps.sizes, gaps=gaps)


def larger_crank(parts, larger_mm):
    """The crank with its locking disc larger in radius by a length, and the same shape."""
    scale = 1.0 + larger_mm / parts.sizes.lock
    crank = [placed(contour, scale=scale) for contour in parts.outlines.crank]
    return with_shape(parts, crank=crank, gaps=parts.gaps.with_crank(crank))


@pytest.mark.parametrize("name", FLAT)
@pytest.mark.sampled(40)
def test_no_gap_within_an_interval_is_below_its_bound(name):
    parts = named(name)
    check_bounds(parts, np.random.default_rng(3))


@pytest.mark.sampled(40)
@pytest.mark.parametrize("name", FLAT)
def test_designs_are_proved_to_a_micrometre_of_their_smallest_gap(name):
    parts = named(name)
    gap = full_turn(parts).smallest.mm
    to_mm = max(TO_MM, 2.0 * parts.contact)
    assert check_proof(parts, gap, to_mm).open is None


@pytest.mark.sampled(16)
@pytest.mark.parametrize("depth", [0.5 * TO_MM, 0.9 * TO_MM, 1.1 * TO_MM, 0.05, 0.5])
@pytest.mark.parametrize("name", ["turret.toml", "press-curved.toml", "internal-z6.toml"])
def test_a_collision_of_known_depth_is_proved_to_no_less(name, depth):
    """A roller larger than its slot, and a locking disc larger than its recess.

    Walls of a curved slot are up to CURVED from their true place.
    """
    parts = named(name)
    for worse in (with_roller(parts, depth), larger_crank(parts, depth)):
        check_overlap(worse, depth, parts.close)


def checked(parts, turn_of=None, to_mm=None):
    """The check of parts whose sampled turn may be that of other parts."""
    own = with_shape(parts)
    vars(own)["turn"] = full_turn(turn_of or parts)
    return next(gap_proof(["gap_proved_mm"], own, to_mm), None)


def test_the_check_passes_with_its_proof_and_fails_where_samples_missed_a_collision():
    parts = named("turret.toml")
    check = checked(parts)
    assert check.passes
    assert re.fullmatch(r"collision-free, proved to 1 µm \([\d,]+ intervals\)", check.why)
    assert -TO_MM <= check.value <= 0.0
    assert checked(parts, to_mm=1e-9).passes is None  # an open interval is no failure
    worse = with_roller(parts, 0.5)
    assert checked(worse) is None  # the sampled gap fails already
    check = checked(worse, turn_of=parts)
    assert check.passes is False
    assert check.value == pytest.approx(-0.5)
