"""Position, velocity, acceleration and jerk against 50 digits.

The bar, for z = 3..24 (for six of them in `make test`), both gearings, A = -0.9 to 0.99 and 200
angles each: the error is at most
8 units in the last place of that quantity's own peak, times max(1, condition number).

The input angle under test is the double in degrees itself, exactly. The condition number of a
quantity q at x is |x q'(x)| / max|q|: what one unit in the last place of x does to q, in units of
q's peak. It stays below 1.3 for a plain crank outside and 18 inside, and with A up to 0.3 below 27.
It grows where the side-crank lets the crank run away, near both ends as A nears 1: to 40 outside
(A = 0.99, jerk) and inside to 48 (A = 0.6), 220 (0.9) and 2400 (0.99: there 1e-15 of input moves
the velocity by 2e-12 of its peak). CONDITION below holds these figures, and the tests hold them
true.

The angle of entry is rounded to a double as well, which moves the whole motion by up to half a unit
in the last place of that angle, d: this adds |q'(x)| d / 2, whatever the method.
"""

import math

import numpy as np
import pytest
from sampling import some
from witness import Geneva, doubled, mp, near, to_radians

Z = some(range(3, 25), (3, 4, 5, 6, 12, 24))
NAMES = ("position", "velocity", "acceleration", "jerk")
# The greatest condition number of any quantity, by gearing and A.
CONDITION = {
    ("external", -0.9): 1,
    ("external", -0.5): 1,
    ("external", 0.0): 1.3,
    ("external", 0.3): 1.9,
    ("external", 0.6): 6.2,
    ("external", 0.9): 19.1,
    ("external", 0.99): 40,
    ("internal", -0.9): 1,
    ("internal", -0.5): 10.4,
    ("internal", 0.0): 18,
    ("internal", 0.3): 27,
    ("internal", 0.6): 48,
    ("internal", 0.9): 220,
    ("internal", 0.99): 2400,
}


def angles(engagement, witness):
    """200 input angles: even in the input, even in the crank's angle, the ends and the middle."""
    entry = engagement.entry_deg
    ends = [entry]
    for _ in range(3):  # within 1e-15 rad
        ends.append(math.nextafter(ends[-1], 0.0))
    ends += [entry * t for t in (1 - 1e-12, 1 - 1e-9, 1 - 1e-6, 1e-6, 1e-9, 1e-15)]
    even = np.clip(witness.angles(45), entry, 0.0)
    first = np.sort(np.concatenate([even, ends]))
    return np.concatenate([first, -first[::-1]])


@pytest.mark.sampled(16)
@pytest.mark.parametrize(("gearing", "A"), CONDITION)
def test_error_within_8_ulp_of_the_peak(engagement, gearing, A):
    over, largest = [], 0.0
    for z in Z:
        s, w = engagement(z, gearing, A), Geneva(z, gearing, A)
        x = angles(s, w)
        got = {
            "jets": s.motion(x, 3).derivatives(),
            "mirrored": s.motion.derivatives(x),
            "not mirrored": s.motion.derivatives(x[:-1]),
        }
        half = [w.derivatives(v) for v in x[:100]]
        # the witness is odd: Q(-x) is Q(x)'s mirror image; even derivatives change sign
        back = [[-v if k % 2 == 0 else v for k, v in enumerate(e)] for e in half[::-1]]
        exact = half + back
        entry_ulp = float(to_radians(math.ulp(s.entry_deg)))
        for k, name in enumerate(NAMES):
            peak = max(abs(float(e[k])) for e in exact)
            slope = np.array([abs(float(e[k + 1])) for e in exact])
            condition = np.abs(np.radians(x)) * slope / peak
            largest = max(largest, np.max(condition))
            # 8: what the program promises; half a unit of the entry angle: see above
            bar = 8.0 * math.ulp(peak) * np.maximum(1.0, condition) + slope * entry_ulp / 2.0
            high, low = doubled([e[k] for e in exact])
            for how, values in got.items():
                n = len(values[k])
                errors = np.abs((values[k] - high[:n]) - low[:n])
                for i in np.flatnonzero(~(errors <= bar[:n])):
                    over.append(
                        f"z={z} {name} ({how}) at {x[i]:.17g}: {errors[i] / math.ulp(peak):.2f} "
                        f"ulp, condition {condition[i]:.3g}"
                    )
    assert not over, f"{len(over)} of {len(Z) * 2400}:\n" + "\n".join(over[:40])
    assert 0.9 * CONDITION[gearing, A] < largest <= CONDITION[gearing, A]


@pytest.mark.parametrize("z", [3, 6, 24])  # their entry angles, 30°, 60°, 82.5°, are doubles
def test_just_after_entry_the_velocity_keeps_its_digits(engagement, z):
    s, w = engagement(z), Geneva(z)
    b = math.pi / z
    assert s.exit_deg == 90.0 * (z - 2) / z
    for tau in (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8):
        x = s.exit_deg - math.degrees(tau)
        with mp.workdps(80):  # the textbook formula cancels twice as many digits as tau has
            exact = Geneva(z).derivatives(x)
            since_rest = float(w.b - exact[0])
        ways = [
            s.motion(x, 1).derivatives(),
            s.motion(-x, 1).derivatives(),
            [v[0] for v in s.motion(np.array([x]), 1).derivatives()],
        ]
        ways.append([v[0] for v in s.motion.derivatives(np.array([-x]), (0, 1))])
        for wheel, velocity in ways:
            # Relative: 4 units of the velocity itself, as small as it is; 4 * 2.2e-16.
            assert velocity == near(float(exact[1]), 8.9e-16)
            # The wheel's angle is b less what is left to turn: half a unit of b for b itself,
            # half for the sum, one for what is left.
            assert abs((b - abs(wheel)) - since_rest) <= 2.0 * math.ulp(b)
