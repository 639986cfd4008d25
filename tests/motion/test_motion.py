"""The motion table: windows, dwell, several engagements, mirroring, and arrays in closed form."""

import numpy as np
import pytest
from words import Drive, Keys, Motion, Spec, Wheel

from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.motion_table import motion_table

WHEELS = [
    Spec(Wheel(6)),
    Spec(Wheel(5, "internal")),
    Spec(Wheel(4), Drive(rollers=3)),
    Spec(Wheel(6), Drive("side-crank", rollers=2), Keys("side-crank", 0.6)),
    Spec(Wheel(8), Drive("side-crank", rollers=2), Keys("side-crank", -0.4)),
    Spec(Wheel(6), motion=Motion("modified-sine", ratio="matched")),
    Spec(Wheel(6), motion=Motion("sine-group", 0.1, alpha0_deg=-20.0)),
]


def columns(mechanism: Mechanism, samples: int) -> dict[str, np.ndarray]:
    table = motion_table(mechanism, samples)
    return dict(zip(table.names, (np.asarray(c) for c in table.columns), strict=True))


@pytest.mark.parametrize("spec", WHEELS)
def test_dwell_is_still_and_motion_is_not(spec: Spec) -> None:
    mechanism = build(spec)
    at = columns(mechanism, 7201)
    moving = np.zeros(7201, dtype=bool)
    for s in mechanism.engagements:
        local = at["input_deg"] - s.mid_deg
        inside = (local > s.entry_deg + 1e-9) & (local < s.exit_deg - 1e-9)
        outside = (local < s.entry_deg - 1e-9) | (local > s.exit_deg + 1e-9)
        moving |= inside | ~outside
        # every row is the engagement's own motion, evaluated one by one
        for i in np.flatnonzero(inside)[::97]:
            value = s.motion(float(local[i])).derivatives()
            for name, order in (("velocity", 1), ("acceleration", 2), ("jerk", 3)):
                scale = np.abs(at[name]).max()
                # the row's angle in the machine is rounded once more: 1e-13 of the peak
                assert at[name][i] == pytest.approx(value[order], abs=2e-13 * scale)
    for name in ("velocity", "acceleration", "jerk"):
        assert (at[name][~moving] == 0.0).all()
