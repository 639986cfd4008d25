"""Slit hubs: their form by shapely and trimesh, and the torque by a balance of forces."""

import math

import numpy as np
import pytest
import shapely
from drawing_witness import polygon

from geneva_cli import Design, External, Size
from geneva_cli.errors import GenevaError
from geneva_cli.parts.shafts.held_hubs import Clamp
from geneva_cli.parts.shafts.screws import screw

SIZE = {"wheel_hub_mm": 44.0, "wheel_bore_mm": 16.0, "wheel_clamp_mm": 5.0}


def design_of(**size):
    return Design(External(6), size=Size(wheel_hub_length_mm=12.0, **(SIZE | size)))


def test_the_hub_stays_within_its_circle():
    """A slit of 1.25 mm, and a notch 5 mm above it; head and hole leave half a thread around."""
    clamp = Clamp(screw("", 5.0), 8.0, 22.0)
    assert clamp.fits and (clamp.slit, clamp.face) == (1.25, 5.625)
    ring = shapely.Point(0.0, 0.0).buffer(22.0, 4000) - shapely.Point(0.0, 0.0).buffer(8.0, 4000)
    slit = shapely.box(0.0, -0.625, 30.0, 0.625)
    notch = shapely.box(clamp.shoulder, 5.625, 30.0, 30.0)
    form = polygon(clamp.outline, 1e-5)
    assert form.is_valid
    assert form.symmetric_difference(ring - slit - notch).area < 2e-3
    head = shapely.box(clamp.axis - 4.25, 5.625, clamp.axis + 4.25, 10.625)
    assert ring.buffer(1e-6).contains(head) and head.distance(form) == pytest.approx(0.0, abs=1e-9)
    hole = shapely.box(clamp.axis - 2.75, -30.0, clamp.axis + 2.75, 30.0)
    assert hole.distance(shapely.Point(0.0, 0.0).buffer(8.0)) >= 2.5


@pytest.mark.parametrize(("thread", "head"), [(3.0, 5.5), (5.0, 8.5), (8.0, 13.0)])
def test_the_heads_corner_is_on_the_hubs_circle(thread, head):
    """A head by ISO 4762 is as high as its thread; it stands in a notch of its own width."""
    clamp = Clamp(screw("", thread), 15.0, 50.0)
    corner = math.hypot(clamp.axis + 0.5 * head, clamp.face + thread)
    assert corner == pytest.approx(50.0, rel=1e-12)
    assert clamp.axis - clamp.shoulder == pytest.approx(0.5 * head)


@pytest.mark.parametrize("thread", [3.0, 5.0, 8.0])
def test_torque_by_a_balance(thread):
    """Forces and moments on one half: the screw pulls it, hinge and shaft hold it."""
    clamp = Clamp(screw("", thread), 15.0, 50.0)
    p = 32.5  # the middle of the wall opposite the slit
    # unknown: the hinge's force and the shaft's; their sum, and the moments about the shaft
    hinge, shaft = np.linalg.solve(
        [[1.0, 1.0], [-p, 0.0]], [clamp.force_N, clamp.force_N * clamp.axis]
    )
    assert hinge < 0.0 < shaft
    assert clamp.torque_Nm == pytest.approx(0.12 * shaft * 2.0 * 15.0 * 1e-3, rel=1e-12)
    # ISO 898-1 lists As of 5.03, 14.2 and 36.6 mm²
    assert clamp.force_N == pytest.approx(
        448.0 * {3.0: 5.03, 5.0: 14.2, 8.0: 36.6}[thread], rel=2e-3
    )


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("size", "said"),
    [
        ({"wheel_hub_mm": 30.0}, "wheel_clamp_mm = 5: the hub, 30 mm in diameter and 12 mm long"),
        ({"wheel_bore_mm": 1.25}, "holds a clamp screw up to 4"),  # the slit of M5 is as wide
        ({"wheel_keyway": "DIN 6885-1"}, "a hub with a round bore; remove wheel_keyway"),
        ({"wheel_screw_mm": 3.0}, "remove one of wheel_clamp_mm and wheel_screw_mm"),
        ({"wheel_clamp_mm": 4.5}, "there is no such metric screw"),
    ],
)
def test_refused(size, said):
    with pytest.raises(GenevaError, match=said):
        design_of(**size).drawing("wheel")
