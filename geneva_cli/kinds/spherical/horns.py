"""The horns of spherical designs, one design after the other."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.horn import sphere_horn, sphere_stoutness
from geneva_cli.kinds.spherical.sizes import sized_ball
from geneva_cli.loads.strength.horn_search import HornStress
from geneva_cli.numerics.arrays import parameter
from geneva_cli.verdict.quantities.batch_designs import Designs
from geneva_cli.verdict.quantities.horns import Horns


class BallHorns(Horns):
    """The horns of spherical designs; no ball for a design without parts."""

    def __init__(self, of: Designs, balls: Sequence[Ball | None]) -> None:
        super().__init__(of, None)
        self.balls = balls

    @property
    def exist(self) -> bool:
        """True if a design has horns: a locking sector and its recesses."""
        return any(ball and ball.recess for ball in self.balls)

    def stress(self, width: float) -> HornStress:
        """The greatest stress under the roller, for a width of its contact."""
        rows = np.full((len(HornStress._fields), len(self.balls)), np.nan)
        widths = np.broadcast_to(np.ravel(width), len(self.balls))
        for i, (one, ball) in enumerate(zip(self.of.each, self.balls, strict=True)):
            angles = (ball.half_width, ball.recess, ball.axes) if ball else (0.0, 0.0, 0.0)
            rows[:, i] = sphere_horn(one, *angles, float(widths[i])) or np.nan
        return HornStress(*map(parameter, rows))

    def stoutness(self) -> tuple[float, float]:
        """A single design's greatest thickness at the mouth over the recess's radius, and that."""
        (ball,) = self.balls
        assert ball is not None  # without a lock there is no stress
        stout = sphere_stoutness(self.of.machine, ball.half_width, ball.recess, ball.axes)
        return stout, ball.radius_mm * math.sin(ball.recess)


def ball_horns(of: Designs) -> BallHorns | None:
    """Return the horns of spherical designs; None if no design has parts."""
    balls = [sized_ball(one) for one in of.each]
    return BallHorns(of, balls) if any(balls) else None
