"""Does the rim reach the roller: the first contact with a wheel at rest, in any kind of machine."""

import math

import pytest
import repo
from scipy.optimize import brentq

from geneva_cli import Design, External, Size
from geneva_cli.design import load
from geneva_cli.study.verdicts import headline

L, R, ROLLER, CLEARANCE = 60.0, 30.0, 3.0, 0.25
HALF_STEP = math.radians(30.0)
NAME = "hand_over_offset_mm"


def without_disc(rim: float | None) -> Design:
    size = Size(
        center_distance_mm=L,
        roller_radius_mm=ROLLER,
        slot_clearance_mm=CLEARANCE,
        process="print",
        lock_radius_mm=0.0,
        wheel_radius_mm=rim,
    )
    return Design(External(6, held_by="detent"), size=size)


def check_of(design: Design, name: str = NAME):
    return next(check for check in design.checks if check.name == name)


def at_the_corner(rim: float) -> tuple[float, float]:
    """Input angle and offset beyond the clearance where the roller meets the mouth's corner.

    The slot's axis touches the roller's circle at entry, so the offset from it is R (1 - cos).
    """
    half = ROLLER + CLEARANCE
    level = math.sqrt(rim * rim - half * half)
    # at rest the slot lies half a step below the line of centres, and its upper wall drives
    c, s = math.cos(HALF_STEP), -math.sin(HALF_STEP)
    corner = level * c - half * s, level * s + half * c

    def gap(a: float) -> float:
        return math.dist((L - R * math.cos(a), R * math.sin(a)), corner) - ROLLER

    entry = -math.radians(60.0)
    passes = entry + math.asin((L * math.cos(HALF_STEP) - level) / R)  # level with the corner
    a = brentq(gap, entry, passes)
    return math.degrees(a), R * (1.0 - math.cos(a - entry)) - CLEARANCE


@pytest.mark.sampled(3)
@pytest.mark.parametrize("rim", [36.0, 40.0, 45.0])
def test_the_roller_meets_the_corner_of_the_mouth(rim, no_advice):
    """Circle and corner by root search; 1e-6 is far more than the rounding of either."""
    check = check_of(without_disc(rim))
    assert (check.at_deg, check.value) == pytest.approx(at_the_corner(rim), abs=1e-6)


@pytest.mark.long
def test_the_least_rim_is_where_the_clearance_is_used_up(no_advice):
    """R (1 - cos x) = c after entry; there the roller is L cos b - R sin x along the slot."""
    x = math.acos(1.0 - CLEARANCE / R)
    along = L * math.cos(HALF_STEP) - R * math.sin(x)
    least = math.hypot(along, ROLLER + CLEARANCE)
    for rim in (None, least + 0.01):
        assert check_of(without_disc(rim)).value == 0.0
    # a tenth of a millimetre below, the offset grows with the square of what is missing
    assert 0.0 < check_of(without_disc(least - 0.5)).value < 0.1
    assert not check_of(without_disc(least - 0.5)).passes


@pytest.mark.long
@pytest.mark.parametrize(
    ("friction", "clearance", "state"),
    [
        (0.0, 1.0, ""),
        (0.0, 1.5, "warns"),
        (0.0, 3.0, "fails"),
        (0.1, 2.0, "warns"),
        (0.6, 1.5, "fails"),
    ],
)
def test_friction_limits_the_pressure_angle(friction, clearance, state, no_advice):
    """53.7, 63.4, 71.8 and 87.1 degrees against 90 - atan(mu): 73.3 by default, 84.3 and 59.0."""
    keys = [f"size.lock_clearance_mm={clearance}", f"load.friction={friction}"]
    design = load(str(repo.DESIGNS / "press-straight.toml"), keys)
    check = check_of(design, "hand_over_pressure_deg")
    assert check.limit == pytest.approx(90.0 - math.degrees(math.atan(friction or 0.3)))
    assert check.passes == (state != "fails")
    assert ("steep-hand-over" in {text.name for text in design.warnings}) == (state == "warns")


# a design, keys, and the fraction that the issue and the warning name
DRIVEN = [
    ("press-curved", [], 0.525),
    ("press-345", [], 0.520),
    ("sine-group", [], 0.519),
    ("press-curved", ["motion.alpha0_deg=30"], 0.378),
]


@pytest.mark.long
@pytest.mark.parametrize(("name", "keys", "driven"), DRIVEN)
def test_half_of_the_motion_must_be_driven(name, keys, driven, no_advice):
    design = load(str(repo.DESIGNS / f"{name}.toml"), keys)
    check = check_of(design, "driven_fraction")
    assert check.value == pytest.approx(driven, abs=0.0006)  # three digits
    assert check.passes == (driven > 0.5)
    _, text = headline(design.checks, design.warnings)
    percent = f"not positively driven during {100.0 * (1.0 - check.value):.3g} % of the motion"
    assert (percent in text) == check.passes
