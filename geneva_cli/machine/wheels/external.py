"""External wheels: radial slots, slots beside the wheel's centre, unequal steps."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar

from geneva_cli.errors import GenevaError, refuse
from geneva_cli.machine.example import Example
from geneva_cli.machine.layout import Dimension, Layout
from geneva_cli.machine.path_and_slot import AnchoredPath, Followed
from geneva_cli.machine.wheels import classic, poses
from geneva_cli.machine.wheels.gearing import Gearing, RollerPlace
from geneva_cli.machine.wheels.offset_slot import OffsetFollowed, OffsetSlot
from geneva_cli.machine.wheels.poses import HalfStep
from geneva_cli.machine.wheels.skew import room, skew
from geneva_cli.numerics.arrays import choose
from geneva_cli.spec.rules import LENGTH, Range

if TYPE_CHECKING:
    from geneva_cli.machine.engagement import Displacement, Slot


class External(Gearing):
    """The crank turns outside the wheel: less motion than dwell.

    ``z`` slots, 3 or more; ``offset_mm`` is the distance at which their axes miss the wheel's;
    ``steps_deg`` are unequal steps, a pattern that repeats over a turn.

    >>> Design(External(6)).timing.motion_deg
    120.0
    >>> Design(External(6, steps_deg=(72, 48))).timing.index_deg
    72.0
    """

    NAME: ClassVar[str] = "external"
    EXAMPLE: ClassVar[Example] = Example("an external wheel, straight slots", {"wheel": {"z": 6}})
    offset_mm: Annotated[
        float, LENGTH, "how far the slots' axes miss the wheel's centre; > 0 enters gently"
    ] = 0.0
    steps_deg: Annotated[
        tuple[float, ...] | None, Range(0.0, 360.0, "()"), "unequal steps, a repeating pattern"
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.steps_deg:
            refuse(
                self.offset_mm != 0.0,
                lambda: GenevaError(
                    "offset_mm with steps_deg: choose one of them", ("wheel", "offset_mm")
                ),
            )
            self._refuse_steps(self.steps_deg)

    def _refuse_steps(self, steps: tuple[float, ...]) -> None:
        """The pattern must close over the wheel."""
        z, key = self.z, ("wheel", "steps_deg")
        refuse(
            z % len(steps) != 0,
            lambda: GenevaError(
                f"z = {z} is no multiple of the pattern's {len(steps)} steps; "
                f"{_multiples(z, len(steps))} would be",
                key,
            ),
        )
        turn = math.fsum(steps) * z / len(steps)
        refuse(
            abs(turn - 360.0) > 1e-9,
            lambda: GenevaError(
                f"the pattern, {z // len(steps)} times over the wheel, adds up to {turn:.12g} deg; "
                f"it must be 360, so its steps {360.0 * len(steps) / z:.12g}",
                key,
            ),
        )
        if max(steps) >= 180.0:
            raise GenevaError(f"a step of {max(steps):g} deg is out of reach; below 180", key)

    @property
    def steps(self) -> tuple[float, ...]:
        """The repeating pattern of unequal steps, degrees; empty where all are equal."""
        return self.steps_deg or ()

    @property
    def skewed(self) -> bool:
        """Whether slots are not radial or not alike."""
        return True if self.steps_deg else self.offset_mm != 0.0

    def half_motion_deg(self, step: HalfStep) -> float:
        """Crank angle from entry to the line of centres: 90° - b."""
        return classic.half_motion_deg(self.SIGN, *step)

    @property
    def layout(self) -> Layout:
        """How far its slots miss the wheel's axis."""
        return (Dimension("slots' axes beside the wheel's", self.offset_mm, "mm"),)

    def place(self, step: HalfStep, center_distance_mm: float) -> RollerPlace:
        """A roller's passage; GenevaError where an offset slot cannot be entered without shock."""
        half = self.half_motion_deg(step)
        e = self.offset_mm / center_distance_mm
        if isinstance(e, float) and not e:
            return RollerPlace(step, half, poses.radial(self.SIGN, step), step.sin_cos[0])

        def error() -> GenevaError:
            # b + |d| < 90 degrees means |e| < 1 - l; at the limit e = cos b sin d, d = 90 deg - b
            limit = step.sin_cos[1] ** 2 * center_distance_mm
            return GenevaError(
                f"offset_mm = {self.offset_mm:g}: the roller cannot enter such a slot without "
                f"shock; its size must be below {limit:.6g}",
                ("wheel", "offset_mm"),
            )

        spare = room(step, e)
        refuse(spare <= 0.0, error)
        slot = skew(step, e, spare)
        return RollerPlace(step, half, slot.poses, slot.poses[2].slope[0], slot)

    def follow(
        self, path: AnchoredPath, place: RollerPlace, turn: Displacement
    ) -> tuple[Slot, Followed]:
        """A radial slot, or one beside the wheel's centre."""
        if place.skew is None:
            return super().follow(path, place, turn)
        slot = OffsetSlot(path, place.skew)
        return slot, OffsetFollowed(path, place.step.b, place.skew)

    def closed_form(self, place: RollerPlace) -> tuple[float, float, float] | None:
        """The closed forms of radial slots; None for others."""
        if place.skew is not None:
            return None
        return self.SIGN, place.step.sin_cos[0], classic.gap(1.0, *place.step)

    def matched_ratio(self, v: float) -> float:
        """psi1(0) = l/(1-l) f1(0), with f1 the transmission's ratio."""
        able = v > 0.0
        ratio: float = choose(able, v, math.nan) / (1.0 + choose(able, v, 0.0))
        return ratio


def _multiples(z: int, n: int) -> str:
    """The multiples of n on both sides of z that are numbers of slots."""
    near = [m for m in (z // n * n, (z // n + 1) * n) if m >= 3]
    return " or ".join(str(m) for m in near)
