"""Of rollers that all move alike one motion and its dwell stand for the whole turn."""

import math

import pytest
from test_full_turn import spoilt

from geneva_cli.drives.cam import Cam
from geneva_cli.drives.crank import Crank
from geneva_cli.geometry.measure import turned
from geneva_cli.geometry.shapes import closed
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.motion import Motion
from geneva_cli.motion.wheels.external import External, Internal
from geneva_cli.motion.wheels.spherical import Spherical
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.full_turn import full_turn
from geneva_cli.parts.turn.turn_certificate import one_motion
from geneva_cli.spec.tables import Size

SMALL = Size(roller_radius_mm=3.0, slot_clearance_mm=0.02, lock_clearance_mm=0.01)
CURVED = Motion(ModifiedSine(), alpha0_deg=60.0)
SPECS = {
    "external": Spec(External(8), Crank(rollers=2), size=SMALL),
    "no lock": Spec(External(4), Crank(rollers=3), size=SMALL.replace(lock_radius_mm=0.0)),
    "internal": Spec(Internal(12), Cam(rollers=2), CURVED, size=SMALL),
    "spherical": Spec(Spherical(9, axes_deg=80.0), Crank(rollers=2), size=SMALL),
    "too large": Spec(External(21), Crank(rollers=2), size=Size(roller_radius_mm=5.0)),
}


@pytest.mark.long
@pytest.mark.parametrize("name", SPECS)
def test_one_motion_stands_for_all(name):
    """The same gaps and plays, of a part of the turn; gaps to what their search leaves."""
    parts = parts_of(build(SPECS[name]), advice=False)
    once = one_motion(parts)
    rollers = SPECS[name].drive.rollers
    assert once.assembly.span_deg * rollers == pytest.approx(parts.assembly.turn_deg)
    found, whole = full_turn(once), full_turn(parts)
    assert len(found.play.input_deg) < 0.75 * len(whole.play.input_deg)
    for gap in ("driving", "idle", "lock"):
        one, every = getattr(found, gap), getattr(whole, gap)
        assert (one is None) == (every is None)
        assert one is None or one.mm == pytest.approx(every.mm, rel=1e-3, abs=1e-9)
    for play in ("dwell", "hand_over", "motion", "ahead", "behind", "push"):
        one, every = getattr(found, play).deg, getattr(whole, play).deg
        assert one == pytest.approx(every, rel=1e-6, abs=1e-9)


UNLIKE = {
    "one roller": Spec(External(6)),
    "angles": Spec(External(8), Crank(rollers=2, roller_angles_deg=(0.0, 170.0))),
    "steps": Spec(External(4, steps_deg=(80.0, 100.0)), Crank(rollers=2)),
}


@pytest.mark.parametrize("name", UNLIKE)
def test_rollers_that_do_not_move_alike_are_all_looked_at(name):
    parts = parts_of(build(UNLIKE[name]), advice=False)
    assert one_motion(parts) is parts


def test_a_crank_or_wheel_that_is_not_alike_all_round_is_looked_at_all_round():
    """A disc with its relief turned by a degree on one side, and a slot askew."""
    parts = parts_of(build(SPECS["external"]))
    assert one_motion(parts) is not parts
    (disc,) = parts.outlines.crank
    half = len(disc.segments) // 2
    off = turned(disc, math.radians(1.0)).segments[half:]
    crank = spoilt(parts, crank=[closed("CRANK", [*disc.segments[:half], *off])])
    assert one_motion(crank) is crank
    pieces = list(parts.outlines.wheel.segments)
    first = len(pieces) // 8
    pieces[:first] = turned(closed("WHEEL", pieces[:first]), 0.01).segments
    wheel = spoilt(parts, closed("WHEEL", pieces))
    assert one_motion(wheel) is wheel
