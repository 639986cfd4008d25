"""Loads of many designs: against the cycle of each, which shares no step of the search."""

import numpy as np
import pytest
from design_arrays import MACHINES, alone, drawn

from geneva_cli.analysis.loads.cycle import Cycle
from geneva_cli.analysis.loads.many import LOADS, are_smooth, extremes_of_many
from geneva_cli.analysis.loads.quantities import ends_of
from geneva_cli.machine.many import many
from geneva_cli.spec.tables import Load

STRAIGHT = [name for name, (spec, _) in MACHINES.items() if spec.motion is None] + ["cam"]
CARRIED = [
    ("load.inertia_kgm2", 0.0, 3.0),
    ("load.torque_Nm", 0.0, 30.0),
    ("load.efficiency", 0.5, 1.0),
    ("drive.n_rpm", 5.0, 100.0),
]


@pytest.mark.parametrize("name", STRAIGHT)
def test_as_one_by_one(name):
    spec, rules = MACHINES[name]
    spec = spec.but(load=Load(inertia_kgm2=1.0))
    varied = drawn([*rules, *CARRIED], 12, 21)
    found = many(spec, varied)
    loads = extremes_of_many(found.machine)
    for row, i in enumerate(found.which):
        cycle = Cycle(alone(spec, varied, i))
        for load, one in zip(LOADS, ends_of(cycle, *LOADS), strict=True):
            here = [values[row] for values in loads[load]]
            # both are within some 1e-15 of the load's greatest size; 1e-13 near a sector's limit
            size = 1e-13 * max(abs(one.max), abs(one.min))
            assert here[0] == pytest.approx(one.max, abs=size), (load, i)
            assert here[2] == pytest.approx(one.min, abs=size), (load, i)
            # a top is flat: its place is known to the root of a rounding
            assert here[1] == pytest.approx(one.max_at_deg, abs=1e-4), (load, i)
            assert here[3] == pytest.approx(one.min_at_deg, abs=1e-4), (load, i)


def test_the_inertia_alone_against_the_theory():
    """theory-loads: the pin force's factor of the classic wheel of six slots, at -19.96 deg."""
    spec, _ = MACHINES["crank"]
    spec = spec.but(load=Load(inertia_kgm2=1.0))
    found = many(spec, {"wheel.z": np.array([6, 12]), "drive.n_rpm": np.array([60.0, 30.0])})
    force = extremes_of_many(found.machine, ["pin_force_N"])["pin_force_N"]
    L, w = 0.1, np.array([2.0 * np.pi, np.pi])
    assert force.max * L / w**2 == pytest.approx(
        [2.3911331461217286, 0.42187714544353779], rel=1e-14
    )
    assert force.max_at_deg == pytest.approx([-19.9649425, -39.16219639], abs=1e-7)


@pytest.mark.parametrize(("load", "name"), [(Load(friction=0.1), "crank"), (Load(), "cycloidal")])
def test_others_are_asked_one_by_one(load, name):
    spec, rules = MACHINES[name]
    found = many(spec.but(load=load), drawn(rules, 20, 1))
    assert not are_smooth(found.machine)
    with pytest.raises(ValueError, match="one by one"):
        extremes_of_many(found.machine)
