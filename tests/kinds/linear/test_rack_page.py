"""The page of a rack: what its script computes."""

import json
import math

import numpy as np
import pytest
from test_page import ANGLE, PLACE, script_of

from geneva_cli import Design, EllipticalGears, Linear, Load, Size
from geneva_cli.geometry.measure import bounds
from geneva_cli.output import page
from geneva_cli.study.animation.turning_scene import scene

SIZE = Size(center_distance_mm=50.0, roller_radius_mm=6.0)


RACK = Design(Linear(6), size=SIZE, load=Load(mass_kg=4.0, force_N=30.0))


def test_a_rack_travels_as_the_roller_does_across_its_slots():
    """At a from mid-motion it is R sin a from its middle, and 2 R further after each turn."""
    engine, data = script_of("".join(page.chunks(scene(RACK))))
    at = np.linspace(0.0, 359.9, 73)
    ask = f"{at.tolist()}.map(t => afterTurns(scene.bodies[0].travel, t, 2))"
    travel = np.array(json.loads(engine.eval(f"JSON.stringify({ask})")))
    expected = 50.0 * np.sin(np.radians(np.minimum(at, 180.0) - 90.0)) + 2.0 * 100.0
    assert np.abs(travel - expected).max() < 50.0 * ANGLE
    ask = f"{at[:36].tolist()}.map(t => valueAt(scene.rollers[0][1], t))"
    roller = np.array(json.loads(engine.eval(f"JSON.stringify({ask})")))
    assert np.abs(roller - expected[:36] + 200.0).max() < PLACE * data["size"]
    assert [state[3] for state in data["states"]] == [
        "the roller moves the rack",
        "the rack rests, locked by the ring",
    ]


def test_all_slots_of_a_rack_pass_between_its_ends():
    """Before the first end and after the last one there is no slot at the roller's height."""
    for z in (3, 4, 7):
        _, data = script_of("".join(page.chunks(scene(RACK.with_("wheel.z", z)))))
        low, high = data["stops"]
        assert high - low == 360.0 * z
        box = bounds(RACK.with_("wheel.z", z).drawing("wheel").shapes[0])
        beyond = 2.0 * 50.0 - 6.0  # from the last slot to the rack's end
        assert -low / 3.6 == pytest.approx(box.y1 - beyond, abs=1e-9)
        assert high / 3.6 - 100.0 == pytest.approx(-box.y0 - beyond, abs=1e-9)


def test_the_force_on_a_rack_is_along_its_travel():
    """At entry m R w² and F push it forwards; without F it is braked past mid-motion."""
    w = 2.0 * math.pi
    for force_N in (30.0, 0.0):
        (push,) = scene(RACK.with_("load.force_N", force_N)).pushes
        assert not any(push.force_x)
        for t, force in zip(push.at, push.force_y, strict=True):
            exact = 4.0 * 0.05 * w * w * math.cos(math.radians(t)) + force_N
            assert force == pytest.approx(exact, abs=1e-4)
        wall = np.sign(push.force_y) * 6.0  # the roller touches the wall that it pushes
        middle = -50.0 * np.cos(np.radians(push.at))
        assert np.abs(np.array(push.y) - middle - wall)[np.abs(push.force_y) > 1e-6].max() < 1e-6


def test_gears_move_a_rack_on_a_page_too():
    geared = Design(Linear(6), EllipticalGears(eccentricity=0.3))
    assert [b.name for b in scene(geared).bodies] == [
        "wheel",
        "crank",
        "driver gear",
        "driven gear",
    ]
