"""What cannot be built: refused at the key's line, with the condition and the nearest that works.

Each case is a spec with a gap, ``@``, for the value that is wrong. Where the message names a bound,
the bound is tried: a millionth on its right side the machine is built, and on its wrong side not.
"""

import re
from typing import NamedTuple

import pytest
from words import load

from geneva_cli.errors import GenevaError

WHEEL = "[wheel]\nz = 6\n"
BALL = WHEEL + 'gearing = "spherical"\n'
INSIDE = WHEEL + 'gearing = "internal"\n'
LAW = '[motion]\nlaw = "cycloidal"\n'
STEPS = "steps_deg = [50, 70]\n"
ANGLES = "[drive]\nroller_angles_deg = "


def drive(kind, keys=""):
    return f'[drive]\nkind = "{kind}"\n{keys}'


GEARS = drive("elliptical-gears", "eccentricity = 0.2\n")
CAM = drive("cam")
PLANET = drive("epicyclic", "planet_ratio = 0.01\n")
FOUR_BAR = drive(
    "four-bar",
    "crank_mm = 40\nground_mm = 90\ncoupler_mm = 100\nrocker_mm = 100\n"
    "point_mm = 150\npoint_deg = -30\n",
)
SLIDER = drive(
    "slider-crank", "crank_mm = 40\nrod_mm = 120\npoint_mm = 200\npoint_deg = 20\nheight_mm = 10\n"
)
ORBIT = drive("carousel")
PAIR = drive("geneva-pair", "first_z = 3\n")
OWN_PATH = {"cam": CAM + LAW, "epicyclic": PLANET, "four-bar": FOUR_BAR}


class Case(NamedTuple):
    """A spec, the value that is wrong, its line, and what the message must hold."""

    spec: str
    wrong: str
    line: int
    wants: tuple[str, ...]


class Bound(NamedTuple):
    """A bound that a message names, and values that lie on either side of it."""

    spec: str
    wrong: str
    pattern: str
    side: float  # +1: what works is above


def case(name, spec, wrong, line, *wants):
    return pytest.param(Case(spec, wrong, line, wants), id=name)


def bound(name, spec, wrong, pattern, side):
    return pytest.param(Bound(spec, wrong, pattern, side), id=name)


SEVERAL = "[drive]\nrollers = 2\ncrank_steps = @\n"
TWO = "[drive]\nrollers = 2\ncrank_steps = [0, 3]\n"
BODY = '[[mass]]\nshape = "point"\nmass_kg = 1\n'

CASES = [
    # offset
    case("offset", WHEEL + "offset_mm = @", "80", 3, "offset_mm = 80", "shock", "below 75"),
    case("offset-law", WHEEL + "offset_mm = @\n" + LAW, "5", 3, "law", "remove"),
    case("tiny", WHEEL + "[load]\ninertia_kgm2 = @", "5e-324", 4, "below 1e-300 are not computed"),
    # step
    case("sum", WHEEL + "steps_deg = @", "[70, 60]", 3, "390", "not 360", "120"),
    case("out-of-reach", "[wheel]\nz = 3\nsteps_deg = @", "[80, 90, 190]", 3, "190", "below 180"),
    case("law", WHEEL + "steps_deg = @\n" + LAW, "[70, 50]", 3, "law", "remove"),
    case("rollers", WHEEL + STEPS + "[drive]\nrollers = @", "3", 5, "2 steps", "remove rollers"),
    case("angles", WHEEL + STEPS + ANGLES + "@", "[0, 100, 200]", 5, "2 steps", "as many angles"),
    # rollers
    case("close", WHEEL + ANGLES + "@", "[0, 90]", 4, "0 and 90", "120", "90 deg apart"),
    case("no-dwell", WHEEL + ANGLES + "@", "[0, 120, 240]", 4, "3 motions", "360", "dwell"),
    case("count", WHEEL + ANGLES + "[0, 150]\nrollers = @", "3", 5, "2 angles", "remove rollers"),
    # spherical
    case("axes-0", BALL + "axes_deg = @", "0", 4, "axes_deg = 0", "above 0"),
    case(
        "axes-of-a-flat-wheel", WHEEL + "axes_deg = @", "80", 3, 'gearing = "spherical"', "external"
    ),
    case("law", BALL + "[motion]\nlaw = @", '"cycloidal"', 5, "straight", "remove law"),
    # fronts
    case("e-near-1", WHEEL + GEARS.replace("0.2", "@"), "0.9999999999999", 5, "at most 1 - 1e-12"),
    case("rollers-law", WHEEL + GEARS + "rollers = @\n" + LAW, "2", 6, "slot", "rollers = 1"),
    # planets
    case("z", "[wheel]\nz = @\n" + PLANET, "5", 2, "z = 5", "3, 4 or 6"),
    case("rollers", WHEEL + PLANET + "rollers = @", "2", 6, "one roller"),
    # cams
    case("no-law", WHEEL + drive("@"), "cam", 4, "needs a law"),
    case("ratio", WHEEL + CAM + LAW + "ratio = @", "0.5", 7, "ratio has no meaning"),
    case("alpha0", WHEEL + CAM + LAW + "alpha0_deg = @", "120", 7, "above -240", "below 120"),
    case(
        "parallel", WHEEL + CAM + LAW + "alpha0_deg = @", "-180", 7, "300", "parallel", "increase"
    ),
    # links
    case("rollers", WHEEL + FOUR_BAR + "rollers = @", "2", 11, "one roller"),
    # slides
    case("all-round", WHEEL + SLIDER.replace("40", "@"), "115", 5, "crank_mm = 115", "below 110"),
    # noncircular
    case("neither", WHEEL + drive("@"), "noncircular-gears", 3, "needs A"),
    # sectors
    case("long", WHEEL + drive("gear-sector", "sector_deg = @"), "331", 5, "331", "at most 330"),
    # pairs
    case("first-2", WHEEL + drive("geneva-pair", "first_z = @"), "2", 5, "first_z = 2", "least 3"),
    case("rollers", WHEEL + drive("geneva-pair", "first_z = 3\nrollers = @"), "2", 6, "one roller"),
    case("internal", "[wheel]\nz = 4\ngearing = @\n" + PAIR, '"internal"', 2, "135", "60"),
    # cranks
    case("twice", WHEEL + SEVERAL, "[0, 0]", 5, "different"),
    case("inside", INSIDE + "[drive]\ncrank_steps = @\n", "[0, 3]", 5, "external"),
    case("angles", WHEEL + TWO + "roller_angles_deg = @", "[0, 150]", 6, "even turns", "remove"),
    case("tolerance", WHEEL + TWO + "[tolerance]\nlock_radius_mm = @", "0.1", 6, "remove it"),
    case("body", WHEEL + TWO + BODY + "radius_mm = @", "50", 9, "count to 2"),
    # carousels
    case("many", WHEEL + ORBIT + "wheels = @", "3", 5, "wheels = 3", "120 deg", "at most 2"),
    case("gears", WHEEL + ORBIT + "[support]\ngear_ratio = @", "2", 6, "remove it"),
]

# What no drive with a roller path of its own can turn.
CASES += [
    case(f"{kind}-{name}", text + spec, wrong, line, f'"{kind}"')
    for kind, spec in OWN_PATH.items()
    for name, text, wrong, line in (
        ("offset", WHEEL + "offset_mm = @\n", "5", 3),
        ("steps", WHEEL + "steps_deg = @\n", "[70, 50]", 3),
        ("spherical", WHEEL + "gearing = @\n", '"spherical"', 3),
        ("internal", WHEEL + "gearing = @\n", '"internal"', 3),
    )
    # with a law the law is what is in the way, and a cam drives an internal wheel
    if kind != "cam"
] + [
    case(f"{kind}-law", WHEEL + spec + "[motion]\nlaw = @", '"cycloidal"', line, "straight", kind)
    for kind, spec, line in (("epicyclic", PLANET, 7), ("four-bar", FOUR_BAR, 12))
]

OWN_ARM = PLANET.replace("0.01", "@")
SMALL = "[size]\ncenter_distance_mm = 37"
BELOW = r"below (\S+)"
BOUNDS = [
    bound("offset", WHEEL + "offset_mm = @", "80", BELOW, -1),
    bound("offset-L", WHEEL + "offset_mm = @\n" + SMALL, "30", BELOW, -1),
    bound("alpha0-high", WHEEL + CAM + LAW + "alpha0_deg = @", "200", BELOW, -1),
    bound("planet-high", WHEEL + OWN_ARM, "0.3", r"at most (\S+)", -1),
    bound("slider", WHEEL + SLIDER.replace("40", "@"), "115", r"it must be below (\S+)", -1),
]


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def built(spec, value):
    """The mechanism of a spec with its gap filled."""
    with open("spec.toml", "w", encoding="utf-8") as file:
        file.write(spec.replace("@", value))
    return load("spec.toml")


def refused(spec, value):
    """The message with which it is refused."""
    with pytest.raises(GenevaError) as caught:
        built(spec, value)
    return str(caught.value)


@pytest.mark.parametrize("wrong", CASES)
def test_refused_with_line_condition_and_value(wrong):
    said = refused(wrong.spec, wrong.wrong)
    assert said.startswith(f"spec.toml:{wrong.line}: "), said
    for want in wrong.wants:
        assert want in said
    assert len(said) < 400


@pytest.mark.parametrize("limit", BOUNDS)
def test_the_bound_in_a_message_is_the_bound(limit):
    said = refused(limit.spec, limit.wrong)
    named = float(re.search(limit.pattern, said).group(1).rstrip(",;."))
    step = limit.side * max(abs(named), 1.0) * 1e-6  # messages show six digits
    built(limit.spec, repr(named + 2.0 * step))
    refused(limit.spec, repr(named - 2.0 * step))


@pytest.mark.parametrize("offset", ["20", "-20"])
def test_a_pair_whose_first_wheel_still_rests_is_refused(offset):
    """Radial slots of 4 and 4 just do: offset ones are entered before the first wheel moves."""
    refused("[wheel]\nz = 4\noffset_mm = @\n" + PAIR.replace("3", "4"), offset)
