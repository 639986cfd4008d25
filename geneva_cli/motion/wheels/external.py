"""External wheels, with radial slots, offset slots or unequal steps."""

import math
from typing import Annotated, ClassVar, Self

from geneva_cli.errors import GenevaError, refuse_text
from geneva_cli.motion.pivots import Dimension
from geneva_cli.motion.wheels.classic import HalfStep
from geneva_cli.motion.wheels.gearing import Gearing, RollerPlace
from geneva_cli.numerics.angles import sin_cos_pi
from geneva_cli.numerics.arrays import choose, library
from geneva_cli.spec.rules import LENGTH, Range


class External(Gearing):
    """The crank turns outside the wheel: less motion than dwell.

    ``z`` is the number of slots, 3 or more. ``offset_mm`` is the distance by which the slots' axes
    miss the wheel's axis. ``steps_deg`` are unequal steps, a pattern that repeats over a turn. With
    ``stop`` one recess is left convex, so that the crank is blocked after z - 1 turns.

    >>> Design(External(6)).timing.motion_deg
    120.0
    >>> Design(External(6, steps_deg=(72, 48))).timing.index_deg
    72.0
    """

    NAME: ClassVar[str] = "external"
    offset_mm: Annotated[
        float, LENGTH, "distance from the slots' axes to the wheel's; > 0 enters gently"
    ] = 0.0
    steps_deg: Annotated[
        tuple[float, ...] | None, Range(0.0, 360.0, "()"), "unequal steps, as a repeating pattern"
    ] = None
    stop: Annotated[bool, None, "a convex face in place of a recess stops the crank"] = False

    def __post_init__(self) -> None:
        super().__post_init__()
        steps, z, key = self.steps_deg, self.z, ("wheel", "steps_deg")
        offset = Dimension("slots' axes offset from the wheel's", self.offset_mm, "mm")
        skewed = bool(steps) or self.offset_mm != 0.0
        vars(self).update(steps=steps or (), stopped=self.stop, skewed=skewed, layout=(offset,))
        if not steps:
            return
        text, n = "offset_mm and steps_deg cannot be combined: remove one of them", len(steps)
        refuse_text(self.offset_mm != 0.0, ("wheel", "offset_mm"), text)
        text = "z = {z} is not a multiple of the {n} steps in the pattern: use {more}"
        refuse_text(z % n != 0, key, text, z=z, n=n, more=-(-z // n) * n)
        turn = math.fsum(steps) * z / n
        text = "{times} times the pattern is {turn:.12g} deg, not 360: its steps must add up to "
        values = {"times": z // n, "turn": turn, "whole": 360.0 * n / z}
        refuse_text(abs(turn - 360.0) > 1e-9, key, text + "{whole:.12g}", **values)
        if max(steps) >= 180.0:
            raise GenevaError(f"a step of {max(steps):g} deg is too large; below 180", key)

    @property
    def backwards(self) -> Self:
        steps = (self.steps[0], *self.steps[:0:-1]) if self.steps else None
        return self.replace(offset_mm=0.0 - self.offset_mm, steps_deg=steps)

    def place(self, step: HalfStep, center_distance_mm: float) -> RollerPlace:
        if isinstance(self.offset_mm, float) and not self.offset_mm:
            return super().place(step, center_distance_mm)

        from geneva_cli.motion.wheels.offset_slot import offset_place

        # cos² b - |e| is positive if there is such a slot. b + |d| < 90 degrees means |e| < 1 - l;
        # at the limit e = cos b sin d, d = 90 deg - b. The double angle is exact for 3, 4, 6 slots.
        e = self.offset_mm / center_distance_mm
        spare = 0.5 + 0.5 * sin_cos_pi(2 * step.p, step.q)[1] - abs(e)
        limit = step.sin_cos[1] ** 2 * center_distance_mm
        text = "offset_mm = {e_mm:g}: the roller cannot enter this slot without shock: its size "
        text += "must be below {limit:.6g}"
        refuse_text(spare <= 0.0, ("wheel", "offset_mm"), text, e_mm=self.offset_mm, limit=limit)
        return offset_place(step, e, spare)

    def as_built(self, ratio: float, rim: float, L: float) -> RollerPlace | None:
        if self.steps or self.stop:
            return None
        from geneva_cli.motion.wheels.as_built import place

        return place(self.SIGN, self.step, ratio, self.offset_mm / L, rim)

    def distance_mm(self, crank_radius_mm: float) -> float:
        if self.steps:
            text = "each of steps_deg has its own crank_radius_mm: set center_distance_mm instead"
            raise GenevaError(text, ("size", "crank_radius_mm"))
        sin_b, cos_b = self.step.sin_cos
        along, across = crank_radius_mm / sin_b, self.offset_mm / cos_b
        return choose(across == 0.0, along, library(along, across).hypot(along, across))
