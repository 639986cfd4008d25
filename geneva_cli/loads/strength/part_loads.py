"""The greatest loads on pin, arm, keys and shafts over a cycle, from which they are sized."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.kept import Known
from geneva_cli.loads.cycle_quantities import FORCE
from geneva_cli.loads.impacts.reversal import reversal_impacts
from geneva_cli.loads.instant import LoadQuantity
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.loads.strength.lock import dwell_torque_Nm
from geneva_cli.loads.strength.shaft_stress import (
    OnShaft,
    Torque,
    crank_forces,
    on_carrier,
    wheel_forces,
)
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import parameter


class PartLoads(NamedTuple):
    """The greatest sizes of loads, (m,) each, or numbers of one design; infinite if unbounded."""

    pin_N: float  # of a roller, along the wall's normal
    pin_jump: float  # at its change of sides: of the wheel's speed, over the input's
    wheel_N: float  # on the wheel in motion, which is that on the roller and its arm
    wheel_shaft_N: float  # on the wheel's shaft in motion: on a carrier that of its bodies, too
    wheel_Nm: float  # torque in the wheel's shaft, also in the dwell
    crank_N: float  # of the crank's bearings together, with the push of gears or of a link
    crank_Nm: float  # torque in the crank's shaft

    def of(self, i: int) -> PartLoads:
        """The loads of one design of a batch, as numbers."""
        return PartLoads(*(float(np.ravel(row)[i]) for row in self))


@Known
def single_loads(mechanism: Mechanism) -> PartLoads:
    """The loads for which a machine is sized as numbers, cached for its sizes and their checks."""
    return part_loads(mechanism).of(0)


def part_loads(mechanism: Mechanism) -> PartLoads:
    """The greatest loads of m designs."""
    spec = mechanism.spec
    turned = {"wheel_Nm": Torque(wheel_forces(mechanism)), "crank_Nm": Torque(crank_forces(spec))}
    shaft, own = "wheel_bearing_N", dict[str, LoadQuantity](turned)
    if spec.drive.wheels_on_carrier:
        shaft, own["wheel_shaft_N"] = "wheel_shaft_N", OnShaft(on_carrier(mechanism))
    names = FORCE, "wheel_bearing_N", shaft, "crank_bearing_N", *turned
    peaks = load_peaks(mechanism, tuple(dict.fromkeys(names)), own)
    force, wheel, on_shaft, crank = (peaks[name].max for name in names[:4])
    wheel_Nm, crank_Nm = (np.sqrt(peaks[name].max) for name in turned)
    jump = np.nan_to_num(reversal_impacts(mechanism).jump) + np.zeros(np.shape(force))
    held = np.maximum(wheel_Nm, dwell_torque_Nm(mechanism))
    return PartLoads(*map(parameter, (force, jump, wheel, on_shaft, held, crank, crank_Nm)))
