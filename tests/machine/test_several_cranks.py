"""Several cranks about one wheel move it as rollers on one crank do: ``geneva explain rollers``.

The cranks stand at whole numbers of steps about the wheel. They are geared to one shaft and work in
turn, crank j after an j-th part of a turn. The program's machine is one crank with that many
rollers.
"""

import math

import numpy as np
import pytest

from geneva_cli import Crank, Design, External

# steps in a revolution, places of the cranks in steps, and the slots that they enter
MACHINES = [
    (6, (0, 3), (0, 2, 4)),
    (8, (0, 3), (0, 2, 4, 6)),
    (12, (0, 5), (0, 2, 4, 6, 8, 10)),
    (6, (0, 2), (0, 1, 2, 3, 4, 5)),
    (5, (0, 2), (0, 1, 2, 3, 4)),
    (4, (0, 2, 1), (0, 1, 2, 3)),
    (3, (0, 1, 2), (0,)),  # one slot, which each crank hands to the next
]


@pytest.mark.parametrize(("steps", "places", "slots"), MACHINES)
def test_each_pin_stays_in_a_slot_of_the_wheel(steps, places, slots):
    """Pins are placed about their own cranks by hand; the wheel's angle is the program's."""
    mechanism = Design(External(steps), Crank(rollers=len(places))).mechanism
    (engagement,) = mechanism.engagements
    assert mechanism.period_deg == 360.0 / len(places)
    step, l = math.tau / steps, mechanism.ratio
    x = np.linspace(engagement.entry_deg, engagement.exit_deg, 101)
    own = 1.0 - l * np.exp(-1j * np.radians(x))  # a crank turns against the wheel
    entered = set()
    for number in range(steps * len(places)):  # the cranks' turns and the wheel's end together
        place = places[number % len(places)]
        wheel = number * step + engagement.motion(x, 0).c[0]
        angles = np.angle(own * np.exp(1j * (step * place - wheel)))
        # steps from the slot at the wheel's angle 0; 1e-12: roundings of some turns, over a step
        off = angles / step - np.round(angles[0] / step)
        assert np.abs(off - steps * np.round(off / steps)).max() <= 1e-12
        entered.add(round(angles[0] / step) % steps)
        assert round(angles[0] / step) % steps == (place - number) % steps
    assert sorted(entered) == list(slots)


def test_the_discs_of_several_cranks_clear_the_wheel():
    """From each crank the recesses look alike, as do the reliefs of a disc at even phases.

    So the check of one crank with several rollers holds for the disc of each of several cranks.
    """
    assert Design(External(6), Crank(rollers=2)).passes
    assert Design(External(8), Crank(rollers=2)).passes
