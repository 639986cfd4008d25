"""The stops of a crank on a page."""

from geneva_cli.kinds.stop.parts import wheel_stop
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.study.animation.animated_turn import MachineTurn
from geneva_cli.study.animation.turning_scene import WheelScene


class StopScene(WheelScene):
    """What a page shows of a wheel that may have a stop."""

    def stops(self, outlines: Outlines | None, turn: MachineTurn) -> tuple[float, float] | None:
        """Return both stops of the crank, degrees from the turn's start; None without."""
        stop = outlines and wheel_stop(outlines)
        if not stop:
            return None
        # input angle 0 of the drawings, after the middle of the first engagement
        drawn_deg = 360.0 * (turn.mechanism.spec.wheel.z // 2)
        return stop.first_deg - drawn_deg - turn.start, stop.last_deg - drawn_deg - turn.start
