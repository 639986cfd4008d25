"""Peaks and the angles where they occur, against roots found at 50 digits.

The program finds a peak as a root of the next derivative; the witness brackets on its own grid and
solves on its own formulas. Tables: the reference values of the theory notes (section 7).
"""

import math

import pytest
import repo
from agreement import quantities
from sampling import some
from witness import Geneva, near

from geneva_cli import load
from geneva_cli.motion.peak_search import search_peaks
from geneva_cli.motion.peaks import peaks, peaks_of

OFFSETS = (-0.9, -0.5, 0.0, 0.3, 0.6, 0.9, 0.99)
NAMES = ("velocity", "acceleration", "jerk", "power")

# 4e-15: a jerk comes out within 8 units in the last place of its peak, 8 * 2.2e-16, and a power is
# the product of two such; a peak is flat, so its angle adds nothing.
SIZE = 4e-15
# 1e-8 degrees: a root is found where the slope's own error, some 1e-15 of its size, hides it.
PLACE = 1e-8

# z, cos of the peak's angle, that angle in degrees, peak acceleration, jerk at mid-motion
EXTERNAL = """
3 0.996553622037419094304167261723 4.75821311826633434374527484246 31.3924284702813609901161808418 -672.017856668362194944324590252
4 0.980050660809410865234721636772 11.4637454313151650552225394085 5.40698103455192576862160455047 -48.0416305603426158296287083116
5 0.953341247550019990406238978527 17.5714443533723066993145026646 2.29882823962413395578841138815 -13.3241610374392728761770615911
6 0.92116460960662270618302869599 22.9030618658217381511681048948 1.34963727590190292442655173495 -6.0
8 0.851338135723071788652244342251 31.6424879611994721630111531726 0.699756984127683817470288333179 -2.24925462046267799288906279177
12 0.719283526906053374501884089027 44.004641266992458799016128311 0.347654992164151547150590140853 -0.80017832189612442801760311219
24 0.459227547480624029936556399621 62.6627262209543140900986419408 0.141601865606852714465743031775 -0.224496092418827729487947241155
"""  # noqa: E501
# z, R/L, peak velocity l/(1-l), acceleration tan(pi/z) and jerk 3 tan^2(pi/z) at entry
CONSTANTS = """
3 0.866025403784438646763723170753 6.46410161513775458705489268301 1.73205080756887729352744634151 9.0
4 0.707106781186547524400844362105 2.41421356237309504880168872421 1.0 3.0
5 0.587785252292473129168705954639 1.42591999815959135206554296613 0.726542528005360885895466757481 1.58359213500126182154495798761
6 0.5 1.0 0.577350269189625764509148780502 1.0
8 0.38268343236508977172845998403 0.619914404421775020511016076969 0.41421356237309504880168872421 0.514718625761429707189867654742
12 0.258819045102520762348898837624 0.349198186208549876473623237046 0.267949192431122706472553658494 0.21539030917347247767064390193
24 0.130526192220051591548406227895 0.150120901920355414479216410953 0.13165249758739585347152645741 0.0519971403629978130569371251439
"""  # noqa: E501


def every_other(A):
    """Half of the numbers of slots, in turn with A, so that each is there: odd from -0.9 on."""
    return range(3 + OFFSETS.index(A) % 2, 25, 2)


def rows(text):
    """The table as {z: the other columns}."""
    lines = [line.split() for line in text.strip().split("\n")]
    return {int(z): [float(n) for n in rest] for z, *rest in lines}


@pytest.mark.sampled(12)
@pytest.mark.parametrize("gearing", ["external", "internal"])
@pytest.mark.parametrize("A", OFFSETS)
def test_against_roots_at_50_digits(machine, gearing, A):
    for z in some(every_other(A), every_other(A)[::3]):
        m = machine(z, gearing, A)
        found, w = peaks(m.engagements[0]), Geneva(z, gearing, A)
        for name in NAMES:
            got = getattr(found, name)
            size, at_deg = w.peak(name)
            assert got.max == near(float(size), SIZE), (z, name)
            assert got.at_deg == pytest.approx(float(at_deg), rel=0.0, abs=PLACE), (z, name)
        _, _, acceleration, jerk, _ = (abs(float(v)) for v in w.at(-w.half_motion))
        assert found.ends.acceleration_entry == near(acceleration, SIZE), z
        assert found.ends.acceleration_exit == near(acceleration, SIZE), z
        # Two terms of unlike sign that can cancel: small against the peak is all it can be.
        small = SIZE * found.jerk.max
        assert found.ends.jerk_entry == pytest.approx(jerk, rel=0.0, abs=small), z
        assert found.ends.jerk_exit == pytest.approx(jerk, rel=0.0, abs=small), z


@pytest.mark.sampled(12)
@pytest.mark.parametrize("gearing", ["external", "internal"])
@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_none_is_missed_as_A_nears_1(machine, gearing, gap, sign):
    """All that happens happens within some gap of an end or of the middle."""
    A = sign * (1.0 - gap)
    for z in (3, 6, 24):
        m = machine(z, gearing, A)
        found, w = peaks(m.engagements[0]), Geneva(z, gearing, A)
        for k, name in enumerate(NAMES):
            got, (size, _) = getattr(found, name), w.peak(name)
            # near 180 degrees it is down to a million doubles wide, and exceeds what all have
            _, v, *more = w.derivatives(got.at_deg)
            excess = max(0.0, float(1 - abs((v, *more[:2], v * more[0])[k]) / size))
            assert got.max == near(float(size), SIZE + excess), (z, name)


@pytest.mark.parametrize("z", rows(EXTERNAL))
def test_table_external(machine, z):
    cos_at, at_deg, acceleration, jerk = rows(EXTERNAL)[z]
    ratio, velocity, entry, jerk_entry = rows(CONSTANTS)[z]
    m = machine(z)
    found = peaks(m.engagements[0])
    assert m.ratio == ratio  # correctly rounded
    assert found.velocity.max == near(velocity, SIZE)
    assert found.velocity.at_deg == 0.0
    assert found.acceleration.max == near(acceleration, SIZE)
    assert found.acceleration.at_deg == pytest.approx(-at_deg, abs=PLACE)
    assert math.cos(math.radians(found.acceleration.at_deg)) == pytest.approx(cos_at, abs=1e-15)
    assert found.jerk.max == near(-jerk, SIZE)
    assert abs(found.jerk.at_deg) <= PLACE
    assert found.ends.acceleration_entry == near(entry, SIZE)
    assert found.ends.jerk_entry == near(jerk_entry, SIZE)


@pytest.mark.parametrize("gearing", ["external", "internal"])
@pytest.mark.parametrize("z", [3, 4, 7, 10, 16, 60, 1000, 999_999])
def test_closed_forms_against_the_search(machine, gearing, z):
    """Both within 8 ulp of a peak; a place to the root of that, 1e-7 radians."""
    check_closed_forms(machine(z, gearing).engagements[0].motion, 4e-15)


def check_closed_forms(motion, close):
    found = search_peaks(motion, NAMES)
    for name, known in zip(NAMES, peaks_of(motion, NAMES), strict=True):
        assert known.max == near(found[name].max.item(), close), name
        assert known.at_deg == pytest.approx(found[name].at_deg.item(), abs=1e-5), name


def test_a_peak_beside_mid_motion(machine):
    """1e-14 of the motion beside it, on either side: at -/+1.223534258378942246e-12 degrees (root
    of the acceleration in 120 digits). Mid-motion is as high: the first of the two is told.
    To a unit in the last place of half the motion, 60 degrees."""
    m = machine(3, A=-1.0 + 1e-12, rollers=5)
    before, after = (peaks(s).velocity.at_deg for s in m.engagements[2:4])
    assert before == pytest.approx(-1.223534258378942246e-12, rel=0.0, abs=60.0 * 2.0**-52)
    assert after == 0.0


def test_peaks_at_a_speed():
    """60 rpm are 2 pi rad/s; six slots: velocity 1 and at entry tan 30° (the tables above)."""
    path = str(repo.DESIGNS / "side-crank-z6.toml")
    values = quantities(load(path, ["drive.A=0", "drive.n_rpm=60"]).mechanism)
    assert values["velocity.max_rad_s"] == pytest.approx(math.tau, rel=SIZE)
    entry = math.tan(math.pi / 6) * math.tau**2
    assert values["acceleration.entry_rad_s2"] == pytest.approx(entry, rel=SIZE)
