"""Names of the strength checks that default sizes must pass, and a spec's checks by name."""

import numpy as np
import pytest

from geneva_cli.motion.many import many
from geneva_cli.motion.mechanism import build
from geneva_cli.verdict.checks import checks
from geneva_cli.verdict.quantities.batch_designs import Designs

PARTS = (
    "pin_stress_MPa",
    "wheel_shaft_stress_MPa",
    "crank_shaft_stress_MPa",
    "arm_stress_MPa",
    "wheel_key_pressure_MPa",
    "crank_key_pressure_MPa",
)
HORNS = ("horn_stress_MPa", "lock_horn_stress_MPa")


def rows(spec):
    return {check.name: check for check in checks(build(spec), turned=False)}


def require_same_in_a_batch(spec, torques, quantities):
    """Sizes and stresses of a batch of torques are those of each design alone."""
    batch = Designs(many(spec, {"load.torque_Nm": torques}).machine)
    single = [Designs(build(spec.with_("load.torque_Nm", float(T)))) for T in torques]
    for quantity in quantities:
        together = quantity(batch)
        for i, designs in enumerate(single):
            alone = quantity(designs)
            assert together.keys() == alone.keys()
            for name, column in together.items():
                value = np.broadcast_to(np.ravel(column), torques.shape)[i]
                # a batch and a single design search the same peaks to some units in the last place
                assert value == pytest.approx(np.ravel(alone[name])[0], rel=1e-12), (quantity, name)
