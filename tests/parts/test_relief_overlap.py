"""Reliefs that go all the way round, told early: only of machines that are refused when drawn."""

import random

import pytest
from sampling import some

from geneva_cli.errors import GenevaError
from geneva_cli.kinematics.laws.standard import ModifiedSine
from geneva_cli.kinematics.motion import Motion
from geneva_cli.kinematics.wheels.external import External
from geneva_cli.kinematics.wheels.internal import Internal
from geneva_cli.layout.assembly import assembly
from geneva_cli.layout.sizes import sizes
from geneva_cli.machine.drives.cam import Cam
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.outlines.outlines import outlines
from geneva_cli.outlines.relief_overlap import leave_no_disc
from geneva_cli.spec.tables import Size

GONE = "nothing is left of the locking disc"


def told(spec):
    """Whether it is told early, and what a drawing is refused for."""
    where = assembly(build(spec))
    try:
        early = leave_no_disc(where, sizes(where))
        outlines(where.full)
    except GenevaError as error:
        return early, str(error)
    return early, ""


def machine(z, drive, alpha0_deg, **size):
    ratio = None if drive.NAME == "cam" else "matched"
    motion = Motion(ModifiedSine(), alpha0_deg=alpha0_deg, ratio=ratio)
    return Spec(External(z), drive, motion=motion, size=Size(**size))


@pytest.mark.parametrize("drive", [Crank(rollers=2), Cam(rollers=2)], ids=["crank", "cam"])
def test_large_rollers_leave_no_disc_and_small_ones_do(drive):
    """Every one that is refused for it is told, but where it is next to nothing."""
    radii = (5.0, 4.0, 3.0, 2.5, 1.0)
    seen = [told(machine(23, drive, -5.65, roller_radius_mm=r)) for r in radii]
    assert [early for early, _ in seen] == [True, True, True, True, False]
    assert [said.startswith(GONE) for _, said in seen] == [True, True, True, True, False]


def test_none_is_told_that_can_be_drawn():
    """Random machines, of which most have a disc."""
    lot, found = random.Random(11), []
    for _ in range(some(60, 25)):
        drive = lot.choice([Crank, Cam])(rollers=lot.choice([1, 2, 2, 3]))
        size = {"roller_radius_mm": lot.choice([5.0, 4.0, 3.0, 2.5, 2.0, 1.5])}
        if lot.random() < 0.3:
            size["relief"] = lot.choice(["arc", "sector"])
        try:
            found.append(told(machine(lot.randint(6, 24), drive, lot.uniform(-20, 10), **size)))
        except GenevaError:  # no such machine
            continue
    assert not [said for early, said in found if early and not said.startswith(GONE)]
    assert {(True, True), (False, False)} <= {(early, bool(said)) for early, said in found}


def test_where_there_is_no_disc_to_be_cut_nothing_is_told():
    internal = Spec(Internal(12), Cam(), motion=Motion(ModifiedSine(), alpha0_deg=40.0))
    without = machine(23, Crank(rollers=2), -5.65, roller_radius_mm=5.0, lock_radius_mm=0.0)
    straight = Spec(External(23), Crank(rollers=2))
    for spec in (internal, without, straight):
        where = assembly(build(spec))
        assert not leave_no_disc(where, sizes(where))
