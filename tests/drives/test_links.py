"""Links of the drives at any input angle: rigid, on their pivots, and carrying the roller."""

import numpy as np
import pytest
import repo

from geneva_cli import load
from geneva_cli.motion.pivots import Joint, Pivot

# of a linkage's own lengths, some hundred mm: rounding of a few sines
NEAR = 1e-11
DESIGNS = ("side-crank-z6", "four-bar-z4", "slider-crank", "epicyclic-z4", "geneva-pair")


@pytest.fixture(params=DESIGNS)
def machine(request):
    return load(str(repo.DESIGNS / f"{request.param}.toml")).mechanism


def links_at(machine, input_deg):
    return machine.spec.drive.links(machine.plan, machine.spec.wheel.SIGN, input_deg)


def links(machine, input_deg):
    return {link.name: link.joints for link in links_at(machine, input_deg)}


def test_bars_keep_their_length(machine):
    turn = np.linspace(-180.0, 180.0, 97)
    for link in links_at(machine, turn):
        assert len(link.kinds) == len(link.joints)
        rigid = [
            joint
            for joint, kind in zip(link.joints, link.kinds, strict=True)
            if kind is not Joint.SLIDE  # which goes along it
        ]
        for (x, y), (u, v) in zip(rigid, rigid[1:], strict=False):
            length = np.hypot(u - x, v - y)
            assert np.ptp(length) < NEAR, link.name


def test_joints_at_input_0_are_the_pivots_of_the_list(machine):
    at = links(machine, np.zeros(1))
    places = {(round(float(x[0]), 9), round(float(y[0]), 9)) for j in at.values() for x, y in j}
    layout = machine.spec.drive.layout(machine.plan, machine.spec.wheel.SIGN)
    own = {(round(p.x_mm, 9), round(p.y_mm, 9)) for p in layout if isinstance(p, Pivot)}
    off = {"slider's line, foot", "slider's line, ahead"}  # any two points of the line
    assert own - places <= {
        (round(p.x_mm, 9), round(p.y_mm, 9))
        for p in layout
        if isinstance(p, Pivot) and p.name in off
    }


def test_the_roller_is_where_the_links_carry_it(machine):
    """Against the path of the engagement, which the motion comes from."""
    engagement, L = machine.engagements[0], machine.center_distance_mm
    at = np.linspace(engagement.entry_deg, engagement.exit_deg, 41)
    x, y = (L * c.c[0] for c in engagement.path(at, 0))
    found = links(machine, at)
    if "coulisse" in found:  # the crank's direction, whose length is not the pin's
        px, py = found["coulisse"][1]
        assert np.abs(np.sin(np.arctan2(py, px - L) - np.arctan2(y, x - L))).max() < 1e-14
    elif "first crank" in found:  # the first wheel is driven along the line from its axis
        px, py = found["first crank"][1]
        assert np.abs(np.sin(np.arctan2(py, px - L) - np.arctan2(y, x - L))).max() < 1e-14
    else:
        (carrier,) = [found[n] for n in ("coupler", "rod", "planet's arm") if n in found]
        px, py = carrier[-1]
        assert np.abs(np.hypot(px - x, py - y)).max() < NEAR
