"""A machine that is given by its crank radius is the one with the centre distance that follows."""

import math

import numpy as np
import pytest

from geneva_cli import (
    Cycloidal,
    Design,
    External,
    Internal,
    Motion,
    SideCrank,
    Size,
    Spherical,
)
from geneva_cli.errors import GenevaError
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.many import many
from geneva_cli.motion.registry import drive, gearing
from geneva_cli.motion.wheels.gearing import Gearing

R = 30.0
OFFSET = 8.0
# R/L by hand: the crank and its slot are perpendicular at entry, at half the step b
MACHINES: list[tuple[Gearing, Drive | None, Motion | None, float]] = [
    (External(6), None, None, 0.5),
    (Internal(5), None, None, math.sqrt(0.625 - math.sqrt(5.0) / 8.0)),  # sin 36 degrees
    (Spherical(6, axes_deg=60.0), None, None, math.sqrt(3.0) / 4.0),  # sin S sin b
    (gearing("linear")(6), None, None, 1.0),
    (External(4), SideCrank(A=0.5), None, math.sqrt(0.5)),
    (External(4), drive("carousel")(wheels=3), None, math.sqrt(0.5)),
    (External(6), None, Motion(Cycloidal(), ratio=0.4), 0.4),
    # the cycloid turns twice the mean, 60/120 degrees: v = 1, and R/L = v/(1 + v)
    (External(6), None, Motion(Cycloidal(), ratio="matched"), 0.5),
]


@pytest.mark.parametrize(("wheel", "own", "motion", "ratio"), MACHINES)
def test_the_centre_distance_follows_from_the_crank_radius(
    wheel: Gearing, own: Drive | None, motion: Motion | None, ratio: float
) -> None:
    design = Design(wheel, own, motion, size=Size(crank_radius_mm=R))
    L = design.mechanism.center_distance_mm
    assert pytest.approx(R / ratio, rel=1e-14) == L
    same = Design(wheel, own, motion, size=Size(center_distance_mm=L))
    assert design.peaks == same.peaks
    assert design.size.roller_radius_mm == same.size.roller_radius_mm


def test_an_offset_slot_is_tangent_to_the_crank_circle() -> None:
    """A tangent of the crank's circle at the angle a misses the wheel's axis by L cos a - R.

    That is e at one end of the motion and -e at the other, and the motion takes 180° - 2 b.
    """
    offset = Design(External(6, offset_mm=OFFSET), size=Size(crank_radius_mm=R))
    L = offset.mechanism.center_distance_mm
    ends = [math.degrees(math.acos((R + e) / L)) for e in (OFFSET, -OFFSET)]
    assert sum(ends) == pytest.approx(120.0, rel=1e-14)


def test_a_batch_has_the_distances_of_its_designs() -> None:
    spec = Design(External(6), size=Size(crank_radius_mm=R)).spec
    varied = {"wheel.offset_mm": np.array([0.0, 4.0, -8.0]), "wheel.z": np.array([6, 5, 4])}
    batch = many(spec, varied)
    assert batch.machine
    alone = [
        Design(
            External(int(z), offset_mm=float(e)), size=Size(crank_radius_mm=R)
        ).mechanism.center_distance_mm
        for e, z in zip(varied["wheel.offset_mm"], varied["wheel.z"], strict=True)
    ]
    assert batch.spread(batch.machine.center_distance_mm).tolist() == pytest.approx(
        alone, rel=1e-15
    )


def test_keys_that_agree_pass_and_others_name_both() -> None:
    for L in (60.0, 60.0001):  # R/L is off by less than a millionth
        both = Design(External(6), size=Size(crank_radius_mm=R, center_distance_mm=L))
        assert both.mechanism.center_distance_mm == L
    design = Design(Spherical(6), size=Size(crank_radius_mm=R, center_distance_mm=70.0))
    with pytest.raises(GenevaError, match=r"needs 0.5: .* = 35, or leave"):
        _ = design.mechanism
