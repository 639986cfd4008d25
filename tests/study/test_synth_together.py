"""What synthesis looks up of many machines at once, against each machine alone."""

import pytest

from geneva_cli.drives.cam import Cam
from geneva_cli.drives.crank import Crank
from geneva_cli.drives.epicyclic import Epicyclic
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.motion.laws.standard import Cycloidal
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.motion import Motion
from geneva_cli.motion.undercut import depths_mm, undercut
from geneva_cli.motion.wheels.external import External
from geneva_cli.motion.wheels.internal import Internal
from geneva_cli.parts.assembly import assembly
from geneva_cli.parts.slots.groove import greatest_pressure
from geneva_cli.parts.slots.roller_paths import roller_paths
from geneva_cli.spec.tables import Load, Size
from geneva_cli.study.batches import numbers
from geneva_cli.study.synth.parts_data import (
    UNDERCUT_SAMPLES,
    _alike,
    _kept,
    compute_parts_data,
    parts_data,
)

LAW = Cycloidal()
MATCHED = Motion(LAW, ratio="matched")
SPECS = [
    *(Spec(External(z), Crank(n_rpm=30.0, rollers=2), MATCHED) for z in (5, 7)),
    Spec(Internal(9), motion=Motion(LAW, alpha0_deg=-60.0, ratio="matched")),
    Spec(External(6), motion=Motion(LAW, alpha0_deg=-40.0, ratio="matched")),
    Spec(External(6), motion=Motion(LAW, alpha0_deg=-40.0, ratio=0.4)),
    *(Spec(External(6), Cam(), Motion(LAW, alpha0_deg=a)) for a in (-70.0, 20.0)),
    Spec(Internal(5), Cam(), Motion(LAW)),
    *(Spec(External(z, offset_mm=4.0)) for z in (5, 8)),
    Spec(Internal(4), SideCrank(A=0.3), size=Size(center_distance_mm=170.0)),
    Spec(External(4), Epicyclic(planet_ratio="shockless", fixed="ring")),
]


def test_looks_at_parts():
    """As the parts have it, machine by machine.

    The same places of paths, in other orders of arithmetic: 1e-12. A groove is looked at half a
    degree apart, where it is nearest to the crank's axis and steepest within 1e-3 of the truth.
    """
    _kept.clear()
    compute_parts_data(SPECS)
    assert {_alike(spec) for spec in SPECS} == set(_kept)
    for spec in SPECS:
        seen, machine = parts_data(spec), build(spec)
        groove = machine.engagements[0].groove
        known = roller_paths(assembly(machine))
        assert seen.paths.ends == pytest.approx(known.ends, rel=1e-12)
        assert seen.paths.arm == pytest.approx(known.arm, rel=1e-3 if groove else 1e-12)
        if groove:
            assert seen.pressure_deg == pytest.approx(greatest_pressure(groove)[0], rel=1e-3)
        found = undercut(machine, UNDERCUT_SAMPLES)
        w = machine.roller_radius_mm + spec.size.allowances.slot_clearance_mm
        cut = [depths_mm(wall, w, machine.center_distance_mm)[0] for wall in seen.walls or ()]
        assert max(cut, default=0.0) == pytest.approx(found.depth_mm if found else 0.0, rel=1e-9)


def test_specs_of_one_kind_keep_their_own_loads_and_sizes():
    """A force goes with the inertia, and with 1/L: three times the one, a third of the other."""
    specs = [
        Spec(External(6), load=Load(inertia_kgm2=inertia), size=Size(center_distance_mm=L))
        for inertia, L in ((1.0, 100.0), (3.0, 100.0), (1.0, 300.0))
    ]
    (one,), (heavy,), (wide,) = numbers(specs, ["loads.pin_force_N.max"])
    assert heavy == pytest.approx(3.0 * one, rel=1e-12)
    assert wide == pytest.approx(one / 3.0, rel=1e-12)
