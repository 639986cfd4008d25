"""The page of a rack: what its script computes."""

import json
import math

import numpy as np
import pytest
from test_page import ANGLE, PLACE, script_of

from geneva_cli import Design, Linear, Load, Size
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
    assert [state["words"] for state in data["states"]] == [
        "the roller moves the rack",
        "the rack rests, locked by the ring",
    ]


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
