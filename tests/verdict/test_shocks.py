"""The checks of shocks: what they hold, what they say, and that what they say is so."""

import math
import re

import numpy as np
import pytest
from impact_witness import contact_of, force_of, impacts_in

from geneva_cli import Design, External, Limits, Load, Size, Spherical, Tolerance
from geneva_cli.loads.impacts import change_of_sides
from geneva_cli.loads.impacts.impacts import entry_impacts, reversal_impacts
from geneva_cli.loads.impacts.mouth import mouth_contacts
from geneva_cli.loads.strength.pin import pin_diameter_mm
from geneva_cli.motion.many import many
from geneva_cli.parts.outlines.outline_sizes import built
from geneva_cli.verdict.checks import single_check
from geneva_cli.verdict.quantities.designs import Designs
from geneva_cli.verdict.quantities.disturbances import entry, reversal

LOOSE = Size(face_width_mm=18.0, slot_clearance_mm=0.02)
WIDE = Tolerance(crank_radius_mm=0.02, center_distance_mm=0.03, slot_width_mm=0.02)


def design(force=None, **more):
    given = {"size": LOOSE, "load": Load(inertia_kgm2=0.4, torque_Nm=2.0), "tolerance": WIDE}
    return Design(External(6), limits=Limits(pin_force_max_N=force), **(given | more))


def row(of, name):
    return single_check(of.mechanism, name)


def test_no_tolerance_no_row():
    bare = design(tolerance=Tolerance(distribution="normal"))
    assert row(bare, "entry_shock_N") is None
    assert row(bare, "reversal_shock_N") is None
    # a crank as long as it should be; and nothing that turns on
    assert row(design(tolerance=Tolerance(slot_width_mm=0.01)), "entry_shock_N") is None
    assert row(design(load=Load(torque_Nm=2.0)), "reversal_shock_N") is None


def test_values_are_those_of_the_worst_machine():
    of = design(1e6)
    [engagement] = of.mechanism.engagements
    # on the slot's axis, where the slot has room for an arm too short by 0.02 + 0.03 sin(30 deg)
    roomy = design(1e6, size=Size(face_width_mm=18.0, slot_clearance_mm=0.046))
    contact = contact_of(engagement, 0.02 / 50.0, -0.03 / 100.0)
    check = row(roomy, "entry_shock_N")
    assert check.value == force_of(roomy.mechanism, contact.jump)
    assert check.at_deg == contact.at_deg
    assert check.passes
    # and on its mouth's far corner where it has but 0.02 - 0.02/2
    harder = mouth_contacts(engagement, 0.02 / 50.0, -0.03 / 100.0, 0.05, 1e-4)
    check = row(of, "entry_shock_N")
    assert check.value == force_of(of.mechanism, harder.jump[0])
    assert check.at_deg == harder.at_deg[0]
    drag = change_of_sides.drag_over(of.mechanism)
    [start] = change_of_sides.changes(engagement, np.array([[drag]])).x
    x, y = (z.c[0] for z in engagement.path(start, 0))
    play = 2.0 * math.asin(0.03 / (100.0 * math.hypot(x, y)))
    [impact] = impacts_in(engagement, play, drag)
    assert row(of, "reversal_shock_N").value == pytest.approx(
        force_of(of.mechanism, impact.speed), rel=1e-12
    )


def test_what_would_pass_passes():
    of = design(100.0)
    check = row(of, "entry_shock_N")
    assert check.passes is False
    for key, value in re.findall(r"(\w+_mm) = ([\d.e-]+)", check.why):
        of = of.with_(f"tolerance.{key}", float(value))
    assert row(of, "entry_shock_N").passes
    check = row(of, "reversal_shock_N")
    assert check.passes is False
    drag = float(re.match(r"a drag of ([\d.]+) N m on", check.why)[1])
    assert row(of.with_("load.torque_Nm", 2.0 + drag), "reversal_shock_N") is None
    assert row(of.with_("load.torque_Nm", 2.0 + 0.97 * drag), "reversal_shock_N") is not None


def test_what_is_missing_is_named():
    check = row(design(size=Size(), load=Load()), "entry_shock_N")
    assert (check.value, check.passes) == (None, None)
    for key in ("inertia_kgm2", "face_width_mm", "pin_force_max_N"):
        assert key in check.why
    check = row(design(), "reversal_shock_N")
    assert check.value > 0.0
    assert check.passes is None
    assert "set pin_force_max_N in [limits]; a drag of" in check.why


def test_the_dimensions_that_are_not_there():
    """On a sphere the centre distance moves nothing; its crank's arm does."""
    only = Design(Spherical(6), tolerance=Tolerance(center_distance_mm=0.1))
    assert entry_impacts(only.mechanism).only is None
    assert entry_impacts(only.with_("tolerance.crank_radius_mm", 0.1).mechanism).only.jump < 0.0
    assert reversal_impacts(only.mechanism).only is None


def test_the_force_bends_the_pin_that_is_drawn():
    """A load makes the default pin thicker than half of its roller, and so stiffer."""
    load, size = Load(inertia_kgm2=4.0, torque_Nm=2.0), LOOSE.replace(roller_radius_mm=4.0)
    of = design(1e6, load=load, size=size)
    drawn_mm = built(of.mechanism).pin_mm
    assert drawn_mm > pin_diameter_mm(of.mechanism)
    same = of.with_("size.pin_mm", drawn_mm)
    for name, table in (("entry_shock_N", entry), ("reversal_shock_N", reversal)):
        force = row(of, name).value
        assert force == row(same, name).value
        batch = many(of.spec, {"load.torque_Nm": np.array([2.0, 1.0])}).machine
        assert table(Designs(batch))["force_N"][0] == pytest.approx(force, rel=1e-12)  # rounding
