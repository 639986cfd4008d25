"""What a motion leaves of a swing: against closed forms and integrals in 60 digits.

Each law is its acceleration or velocity as c e^(i k u) on pieces, or a polynomial; textbook forms
are 0/0 where k is the swing's own rate, and there the rate is moved by 1e-30, which 60 digits bear.
"""

import mpmath
import numpy as np
import pytest
from test_vibration_machines import of_law, shares
from words import law

from geneva_cli import External
from geneva_cli.loads.vibration.swing import motion_shapes as shape
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build

mp = mpmath.mp.clone()
mp.dps = 60
PI = mp.pi


def sine(size, rate, phase):
    """size sin(rate u + phase) as exponentials."""
    half = size / mp.mpc(0, 2)
    return [(half * mp.expj(phase), rate), (-half * mp.expj(-phase), -rate)]


def cosine(size, rate):
    return sine(size, rate, PI / 2)


def _modified_sine():
    top = 4 * PI**2 / (4 + PI)
    quick, slow = sine(top, 4 * PI, 0), sine(top, 4 * PI / 3, PI / 3)
    return [(0, 1, 8, quick), (1, 7, 8, slow), (7, 8, 8, sine(top, 4 * PI, -2 * PI))]


def _modified_trapezoid():
    top = 8 * PI / (2 + PI)
    flat = [(top, 0)]
    back = [(-top, 0)]
    return [
        (0, 1, 8, sine(top, 4 * PI, 0)),
        (1, 3, 8, flat),
        (3, 5, 8, sine(top, 4 * PI, -PI)),
        (5, 7, 8, back),
        (7, 8, 8, sine(top, 4 * PI, 0)),
    ]


def _sine_group(tilt):
    """ds/du = (3 - 4 cos 2x + cos 4x)(1 - 8 tilt cos x)/3, x = pi u."""
    even = [(mp.mpf(1), 0), *cosine(-mp.mpf(4) / 3, 2 * PI), *cosine(mp.mpf(1) / 3, 4 * PI)]
    odd = [*cosine(mp.mpf(2), PI), *cosine(mp.mpf(-3), 3 * PI), *cosine(mp.mpf(1), 5 * PI)]
    # cos x (3 - 4 cos 2x + cos 4x) = cos x - 3/2 cos 3x + 1/2 cos 5x
    scale = -mp.mpf(8) * tilt / 3 / 2
    return [(0, 1, 1, even + [(c * scale, k) for c, k in odd])]


# law -> (order of the derivative, pieces (from, to, over, exponentials))
WAVES = {
    "harmonic": (2, [(0, 1, 1, cosine(PI**2 / 2, PI))]),
    "cycloidal": (2, [(0, 1, 1, sine(2 * PI, 2 * PI, 0))]),
    "modified-sine": (2, _modified_sine()),
    "modified-trapezoid": (2, _modified_trapezoid()),
    "sine-group": (1, _sine_group(0)),
    "tilted sine-group": (1, _sine_group(mp.mpf(0.1))),
}
# ds/du = c u^n (1 - u)^n
POLYNOMIALS = {"3-4-5": (30, 2), "4-5-6-7": (140, 3)}


def rate(ratio, damping):
    """p of the swing e^(p u)."""
    z = mp.mpf(damping)
    return 2 * PI * mp.mpf(ratio) * mp.mpc(-z, mp.sqrt(1 - z * z))


def amplitude(law, ratio, damping=0.0):
    """The residual amplitude over the step."""
    p = rate(ratio, damping)
    if law in POLYNOMIALS:
        order, integral = 1, _polynomial(*POLYNOMIALS[law], p)
    else:
        order, pieces = WAVES[law]
        integral = sum(_wave(*piece, p) for piece in pieces)
    return abs(integral * p ** (2 - order)) / p.imag


def _wave(a, b, over, terms, p):
    a, b = mp.mpf(a) / over, mp.mpf(b) / over
    out = mp.mpc(0)
    for c, k in terms:
        q = mp.mpc(0, k) - p
        if abs(q) < 1e-25:
            q += mp.mpf("1e-30")
        out += c * mp.exp(p) * (mp.exp(q * b) - mp.exp(q * a)) / q
    return out


def _polynomial(c, n, p):
    """The integral of c u^n (1 - u)^n e^(p (1 - u)) by parts, to the end."""
    with mp.workdps(120):  # terms of n!/p^n cancel where p is small
        series = [mp.binomial(n, j) * (-1) ** j * c for j in range(n + 1)]
        one, zero = mp.mpc(0), mp.mpc(0)
        for j, factor in enumerate(series):
            m = n + j
            for k in range(m + 1):  # the k-th derivative of u^m, at 1 and at 0
                one -= factor * mp.factorial(m) / mp.factorial(m - k) / p ** (k + 1)
            zero -= factor * mp.factorial(m) / p ** (m + 1)
        return one - zero * mp.exp(p)


LAWS = [*WAVES, *POLYNOMIALS]
RATIOS = [1e-6, 1e-3, 0.1, 0.37, 0.5, 2 / 3, 1.0, 1.5, 2.0, 2.5, 3.14, 5.0, 7.3, 10.5, 20.1, 99.7]
NEAR = [x + side * 1e-12 for x in (0.5, 2 / 3, 1.0, 2.0, 4.0) for side in (-1, 0, 1)]
LARGE = [1e3, 1234.567, 9999.3, 1e4]


def of(name):
    if name.startswith("tilted"):
        return of_law(law("sine-group", 0.1))
    return of_law(law(name))


def amplitudes(form, ratios, damping=0.0):
    return shares(form, np.array(ratios, dtype=float), damping)


def close(found, exact):
    """Within 1e-13 of the value, or 1e-16 of the step: what is asked of residuals."""
    return abs(found - exact) <= max(1e-13 * exact, 1e-16)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("damping", [0.0, 0.02, 0.3, 0.95])
def test_residuals_of_laws(name, damping):
    ratios = RATIOS + NEAR + LARGE
    for ratio, found in zip(ratios, amplitudes(of(name), ratios, damping), strict=True):
        exact = amplitude(name, ratio, damping)
        assert close(found, exact), (ratio, found, float(exact))


def test_half_a_natural_period_more_or_less_at_zeros():
    """The harmonic's half-integer zeros and the cycloidal's integer ones: 1e-16 of the step."""
    for name, offset in (("harmonic", 0.5), ("cycloidal", 0.0)):
        zeros = np.arange(2, 40) + offset
        assert amplitudes(of(name), zeros).max() <= 1e-16


# theory-loads.md, section 5: z = 3 external, amplitude over the step, derived with mpmath.
@pytest.mark.parametrize(
    ("ratio", "damping", "amplitude"),
    [
        (0.5, 0.0, 0.89884102659148325),
        (0.5, 0.02, 0.87128872570555313),
        (1.0, 0.0, 0.66081486966695231),
    ],
)
def test_published_values_of_three_slots(ratio, damping, amplitude):
    found = amplitudes(shape(build(Spec(External(3))).engagements[0].motion), [ratio], damping)[0]
    assert found == pytest.approx(amplitude, rel=4e-16)  # 17 digits are given


def test_half_integer_rule_of_six_slots():
    """theory-loads.md, section 5: 1.22e-3 of the step at 10, 6.1e-5 at 10.5."""
    ten, half = amplitudes(shape(build(Spec(External(6))).engagements[0].motion), [10.0, 10.5])
    assert (f"{ten:.2e}", f"{half:.1e}") == ("1.22e-03", "6.1e-05")
