"""The teeth of a counter as gears in mesh: their numbers, shifts, diameters and contact ratio."""

from __future__ import annotations

import math

from geneva_cli.layout.gear_mesh import GearMesh, ToothedGear
from geneva_cli.outlines.counter import CounterSizes


def counter_mesh(sizes: CounterSizes) -> GearMesh:
    """Return driver, pinion and number wheel; of the driver's teeth two are left.

    The driver's teeth lie to either side of the x axis, and so does a space of the number wheel. A
    wide tooth of the pinion is on the x axis.
    """
    driver, pinion = sizes.driver, sizes.pinion
    count, half = round(math.tau / driver.step), sizes.half_space
    ahead = tuple(half + k * driver.step for k in range(count))
    around = tuple(k * pinion.step for k in range(round(math.tau / pinion.step)))
    gears = {
        "driver": ToothedGear(driver, count, sizes.shifts[0], ((-half, half),)),
        "pinion": ToothedGear(pinion, len(around), sizes.shifts[1], (around,)),
        "number wheel": ToothedGear(driver, count, sizes.shifts[0], (ahead,)),
    }
    far = sizes.distance * math.sin(sizes.pressure_angle)
    path = driver.tangent(driver.tip) + pinion.tangent(pinion.tip) - far
    contact = path / (driver.rack.pitch * math.cos(driver.rack.angle))
    return GearMesh(gears, sizes.pressure_angle, contact)
