"""The smallest wall of drawn wheels, against distances of circles and lines, and by brute force."""

import math

import numpy as np
import pytest
import shapely
from drawn_wheels import disc, drawn_wheel

from geneva_cli.extras.outline.walls import smallest_wall
from geneva_cli.geometry.plates import with_material_left


def test_walls_of_plain_wheels():
    """Between the round bottoms of slots at 60 degrees; a bore beside them; a horn at its mouth."""
    wheel = drawn_wheel(6, 30.0, 3.25, 45.0)
    assert smallest_wall([wheel])[0] == pytest.approx(30.0 - 6.5, abs=1e-9)
    bore = with_material_left(disc(0.0, 0.0, 20.0), False)
    assert smallest_wall([wheel, bore])[0] == pytest.approx(30.0 - 3.25 - 20.0, abs=1e-9)
    horned = drawn_wheel(6, 30.0, 3.25, 45.0, (60.0, 22.0))
    # from the recess's corner on the rim to the side of the slot
    opening = math.acos((60.0**2 + 45.0**2 - 22.0**2) / (2.0 * 60.0 * 45.0))
    horn = 45.0 * math.sin(math.pi / 6.0 - opening) - 3.25
    assert smallest_wall([horned])[0] == pytest.approx(horn, abs=1e-9)
    near = drawn_wheel(4, 20.0, 3.0, 45.0, (60.0, 38.0))  # the recess comes close to a slot's side
    least = 60.0 * math.sin(math.pi / 4.0) - 38.0 - 3.0
    assert smallest_wall([near])[0] == pytest.approx(least, abs=1e-9)


def test_a_wall_is_the_shortest_line_through_the_material():
    """Between random holes in a plate: no line from hole to hole, or to the edge, is shorter."""
    rng = np.random.default_rng(5)
    for _ in range(4):
        holes = []
        while len(holes) < 5:
            x, y, r = *rng.uniform(-30.0, 30.0, 2), rng.uniform(1.0, 6.0)
            if all(math.hypot(x - a, y - b) > r + s + 0.1 for a, b, s in holes):
                holes.append((x, y, r))
        plate = [disc(0.0, 0.0, 55.0)]
        plate += [with_material_left(disc(*hole), False) for hole in holes]
        rings = [shapely.Point(0.0, 0.0).buffer(55.0, 512).exterior]
        rings += [shapely.Point(x, y).buffer(r, 512).exterior for x, y, r in holes]
        apart = [a.distance(b) for i, a in enumerate(rings) for b in rings[:i]]
        assert smallest_wall(plate)[0] == pytest.approx(min(apart), abs=1e-3)
