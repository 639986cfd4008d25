"""Motions at very many angles, by polynomials: against mpmath, and against each angle alone."""

import numpy as np
import pytest
from repo import DESIGNS
from sampling import some
from witness import Geneva

from geneva_cli.design import load
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.external import External

UNIT = 2.0**-52
COUNT = 65536  # angles, for which polynomials are used
ORDERS = (0, 1, 2, 3)


@pytest.mark.parametrize(("z", "A"), [(6, 0.6), (3, -0.9)])
def test_it_is_exact(z, A):
    moving = build(Spec(External(z), SideCrank(A=A))).engagements[0].motion
    input_deg = np.linspace(moving.entry_deg, moving.exit_deg, COUNT + 9)
    input_deg[1] *= 1.0 + UNIT  # not its own mirror image
    found = moving.derivatives(input_deg, ORDERS)
    for i in np.linspace(1, len(input_deg) - 2, 40).astype(int):
        exact = Geneva(z, "external", A).derivatives(input_deg[i])
        for order, values in enumerate(found):
            assert abs(values[i] - exact[order]) <= 7 * UNIT * abs(values).max()


@pytest.mark.parametrize("name", some([path.stem for path in DESIGNS.glob("*.toml")], ["linear"]))
def test_each_angle_is_as_alone(name):
    """The formulas' own rounding is up to ten units of a peak; each has another."""
    moving = load(str(DESIGNS / f"{name}.toml")).mechanism.engagements[0].motion
    input_deg = np.linspace(moving.entry_deg, moving.exit_deg, COUNT)
    input_deg[1] = 0.5 * (input_deg[0] + input_deg[1])
    found = moving.derivatives(input_deg, ORDERS)
    alone = moving.in_blocks(input_deg, ORDERS)
    for values, own in zip(found, alone, strict=True):
        assert abs(values - own).max() <= 24 * UNIT * abs(own).max()
