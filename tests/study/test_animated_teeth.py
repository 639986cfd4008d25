"""Teeth of gears in the picture that moves: they mesh at every angle of the turn."""

import functools
import math

import numpy as np
import pytest
import repo
from sampling import some

from geneva_cli import Design, SideCrank, load
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.measure import at
from geneva_cli.output.scene import pose, value_at
from geneva_cli.study.animation.turning_scene import scene


@functools.cache
def points(outline):
    """Points of an outline, 8 on each of its pieces."""
    parts = np.linspace(0, 1, 9)[:-1].tolist()
    return np.array([complex(*at(piece, t)) for piece in outline.segments for t in parts])


def toothed(shown, t):
    """The outlines of all gears at an input angle of a scene, with their positions."""
    for body in shown.bodies:
        if "gear" in body.name:
            yield body.shapes, (*body.centre, value_at(body.angle, t))
    for bar in shown.bars:
        if bar.name == "planet's arm":
            yield bar.plates[-1].shapes, pose(bar, bar.plates[-1], t)


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "sets"),
    [
        ("epicyclic-z4", {}),
        ("epicyclic-z4", {"drive.fixed": "ring", "drive.planet_ratio": 0.05}),
        ("gear-sector", {}),
    ],
)
def test_teeth_mesh_through_the_turn(name, sets):
    spec = load(str(repo.DESIGNS / f"{name}.toml")).spec.with_("size.gear_module_mm", 2.0)
    for key, value in sets.items():
        spec = spec.with_(key, value)
    shown = scene(Design.of(spec.replace(drive_before=SideCrank(A=0.3, input_crank_mm=15.0))))
    ring = int(sets.get("drive.fixed") == "ring")
    assert not any(bar.radius for bar in shown.bars)
    assert "pitch circles" not in shown.caption
    least = math.inf
    for t in np.linspace(0.0, 360.0, some(25, 9)):
        both = list(toothed(shown, float(t)))
        (one, here), (other, there) = both[::-1] if ring else both
        seen = points(one[0]) * np.exp(1j * here[2]) + complex(*here[:2])
        own = (seen - complex(*there[:2])) * np.exp(-1j * there[2])
        # a ring's teeth are on its opening, in which the planet is
        gaps = Polyarc([other[ring]]).signed(np.column_stack((own.real, own.imag)))
        least = min(least, float(-gaps.max() if ring else gaps.min()))
    # 0.03 mm: twice the drawing's 0.01, and the error of the tracks; teeth without backlash touch
    assert abs(least) < 0.03


@pytest.mark.long
def test_teeth_that_do_not_fit_are_named():
    design = load(str(repo.DESIGNS / "behind-gears.toml"))
    wide = Design.of(design.spec.with_("size.gear_module_mm", 9.0))
    assert "Their teeth are not drawn: gear_module_mm = 9: the pitch curves" in scene(wide).caption
