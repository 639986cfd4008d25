"""Widths and lengths of bores, hubs and shafts of a spherical machine.

A shell's faces are round, so a part on a shaft needs a hub with flat faces, in a round hole of the
shell. Heights count as on a plane (``parts.shafts.hub_and_shafts``) from the wheel's lower face,
here its outer sphere, inwards.
"""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.parts.sizes import crank_reach_and_hub, wheel_bore, wheel_reach_and_hub
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.spec.tables import Size


def wheel_axle(spec: Spec, L: float, inside: float, slot_end: float) -> tuple[float, float]:
    """Return the radii of the wheel's bore and its hub, mm, 0 for none.

    ``inside`` is the radius of the wheel's inner sphere, ``slot_end`` the angle from its axis to
    the ends of its slots. Raises GenevaError, naming the key, where one of them cuts the slots.
    """
    end = inside * math.sin(min(slot_end, 0.5 * math.pi))
    size = spec.size
    bore = wheel_bore(spec, end, wall_min(size, L), L)
    hub = hub_about(size, L, bore, end)
    for key, radius in (("wheel_bore_mm", bore), ("wheel_hub_mm", hub)):
        if radius >= end:
            raise GenevaError(
                f"{key} = {2.0 * radius:g}: the slots reach this diameter; it must be below "
                f"{2.0 * end:.6g}, or the roller smaller",
                ("size", key),
            )
    return bore, hub


def hub_about(size: Size, L: float, bore: float, end: float) -> float:
    """Return the radius of the wheel's hub about a bore; ``end`` is that of the slots' ends.

    Where a default hub would leave no wall around the bore there is none: it is the bore's.
    """
    wall = wall_min(size, L)
    bored, hub = wheel_reach_and_hub(size, bore, wall, end)
    return bore if size.wheel_hub_mm is None and hub < bored + wall else hub


def about_crank(size: Size, L: float) -> float:
    """Return the greater radius of the crank's bore and hub inside the arm, mm, 0 for none."""
    return max(0.5 * (size.crank_bore_mm or 0.0), crank_hub(size, L))


def crank_hub(size: Size, L: float) -> float:
    """Return the radius of the crank's hub inside the arm, mm; 0 unless the spec has one."""
    bore = 0.5 * (size.crank_bore_mm or 0.0)
    if not size.has_hub("crank"):
        return 0.0
    _, hub = crank_reach_and_hub(size, bore, wall_min(size, L))
    return hub if hub > bore else 0.0


def refuse_wide(key_: str, radius: float, inner: float, outer: float) -> None:
    """Raise GenevaError for a hub with flat faces that is too wide for its curved shell."""
    flat = math.sqrt((outer - inner) * (outer + inner))
    if radius >= flat:
        raise GenevaError(
            f"{key_} = {2.0 * radius:g}: a hub with flat faces this wide misses its shell, which "
            f"is {outer - inner:g} mm thick; it must be below {2.0 * flat:.6g}",
            ("size", key_),
        )
