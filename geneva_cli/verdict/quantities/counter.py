"""A counter's digits, and the impact when all its number wheels go to 0 at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.impacts import start_impacts
from geneva_cli.numerics.angles import omega

if TYPE_CHECKING:
    from geneva_cli.verdict.quantities.designs import Columns, Designs


def counter(of: Designs) -> Columns:
    """Digits of a number wheel and turns until all show 0; the hardest impact, at that moment."""
    machine, wheel = of.machine, of.spec.wheel
    if not wheel.JUMPS:
        return {}
    step_deg = np.ravel(machine.engagements[0].motion_deg)
    digits = 360.0 / step_deg
    impact = start_impacts(machine)
    jump = np.ravel(impact.jump) * np.ravel(omega(of.spec.drive.n_rpm))
    return {
        "digits": digits,
        "number_step_deg": step_deg,
        "turns_to_zero": digits ** np.ravel(wheel.pinions),
        "impulse_Nms": impact.moment_Nms,
        "energy_J": 0.5 * impact.moment_Nms * jump,
        "force_N": impact.force_N,
    }
