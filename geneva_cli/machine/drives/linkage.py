"""What the linkages share: the roller on a closed path, and the wheel that fits it."""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass
from decimal import Decimal, localcontext
from typing import TYPE_CHECKING, Annotated, ClassVar

from geneva_cli.errors import GenevaError
from geneva_cli.machine import wheel_for_path
from geneva_cli.machine.drives.drive import Plan
from geneva_cli.machine.drives.pin_path import PinPath
from geneva_cli.machine.wheel_for_path import Path
from geneva_cli.numerics import digits
from geneva_cli.spec.rules import Range
from geneva_cli.spec.tables import DISTANCE_MM

if TYPE_CHECKING:
    from geneva_cli.machine.spec import Spec

LENGTHS = 1e4  # the longest link over the shortest: beyond, the path is a point or rounding


@dataclass(frozen=True, kw_only=True)
class Linkage(PinPath):
    """A linkage whose wheel's centre is not given but solved for.

    Its crank is no disc about the line of centres, so it carries no locking disc.
    """

    LOCKS: ClassVar[bool] = False
    entry_deg: Annotated[
        float | None, Range(-360.0, 360.0), "crank angle near entry, where several wheels fit"
    ] = None

    def may_vary(self, table: str, key: str) -> bool:
        """The wheel is searched for, one machine after the other: only what is no part of that."""
        return table not in ("wheel", "drive") or key == "n_rpm"

    @property
    @abstractmethod
    def roller_path(self) -> Path:
        """The roller's path about the crank's axis."""

    def plan(self, spec: Spec) -> Plan:
        """The one engagement of the wheel that the path can drive.

        Of several wheels the gentlest is taken, or the one entered nearest to ``entry_deg``.
        Raises GenevaError where none fits, or where the spec sets the centre distance, which
        follows.
        """
        if spec.size.center_distance_mm not in (None, DISTANCE_MM):
            raise GenevaError(
                f'center_distance_mm follows from the linkage of kind = "{self.NAME}"; remove it',
                ("size", "center_distance_mm"),
            )
        step, path = spec.wheel.step, self.roller_path
        found = wheel_for_path.fits(path, step)
        if not found:
            raise GenevaError(
                f"no wheel of z = {spec.wheel.z} slots fits this path: no two of its tangents meet "
                f"at {360.0 / spec.wheel.z:.6g} deg, equally far away, with the roller nearer than "
                "that all the way between and farther on the way back; change the linkage, or z",
                ("drive", "kind"),
            )
        fit = found[0]
        if self.entry_deg is not None:
            wanted = math.radians(self.entry_deg)
            fit = min(found, key=lambda f: abs(math.remainder(float(f.entry) - wanted, math.tau)))
        engagement, L = wheel_for_path.engagement(path, fit, step)
        x, y = engagement.path(0.0, 0)
        return self.planned(engagement, math.hypot(1.0 - x.c[0], y.c[0]), L)


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
