"""Cam-Geneva: a fixed groove guides the roller along the crank, and the slots stay straight."""

import math
from typing import ClassVar

from geneva_cli.errors import GenevaError, refuse_text
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.given_motion import LawMotion, SolvedPath, SolvedPathSlot, shortened
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import larger, parameter
from geneva_cli.numerics.jet import Held, Jet, Loads, Vector, cross


class Cam(Drive, kw_only=True):
    """A fixed groove guides the roller along the crank.

    It needs a ``Motion``, whose law gives the shape of the groove. The slots stay straight and
    radial.

    >>> round(Design(External(6), Cam(), Motion(Cycloidal())).peaks.acceleration.max, 12)
    1.5
    """

    NAME: ClassVar[str] = "cam"
    WORDS: ClassVar[str] = "a crank whose roller runs in a cam"

    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        assert motion is not None  # ``compatible`` refuses a cam without a law
        if motion.ratio is not None:
            text = "ratio has no meaning with a cam, since the crank's length changes: remove ratio"
            raise GenevaError(text, ("motion", "ratio"))
        motion_deg = shortened(motion.alpha0_deg, 2.0 * wheel.half_motion_deg(wheel.step))
        # At input 0 the roller crosses the line of centres, and the wheel is half-way.
        early = motion.law.half_way * motion_deg
        turned = LawMotion(-early, motion_deg - early, wheel.step.b, motion.law)
        path, sign, V = SolvedPath(turned, wheel.SIGN), wheel.SIGN, turned(0.0, 1).c[1]
        text = "at mid-motion the law moves the wheel {V:.4g} times as fast as the crank: the "
        text += "factor must be above 0" + (" and below 1" if sign < 0 else "")
        refuse_text((V <= 0.0) | ((V >= 1.0) & (sign < 0.0)), ("motion", "law"), text, V=V)
        # the greatest angle of slot and crank: at 180 degrees they become parallel
        wide = radians(larger(-turned.entry_deg, turned.exit_deg)) + sign * turned.half_step
        text = "in {deg:.6g} deg of motion crank and slot become parallel before the end: "
        text += "increase alpha0_deg to shorten it"
        outside = (wide <= 0.0) | (wide >= math.pi)
        refuse_text(outside, ("motion", "alpha0_deg"), text, deg=turned.exit_deg - turned.entry_deg)
        body = -wheel.SIGN  # the roller slides along the crank and turns with it
        slot = SolvedPathSlot(path)
        engagement = Engagement(0.0, path, slot, turned, body, _slide, groove=path)
        ratio = parameter(path.crossing)
        return self.planned(engagement, ratio, L)


def _slide(turn: Jet, path: Vector, loads: Loads) -> Held:
    """Forces of each load on the crank's shaft, across its arm, and on the groove's wall."""
    x, y = path
    wall = y.derivative() * -1.0, x.derivative()
    arm = x.lower - 1.0, y.lower
    across = arm[1] * -1.0, arm[0]
    turning = cross(wall, across)
    out = []
    for force, _ in loads:
        push, hold = cross(wall, force) / turning, cross(force, across) / turning
        crank = across[0] * push, across[1] * push
        out.append((crank, (wall[0] * hold, wall[1] * hold)))
    return out
