"""Machines that two numbers make, against dense grids of both."""

import functools

import numpy as np
import pytest
from words import Drive, Keys, Spec, Wheel

from geneva_cli.motion.many import many
from geneva_cli.study.batches import columns
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search

pytestmark = pytest.mark.usefixtures("few_four_bars")
# Of a smooth least value a grid of 81 by 161 is short by the square of half a step, 1e-4 of what is
# between the ends; the search is nearer than that, and beside a bound to about as much.
NEAR = 1e-3


@functools.cache
def grid(z):
    """Side-cranks of all shafts: A and quantities, (n,) each."""
    axes, A = (
        x.ravel() for x in np.meshgrid(np.linspace(2, 178, 81), np.linspace(-0.98, 0.98, 161))
    )
    wheel = Wheel(z, "spherical", axes_deg=90.0)
    spec = Spec(wheel, Drive("side-crank"), Keys("side-crank", 0.1))
    found = many(spec, {"wheel.axes_deg": axes, "drive.A": A})
    names = ["acceleration.max", "timing.motion_deg", "velocity.max", "jerk.max"]
    return columns(found.machine, names, len(found.which))


def both(found):
    """The one row with a side-crank on inclined shafts."""
    (row,) = [row for row in found if row.candidate.of_two_numbers]
    return row


@pytest.mark.long
@pytest.mark.parametrize(
    ("z", "low", "high", "bound"),
    [
        (6, 100.0, 200.0, []),
        (6, 230.0, 240.0, ["velocity.max >= 0.5"]),
        (4, 230.0, 260.0, ["velocity.max <= 0.6", "jerk.max <= 2"]),
    ],
)
def test_no_dense_grid_of_two_numbers_finds_a_gentler_machine(z, low, high, bound):
    target = {"z": str(z), "spherical": True, "rollers": 1}
    found = search(read_target(**target, motion_deg=f"{low}..{high}", subject_to=tuple(bound))).rows
    peak, motion, velocity, jerk = grid(z)
    fits = (motion >= low) & (motion <= high)
    for text in bound:
        name, sign, number = text.split()
        value = velocity if name == "velocity.max" else jerk
        fits &= value >= float(number) if sign == ">=" else value <= float(number)
    assert fits.sum() > 20
    row = both(found)
    assert row.candidate.acceleration_max <= peak[fits].min() * (1 + NEAR)
    assert low <= row.candidate.motion_deg * (1 + 1e-12) and row.candidate.motion_deg <= high * (
        1 + 1e-12
    )
    # each of the numbers alone is worse, or keeps no bound
    others = [r.candidate for r in found if not r.candidate.of_two_numbers]
    assert all(c.acceleration_max > 1.01 * row.candidate.acceleration_max for c in others)
