"""What synthesis looks up of many machines at once, against each machine alone."""

import pytest

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.wheels.external import External
from geneva_cli.spec.tables import Load, Size
from geneva_cli.study.batches import batch_machines, numbers


def test_specs_of_one_kind_keep_their_own_loads_and_sizes():
    """A force goes with the inertia, and with 1/L: three times the one, a third of the other."""
    specs = [
        Spec(External(6), load=Load(inertia_kgm2=inertia), size=Size(center_distance_mm=L))
        for inertia, L in ((1.0, 100.0), (3.0, 100.0), (1.0, 300.0))
    ]
    ((one, heavy, wide),) = numbers(batch_machines(specs), ["loads.pin_force_N.max"], 3)
    assert heavy == pytest.approx(3.0 * one, rel=1e-12)
    assert wide == pytest.approx(one / 3.0, rel=1e-12)
