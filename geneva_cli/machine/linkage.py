"""What the drives with a roller path of their own share: the wheel that fits the path."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

from geneva_cli.errors import GenevaError
from geneva_cli.machine import wheel_for_path as path_wheel
from geneva_cli.machine.drives import Plan
from geneva_cli.machine.wheels import poses as gearing
from geneva_cli.numerics import digits
from geneva_cli.numerics.jet import Coefficient, Jet, atan2, sin_cos
from geneva_cli.spec.tables import Size, Spec

LENGTHS = 1e4  # the longest link over the shortest: beyond, the path is a point or rounding


def refuse_proportions(**lengths: float) -> None:
    """Raise GenevaError for links so unlike in length that no wheel can be solved for."""
    name = max(lengths, key=lengths.__getitem__)
    limit = LENGTHS * min(lengths.values())
    if lengths[name] > limit:
        raise GenevaError(
            f"{name} = {lengths[name]:g}: links differ by more than {LENGTHS:g} times; it must be "
            f"at most {limit:g}",
            ("drive", name),
        )


def exact_point(reach_mm: float, angle_deg: float) -> tuple[Decimal, Decimal]:
    """A point's places along a line and aside, to 50 digits, from its distance and angle."""
    with localcontext(digits.FIFTY):
        sine, cosine = digits.sin_cos(digits.of_degrees(angle_deg))
        return Decimal(reach_mm) * cosine, Decimal(reach_mm) * sine


def plan_on(spec: Spec, path: path_wheel.Path, entry_deg: float | None) -> Plan:
    """The station of the wheel that a closed roller path can drive.

    Of several wheels the gentlest is taken, or the one entered nearest to ``entry_deg``. Raises
    GenevaError where none fits, or where the spec sets the centre distance, which follows.
    """
    if spec.size.center_distance_mm != Size().center_distance_mm:
        raise GenevaError(
            f'center_distance_mm follows from the linkage of kind = "{spec.drive.kind}"; remove it',
            ("size", "center_distance_mm"),
        )
    step = gearing.Step(1, spec.wheel.z)
    found = path_wheel.fits(path, step)
    if not found:
        raise GenevaError(
            f"no wheel of z = {spec.wheel.z} slots fits this path: no two of its tangents meet at "
            f"{360.0 / spec.wheel.z:.6g} deg, equally far away, with the roller nearer than that "
            "all the way between and farther on the way back; change the linkage, or z",
            ("drive", "kind"),
        )
    fit = found[0]
    if entry_deg is not None:
        wanted = math.radians(entry_deg)
        fit = min(found, key=lambda f: abs(math.remainder(float(f.entry) - wanted, math.tau)))
    station, L = path_wheel.station(path, fit, step)
    middle = float((fit.entry + fit.exit) / 2)

    def turning(tau: Coefficient, order: int) -> Jet:
        x, y = path.link(*sin_cos(Jet.variable(tau + middle, order + 1)))
        return atan2(y, x).derivative() * fit.sense

    station.body = turning
    x, y = station.pin(0.0, 0)
    reach = math.hypot(1.0 - x.c[0], y.c[0])
    return Plan(station, reach, spec.size._replace(center_distance_mm=L))
