"""The first of two wheels in series: the plain machine that it is, on the second's crank shaft."""

import math

import numpy as np
import pytest
import repo

from geneva_cli import Design, External, GenevaPair, Load, Size, load
from geneva_cli.errors import GenevaError


@pytest.fixture(scope="module")
def pair():
    design = load(str(repo.DESIGNS / "geneva-pair.toml"))
    return design, design.parts.front


def test_it_is_a_plain_wheel_and_turns(pair):
    """Its outline is that of a machine of one wheel, which a whole turn shows to be free."""
    design, model = pair
    first = design.spec.drive
    L = first.first_distance_mm or design.mechanism.center_distance_mm
    plain = Design(
        External(first.first_z),
        size=Size(L, design.mechanism.roller_radius_mm, lock_radius_mm=model.outlines.sizes.lock),
    )
    assert design.drawing("first-wheel").shapes[0] == plain.drawing("wheel").shapes[0]
    assert design.judge("first-wheel") == ("", [])


def test_one_wheel_has_no_first():
    with pytest.raises(GenevaError, match='kind = "crank" has one wheel; geneva-pair has two'):
        Design(External(6)).drawing("first-wheel")


def pair_of(torque, L=100.0, first=100.0, **size):
    return Design(
        External(4),
        GenevaPair(first_z=4, first_distance_mm=first),
        size=Size(L, **size),
        load=Load(torque_Nm=torque),
    )


@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("first", [140.0])
def test_the_first_pair_by_hand(first):
    """Four slots on four, 5 N m on the wheel.

    At mid-motion the second roller pushes at L (1 - sin 45°) on the wheel, and at R = L sin 45° on
    its crank: T = 5 sin 45°/(1 - sin 45°). So the first one, at its own distance, on the first
    wheel. The horn's greatest stress is at the mouth, where the lever is L1 cos 45°; its section by
    a search. The crank is bent by the same force, at the distance of its hub.
    """
    design = pair_of(5.0, first=first)
    found = {check.name: check for check in design.checks}
    s = math.sin(math.pi / 4.0)
    torque = 5.0 * s / (1.0 - s)
    force = 1000.0 * torque / (first * (1.0 - s))
    rows = {row["name"]: row for row in design.part_table("parts").to_rows()}
    b, d = rows["first wheel"]["thickness_mm"], rows["first crank's pin"]["size_x_mm"]
    assert b == rows["first crank"]["thickness_mm"]
    bent = 32.0 * force * 0.5 * b / (math.pi * d**3)
    assert found["first_pin_stress_MPa"].value == pytest.approx(bent, rel=1e-12)
    front = design.parts.flat.front
    own = front.outlines.sizes
    r, R = own.half_width, own.recess
    h = first * s - r - R
    places = np.linspace(0.0, 0.99 * R, 200001)
    thick = h + R - np.sqrt(R * R - places**2)
    horn = 6.0 * 1000.0 * torque / (first * s) * (places / thick**2).max() / b
    assert found["first_horn_stress_MPa"].value == pytest.approx(horn, rel=1e-6)
    # the shaft: at mid-motion the greatest force, and the torque on the input
    bore = rows["first crank's shaft"]["size_x_mm"]
    far = 0.5 * b + b + 0.5 * b  # from the roller's middle to that of the frame, as thick
    moment = math.hypot(1.5 * force * far / 1000.0, torque * s / (1.0 - s))
    shear = 16e3 * moment / (math.pi * bore**3)
    assert found["first_crank_shaft_stress_MPa"].value == pytest.approx(shear, rel=1e-9)
    # the arm bears at least its bending beside the bore
    hub = front.mechanism.spec.size.arm_hub_mm
    leg = 6.0 * force * (first * s - 0.5 * bore) / (b * hub**2)
    assert leg < found["first_arm_stress_MPa"].value < 165.0
