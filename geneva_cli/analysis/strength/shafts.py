"""The shafts of wheel and crank, in torsion and bending, by the ASME code.

The Code for Design of Transmission Shafting (ASME, later ASA B17c-1927) goes by the greatest shear
stress, with factors for shock and fatigue on both moments:

    tau = 16/(pi d³) sqrt((Kb M)² + (Kt T)²)

Rotating shafts, load applied gradually: Kb = 1.5, Kt = 1; suddenly with minor shocks: 1.5 to 2 and
1 to 1.5; with heavy shocks: 2 to 3 and 1.5 to 3. Allowable is 0.3 of the yield strength or 0.18 of
the tensile strength, whichever is less, and three quarters of that beside a keyway. M is the force
on the shaft times its overhang, T the torque at the same moment: their greatest combination over
the cycle is exact.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.analysis.loads.forces import Row

if TYPE_CHECKING:
    from collections.abc import Callable

    from geneva_cli.analysis.loads.cycle import Cycle
    from geneva_cli.analysis.loads.instant import Instant
    from geneva_cli.numerics.jet import Coefficient
    from geneva_cli.spec.tables import Shaft

    Of = Callable[[Instant], Coefficient]


class Turned(NamedTuple):
    """A shaft under its cycle; None where what it needs is not known."""

    moment_Nm: float  # sqrt((Kb M)² + (Kt T)²), the greatest
    at_deg: float
    stress_MPa: float | None
    least_diameter_mm: float | None
    twist_deg: float | None  # over overhang and span, greatest


class Ends(NamedTuple):
    """One shaft as ``[shaft]`` gives it."""

    diameter_mm: float | None
    overhang_mm: float | None
    span_mm: float | None


def wheel_shaft(given: Shaft) -> Ends:
    """The wheel's."""
    return Ends(given.wheel_diameter_mm, given.wheel_overhang_mm, given.wheel_span_mm)


def crank_shaft(given: Shaft) -> Ends:
    """The crank's."""
    return Ends(given.crank_diameter_mm, given.crank_overhang_mm, given.crank_span_mm)


def shear_MPa(moment_Nm: float, diameter_mm: float) -> float:
    """Shear stress of a round shaft under an equivalent torque: 16 T/(pi d³).

    >>> round(shear_MPa(100.0, 20.0), 6)
    63.661977
    """
    return 16e3 * moment_Nm / (math.pi * diameter_mm**3)


def least_diameter_mm(moment_Nm: float, allowed_MPa: float) -> float:
    """The diameter at which that stress is the allowed one."""
    return math.cbrt(16e3 * moment_Nm / (math.pi * allowed_MPa))


def shaft(cycle: Cycle, ends: Ends, force: Of, torque: Of) -> Turned | None:
    """A shaft under a force and a torque that go with the cycle.

    None without an overhang or without a load; infinite moments are those of forces without a
    bound.
    """
    if ends.overhang_mm is None or not cycle.is_loaded:
        return None
    given = cycle.mechanism.spec.shaft
    lever = given.bending_factor * ends.overhang_mm / 1000.0

    def square(i: Instant) -> Row:
        bent, turned = force(i) * lever, torque(i) * given.torsion_factor
        return Row(bent * bent + turned * turned, i.grip)

    def twisting(i: Instant) -> Row:
        turned = torque(i)
        return Row(turned * turned, i.held)

    both, turned = cycle.extremes(square, twisting)
    moment, most = math.sqrt(both.max), math.sqrt(turned.max)
    d, allowed = ends.diameter_mm, given.shear_stress_max_MPa
    twist = None
    if d and ends.span_mm and math.isfinite(most):
        length = ends.overhang_mm + ends.span_mm
        twist = math.degrees(
            32.0 * most * length / (math.pi * d**4 * given.shear_modulus_GPa)
        )  # N m mm / (mm^4 GPa) = 1
    return Turned(
        moment,
        both.max_at_deg,
        None if d is None else shear_MPa(moment, d),
        None if allowed is None else least_diameter_mm(moment, allowed),
        twist,
    )
