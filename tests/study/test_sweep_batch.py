"""Designs worked out together are the designs one by one: values, refusals and reasons."""

import math
import os

import numpy as np
import pytest
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.specfile.reader import read
from geneva_cli.study.batches import batch_machines, known_columns
from geneva_cli.study.sweep.plan import plan
from geneva_cli.study.sweep.run import Sweep, sweep
from geneva_cli.study.sweep.values import axis
from geneva_cli.verdict.quantities.groups import GROUPS

DESIGNS = os.path.join(os.path.dirname(__file__), os.pardir, os.pardir, "designs")
TIMING = ["timing.motion_deg", "timing.dwell_s", "timing.k"]
# the last bits of one sine by the C library, of many by NumPy; tops' places to its root
CLOSE, PLACE = 1e-13, 1e-6


def rows(spec, vary, picks, random=None):
    found = sweep(
        read(os.path.join(DESIGNS, spec)),
        plan([axis(v, random is not None) for v in vary], random, 5),
        picks=picks,
    )
    together = found.rows(0, len(found.plan))
    alone = [Sweep.row(found, some) for some in found.plan.rows(0, len(found.plan))]
    return together, alone, found


@pytest.mark.parametrize(
    ("spec", "vary"),
    [
        ("side-crank-z6.toml", ["drive.A=-0.9..1.1:0.1", "wheel.z=2..8"]),
        ("spherical-z6.toml", ["wheel.axes_deg=0..180:20", "wheel.z=3..5"]),
        ("internal-z6.toml", ["drive.kind=crank,side-crank", "drive.A=0.1,0.3"]),
        ("modified-sine-matched.toml", ["motion.alpha0_deg=-100..100:25", "wheel.z=3..6"]),
        ("modified-sine-matched.toml", ["motion.law=cycloidal,3-4-5", "drive.n_rpm=10..30:10"]),
        ("three-rollers-z4.toml", ["drive.rollers=1..3", "wheel.z=3..5"]),
        ("unequal-steps.toml", ["drive.n_rpm=10..30:10"]),
    ],
)
def test_together_as_alone(spec, vary):
    together, alone, found = rows(spec, vary, TIMING)
    keys = [a.key for a in found.plan.axes]
    known = found.known(found.plan.rows(0, len(alone)))
    built = sum(row[-1] is None for row in alone)
    # where engagements differ, none of their timings is shared
    assert len(known) == built
    for one, other in zip(together, alone, strict=True):
        assert one[: len(keys)] == other[: len(keys)]
        assert one[-1] == other[-1]
        for a, b in zip(one[len(keys) : -1], other[len(keys) : -1], strict=True):
            assert a == b or a == pytest.approx(b, rel=CLOSE)


@pytest.mark.long
@pytest.mark.sampled(3)
@pytest.mark.parametrize("spec", ["internal-z6.toml", "tolerances.toml", "spherical-z6.toml"])
def test_locks_together_as_alone(spec):
    """Locks of any radius and of none, without a torque too, and parts that cannot be cut.

    Angles within rounding of a radian.
    """
    picks = [
        name
        for group in GROUPS
        for name in group.batched
        if name.startswith(("strength.horn", "strength.lock"))
    ]
    vary = ["size.lock_radius_mm=0,20,35,60", "load.dwell_torque_Nm=0,3", "load.inertia_kgm2=1"]
    together, alone, found = rows(spec, [*vary, "size.face_width_mm=10"], picks)
    keys = [axis.key for axis in found.plan.axes]
    known = found.known(found.plan.rows(0, 8))
    assert len(known) == sum(row[-1] is None for row in alone) > 0
    for one, other in zip(together, alone, strict=True):
        assert one[-1] == other[-1]
        for name, a, b in zip(picks, one[len(keys) : -1], other[len(keys) : -1], strict=True):
            near = {"abs": PLACE} if name.endswith("at_deg") else {"rel": 1e-12, "abs": 1e-13}
            assert a == b or a == pytest.approx(b, **near), name


@pytest.mark.long
def test_a_row_is_the_same_alone_and_among_thousands(tmp_path, monkeypatch):
    """Shards promise the bytes of one run: a block here ends with one design alone."""
    monkeypatch.chdir(tmp_path)
    spec = '[wheel]\nz = 6\n[drive]\nkind = "side-crank"\nA = 0.3\n[load]\ninertia_kgm2 = 0.5\n'
    (tmp_path / "spec.toml").write_text(spec + "friction = 0.1\n")
    picked = "loads.pin_force_N.max,loads.pin_force_N.at_deg,loads.input_torque_Nm.at_deg"

    def last(values):
        call = ["sweep", "spec.toml", "--vary", f"drive.A={values}", "--pick", picked]
        return CliRunner().invoke(app, [*call, "--format", "csv"]).stdout.splitlines()[-1]

    assert last("0..0.8:0.0001") == last("0..0.8:0.002")


@pytest.mark.long
@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("table", "picked"),
    [("strength", "strength.crank_shaft.stress_MPa"), ("life", "life.slot_travel_m")],
)
def test_what_is_too_fast_for_loads_is_refused_in_a_batch_too(table, picked):
    """As `loads` and `check` refuse it, whatever is picked; the slower design has its loads."""
    names = [name for group in GROUPS if group.table == table for name in group.batched]
    found = sweep(
        read(os.path.join(DESIGNS, "elliptical-gears.toml")),
        plan([axis("drive.eccentricity=0.999,0.9999999,0.99999999")], None, 5),
        picks=[picked],
    )
    designs = found.plan.rows(0, 3)
    slow = found.known(designs).keys()
    errors = [row[-1] for row in found.rows_of(designs)]
    assert set(slow) <= {0}
    assert errors[0] is None
    assert all("so the loads would be rounding" in error for error in errors[1:])
    specs = [found.machine(design).spec for design in designs[:2]]
    ((_, machine),) = batch_machines(specs)
    columns = [np.broadcast_to(x, 2) for x in known_columns(machine, names).values()]
    assert all(math.isnan(fast) for _, fast in columns)
    assert math.isfinite(known_columns(machine, [picked])[picked][0])
