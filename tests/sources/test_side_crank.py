"""Polyudov and Kandyak, "Kinematics of the Maltese cross mechanism with a side-crank drive".

Ukrainian Academy of Printing. The paper's figures are lost; the table is the exact curves that they
drew: invariants of external wheels of 4, 6 and 8 slots against A, roots at 30 digits, as printed in
section 4 of the theory notes. The ratios are the paper's own claims, and what they really are.
"""

import math

import pytest
from witness import near

from geneva_cli.motion.peaks import peaks

# z, A, motion angle (deg), peak velocity, peak acceleration and its angle, peak power and its
# angle, acceleration at entry
TABLE = """
4 0 90.0 2.414213562 5.406981035 -11.4637 10.01526592 -8.48357 1.0
4 0.1 98.109614 2.194739602 4.459536139 -12.6464 7.508108473 -9.35455 0.8719905897
4 0.2 106.2602 2.011844635 3.7412311 -13.8268 5.773162324 -10.2242 0.765625
4 0.3 114.49465 1.857087356 3.184030912 -15.0024 4.535052817 -11.0909 0.6750985658
4 0.4 122.85988 1.724438259 2.743368846 -16.171 3.62821117 -11.9535 0.5964009541
4 0.5 131.40962 1.609475708 2.38907013 -17.3303 2.949035761 -12.8103 0.5266522679
4 0.6 140.20818 1.508883476 2.100119776 -18.4784 2.430455006 -13.6602 0.4637025758
4 0.7 149.33617 1.420125625 1.861520937 -19.6134 2.027751794 -14.5019 0.405875922
4 0.8 158.8998 1.341229757 1.662341253 -20.734 1.710338708 -15.3343 0.351793471
4 0.9 169.04722 1.270638717 1.494460373 -21.8389 1.456815809 -16.1564 0.3002345225
4 0.95 174.40477 1.238058237 1.420279341 -22.3853 1.349059237 -16.5632 0.2750301872
6 0 120.0 1.0 1.349637276 -22.9031 0.9903300335 -16.0653 0.5773502692
6 0.1 129.93637 0.9090909091 1.112700768 -25.5868 0.7399542847 -17.8445 0.5234856792
6 0.2 139.94844 0.8333333333 0.9331343689 -28.2665 0.5674199974 -19.6159 0.4758204169
6 0.3 150.11729 0.7692307692 0.7938002997 -30.906 0.4447906139 -21.3661 0.4325379125
6 0.4 160.5358 0.7142857143 0.683535275 -33.4664 0.3553283512 -23.0819 0.3922600293
6 0.5 171.31781 0.6666666667 0.594837271 -35.9098 0.2885953815 -24.7512 0.3538502292
6 0.6 182.61289 0.625 0.522529823 -38.2055 0.2378557915 -26.3635 0.3162636762
6 0.7 194.63305 0.5882352941 0.462955657 -40.3355 0.1986315207 -27.9111 0.2783956067
6 0.8 207.70756 0.5555555556 0.4134706956 -42.299 0.1678667562 -29.3888 0.2388614508
6 0.9 222.41553 0.5263157895 0.3721171831 -44.1123 0.143427279 -30.7949 0.1955475659
6 0.95 230.71685 0.5128205128 0.3540112026 -44.9718 0.1330859389 -31.4713 0.1713461154
8 0 135.0 0.6199144044 0.6997569841 -31.6425 0.3063045924 -21.2088 0.4142135624
8 0.1 145.602 0.5635585495 0.5800104085 -36.053 0.2285512533 -23.7519 0.3841205922
8 0.2 156.29614 0.516595337 0.488922248 -40.6058 0.1750541923 -26.286 0.3565211928
8 0.3 167.18202 0.4768572342 0.4176934732 -45.198 0.1370746431 -28.7733 0.3305117028
8 0.4 178.37596 0.4427960032 0.3606134189 -49.6538 0.1093946782 -31.1747 0.3053304433
8 0.5 190.0247 0.4132762696 0.3139053857 -53.6983 0.08877191613 -33.4535 0.2802485199
8 0.6 202.32884 0.3874465028 0.2750966188 -57.0025 0.07312096355 -35.58 0.2544534208
8 0.7 215.58887 0.364655532 0.2426390358 -59.3827 0.06105880199 -37.5359 0.2268709869
8 0.8 230.31023 0.3443968913 0.2155756833 -60.986 0.05164201111 -39.3179 0.1957931454
8 0.9 247.50453 0.3262707392 0.1932154786 -62.1727 0.04420984002 -40.9374 0.1578380574
8 0.95 257.72884 0.3179048228 0.1836044973 -62.7206 0.04108432576 -41.6931 0.1339337633
"""
ROWS = [line.split() for line in TABLE.strip().split("\n")]


def printed(text):
    """The number, and half a unit of its last printed digit: the table is rounded, not cut."""
    digits = len(text.split(".")[1])
    return pytest.approx(float(text), rel=0.0, abs=0.5000001 * 10.0**-digits)


def all_of(machine, z, A):
    m = machine(z, A=A)
    return m.engagements[0], peaks(m.engagements[0])


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"z{row[0]}-A{row[1]}")
def test_table(machine, row):
    z, A, motion, velocity, acceleration, a_deg, power, p_deg, entry = row
    engagement, found = all_of(machine, int(z), float(A))
    assert engagement.motion_deg == printed(motion)
    assert found.velocity.max == printed(velocity)
    assert found.velocity.at_deg == 0.0
    assert found.acceleration.max == printed(acceleration)
    assert found.acceleration.at_deg == printed(a_deg)
    assert found.power.max == printed(power)
    assert found.power.at_deg == printed(p_deg)
    assert found.ends.acceleration_entry == printed(entry)


@pytest.mark.parametrize("A", [-0.5, 0.3, 0.6, 0.99])
def test_equation_1_motion_angle_and_offset(engagement, A):
    """A = sin((phi_s1 - phi_s2)/2) / sin(phi_s2/2), with phi_s2 = pi - 2 pi/z."""
    for z in range(3, 25):
        s1, s2 = math.radians(engagement(z, A=A).motion_deg), math.pi - 2.0 * math.pi / z
        # 1e-15 absolute: the difference of two angles below 2 pi, each rounded
        offset = math.sin((s1 - s2) / 2.0) / math.sin(s2 / 2.0)
        assert offset == pytest.approx(A, abs=4e-15), z


def ratios(machine, A):
    plain, slow = (all_of(machine, 6, a)[1] for a in (0.0, A))
    return [
        plain.velocity.max / slow.velocity.max,
        plain.acceleration.max / slow.acceleration.max,
        plain.power.max / slow.power.max,
    ]


def test_misprint_ratios_at_0_6_for_6_slots(machine):
    """The paper says 1.58, 2.8 and 4.4 at A = 0.6; they are 1.600, 2.583 and 4.164."""
    assert ratios(machine, 0.6) == pytest.approx([1.600, 2.583, 4.164], abs=5e-4)
    for ours, theirs in zip(ratios(machine, 0.6), (1.58, 2.8, 4.4), strict=True):
        assert abs(ours / theirs - 1.0) > 0.01


def test_1_58_is_the_ratio_at_a_motion_of_180_degrees(machine):
    """1.58 = 1 + 1/sqrt(3), exact for phi_s1 = 180°, that is A = 1/sqrt(3)."""
    A = 1.0 / math.sqrt(3.0)
    engagement, _ = all_of(machine, 6, A)
    assert engagement.motion_deg == pytest.approx(180.0, abs=1e-13)
    velocity, acceleration, power = ratios(machine, A)
    assert velocity == near(1.0 + A, 2e-15)
    assert [velocity, acceleration, power] == pytest.approx([1.577, 2.510, 3.990], abs=5e-4)
    assert abs(1.58 * 2.8 - 4.4) < 0.05  # the third is the product of the others


@pytest.mark.parametrize("z", [3, 4, 6, 12, 24])
@pytest.mark.parametrize("A", [-0.9, -0.5, 0.6, 0.99])
def test_closed_forms(machine, z, A):
    """Peak velocity l/((1-l)(1+A)) and entry tan b [cos h/(cos h + A sin b)]², sin h = A cos b."""
    _, found = all_of(machine, z, A)
    b = math.pi / z
    l, h = math.sin(b), math.asin(A * math.cos(b))
    # 1e-13: the closed form as it stands here, 1 - l and cos h, cancels at z = 3 and A = 0.99
    assert found.velocity.max == near(l / ((1.0 - l) * (1.0 + A)), 1e-13)
    f1 = math.cos(h) / (math.cos(h) + A * math.sin(b))
    assert found.ends.acceleration_entry == near(math.tan(b) * f1**2, 1e-13)


@pytest.mark.parametrize("z", [4, 6, 8])
def test_as_A_nears_1_the_crank_turns_at_half_speed(machine, z):
    """A -> 1: velocity/2, acceleration/4, power/8, twice the motion angle."""
    A = 1.0 - 1e-9
    plain_engagement, plain = all_of(machine, z, 0.0)
    engagement, slow = all_of(machine, z, A)
    # 1e-4: with phi = 2 f but for an angle of some sqrt(1 - A)
    assert engagement.motion_deg == near(2.0 * plain_engagement.motion_deg, 1e-4)
    assert plain.velocity.max / slow.velocity.max == near(2.0, 1e-4)
    assert plain.acceleration.max / slow.acceleration.max == near(4.0, 1e-4)
    assert plain.power.max / slow.power.max == near(8.0, 1e-4)
