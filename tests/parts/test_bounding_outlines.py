"""Outlines that no part goes beyond: every point of the parts lies in them, and play is no less."""

import random

import numpy as np
import pytest
from sampling import some

from geneva_cli.collisions.free_angles import free_angles
from geneva_cli.collisions.play import windows
from geneva_cli.errors import GenevaError
from geneva_cli.kinematics.laws.standard import (
    Cycloidal,
    ModifiedSine,
    ModifiedTrapezoid,
    SineGroup,
)
from geneva_cli.kinematics.motion import Motion
from geneva_cli.kinematics.wheels.external import External
from geneva_cli.kinematics.wheels.internal import Internal
from geneva_cli.layout.assembly import assembly
from geneva_cli.layout.sizes import sizes
from geneva_cli.machine.drives.cam import Cam
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.outlines.bounding_outlines import bounding_outlines
from geneva_cli.outlines.outlines import outlines
from geneva_cli.spec.tables import Size

SAME = 1e-7  # mm: the step to which ends of curved walls are rounded
NEARLY = np.radians(0.02)  # what a play is told short by at most


def told(spec):
    """The parts that are told to be the most, and the parts."""
    where = assembly(build(spec))
    more = bounding_outlines(where, sizes(where))
    return more, outlines(where.full)


@pytest.fixture(scope="module")
def pairs():
    """Of random machines, those whose wheel goes beyond the crank's axis."""
    lot, found = random.Random(3), []
    while len(found) < some(12, 6):
        drive = lot.choice([Crank, Cam])(rollers=lot.choice([1, 1, 2]))
        ratio = lot.choice(["matched", None]) if drive.NAME == "crank" else None
        law = lot.choice([ModifiedSine(), ModifiedTrapezoid(), Cycloidal(), SineGroup(0.1)])
        size = {"roller_radius_mm": lot.choice([5.0, 4.0, 3.0, 2.5, 2.0, 1.0])}
        if lot.random() < 0.3:
            size["slot_clearance_mm"] = lot.uniform(0.0, 0.2)
        motion = Motion(law, alpha0_deg=lot.uniform(-60.0, 0.0), ratio=ratio)
        try:
            more, parts = told(
                Spec(External(lot.randint(6, 25)), drive, motion=motion, size=Size(**size))
            )
        except GenevaError:  # no such machine
            continue
        if more:
            found.append((more, parts))
    return found


def test_all_material_lies_within(pairs):
    for more, parts in pairs:
        for own, other in (
            (parts.gaps.wheel, more.gaps.wheel),
            (parts.gaps.crank, more.gaps.crank),
        ):
            outside = other.signed(own.samples(1e-3, 0.1)).max()
            assert outside < SAME


def test_play_between_lock_and_slot_is_no_less_and_hardly_more(pairs):
    for more, parts in pairs:
        for start, end in [(a, b) for a, b, _, rests in windows(parts) if rests]:
            at = np.linspace(start, end, 52)[1:-1]
            told, whole = (np.stack(free_angles(one, at)) for one in (more, parts))
            assert (told <= whole + SAME).all()
            assert np.median(whole.max(axis=0) - told.max(axis=0)) < NEARLY


def test_they_are_of_both_drives(pairs):
    assert {more.assembly.mechanism.spec.drive.NAME for more, _ in pairs} == {"crank", "cam"}


OTHERS = [  # none of which is told: inside, a disc about its axis, no lock, no law
    Spec(Internal(12), Cam(), motion=Motion(ModifiedSine(), alpha0_deg=40.0)),
    Spec(External(8), Cam(), motion=Motion(ModifiedSine(), alpha0_deg=10.0)),
    Spec(
        External(24),
        Cam(),
        motion=Motion(ModifiedSine(), alpha0_deg=-35.0),
        size=Size(lock_radius_mm=0.0),
    ),
    Spec(External(6)),
]


@pytest.mark.parametrize("spec", OTHERS, ids=["internal", "disc", "no lock", "straight"])
def test_of_others_nothing_is_told(spec):
    assert told(spec)[0] is None


def test_where_no_sector_is_left_neither_says_otherwise():
    motion = Motion(ModifiedSine(), alpha0_deg=-35.0)
    spec = Spec(External(24), Cam(), motion=motion, size=Size(roller_radius_mm=5.0))
    where = assembly(build(spec))
    for refused in (lambda: bounding_outlines(where, sizes(where)), lambda: outlines(where.full)):
        with pytest.raises(GenevaError, match="locking sector") as error:
            refused()
        assert error.value.key == ("size", "lock_radius_mm")
