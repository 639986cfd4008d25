"""Bodies of a counter: its stations, each a pinion between two number wheels.

In the machine all stations lie above each other on two shafts. The page shows them apart, from the
driver on, in rows. In the first turn all number wheels go to 0 at once. After it each pinion moves
in one of as many turns as its number wheel has digits, times those of the wheels before it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from geneva_cli.geometry.measure import bounds
from geneva_cli.geometry.shapes import Circle, Shape
from geneva_cli.output.scene import Body, Track
from geneva_cli.study.animation.turn import MachineTurn


def stations(
    turn: MachineTurn, pinion: Sequence[Shape], teeth: Sequence[Shape], gear: Sequence[Shape]
) -> Iterator[Body]:
    """The pinions; the number wheels behind them; the driver, and the two teeth of each other.

    ``pinion``, ``teeth`` of a driver and ``gear`` of a number wheel are shapes in their own frames.
    """
    # a number wheel moves as far as the driver does in a motion
    digits = round(360.0 / turn.passages[0].engagement.motion_deg)
    pinion_angle = turn.wheel(turn.mechanism.wheel_places[0])
    wheel_angle = _number_wheel(turn, pinion_angle)
    mark = Circle("PITCH", (0.75 * turn.L * turn.mechanism.ratio, 0.0), 0.02 * turn.L)
    grey = [shape._replace(layer="GEAR") if shape.layer == "CRANK" else shape for shape in gear]
    places = _places(turn.mechanism.spec.wheel.pinions, turn.L, [*pinion], [*gear])
    for k, at in enumerate(places):
        yield Body(f"pinion {k + 1}", tuple(pinion), at, pinion_angle, every=digits**k)
    for k, (x, y) in enumerate(places):
        at = x + turn.L, y
        yield Body(f"number wheel {k + 2}", (*grey, mark), at, wheel_angle, every=digits**k)
        if k:
            name = f"teeth of number wheel {k + 1}"
            yield Body(name, tuple(teeth), at, wheel_angle, every=digits ** (k - 1))
        else:
            yield Body("driver", tuple(teeth), at, turn.crank())


def _number_wheel(turn: MachineTurn, pinion: Track) -> Track:
    """The angle of a number wheel that a pinion turns; both teeth point to it at mid-motion.

    It moves with the driver, as the driver moves the pinion by the ratio.
    """
    back = -1.0 / turn.passages[0].engagement.motion.jump
    values = tuple(math.pi + back * x for x in pinion.value)
    return Track(pinion.at, values, tuple(back * x for x in pinion.slope), back * pinion.gain)


def _places(
    count: int, L: float, pinion: list[Shape], gear: list[Shape]
) -> list[tuple[float, float]]:
    """The pinion axes of the stations, the first at 0, in about as many rows as columns."""
    left, right, high = (max(bounds(s).x1 for s in of) for of in (pinion, gear, gear))
    wide, tall = 1.05 * (left + L + right), 2.1 * high
    columns = math.ceil(math.sqrt(count))
    return [(k % columns * wide, -(k // columns) * tall) for k in range(count)]
