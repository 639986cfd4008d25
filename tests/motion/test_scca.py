"""The family of sine, constant and cosine acceleration, against its laws and its definition.

R. L. Norton, Cam Design and Manufacturing Handbook: the SCCA family and its closed forms.
"""

import math

import numpy as np
import pytest
from witness import LAWS, SineLaw, mp

from geneva_cli.motion.laws.standard import SineConstantCosine
from geneva_cli.study.law_values import characteristic

pi = math.pi
NAMED = {
    "harmonic": (0.0, 0.0, 1.0),
    "cycloidal": (0.5, 0.0, 0.5),
    "modified-sine": (0.25, 0.0, 0.75),
    "modified-trapezoid": (0.25, 0.5, 0.25),
}
OTHERS = [
    (0.2, 0.6, 0.2),
    (0.0, 0.5, 0.5),
    (0.5, 0.5, 0.0),
    (0.0, 1.0, 0.0),
    (1.0, 0.0, 0.0),
    (0.1, 0.0, 0.9),
    (0.333333, 0.333333, 0.333333),
    (0.001, 0.998, 0.001),
]


def scca(b, c, d):
    return SineConstantCosine(b=b, c=c, d=d)


def drawn(b, c, d):
    """The acceleration as the book draws it, in the words of the witness."""
    b, c, d = (mp.mpf(x) / (mp.mpf(b) + mp.mpf(c) + mp.mpf(d)) for x in (b, c, d))
    places, terms = [b / 2, (1 - d) / 2, (1 + d) / 2, 1 - b / 2, mp.mpf(1)], []
    terms.append((1, mp.pi / b, 0) if b else None)
    terms.append((1, 0, mp.pi / 2))
    terms.append((1, mp.pi / d, mp.pi / 2 - mp.pi / d * (1 - d) / 2) if d else None)
    terms.append((-1, 0, mp.pi / 2))
    terms.append((1, mp.pi / b, -mp.pi / b) if b else None)
    starts = [mp.mpf(0), *places]
    shown = [(e, [t]) for s, e, t in zip(starts, places, terms, strict=False) if e > s]
    return SineLaw(*shown)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", NAMED)
def test_a_named_law_is_its_member(name):
    law, u = scca(*NAMED[name]), np.linspace(0.0, 1.0, 257)
    got = law(u, 3).derivatives()
    exact = np.array([[float(v) for v in LAWS[name](t, 3)] for t in u.tolist()]).T
    for k in range(4):
        at = np.ones(len(u), bool) if k < 3 else ~np.isin(u, law.breaks)  # jerk may jump there
        # 1e-15 of the peak: four units in its last place
        error = np.max(np.abs(got[k][at] - exact[k][at]))
        assert error <= 1e-15 * np.max(np.abs(exact[k])), k


@pytest.mark.parametrize("shares", OTHERS)
def test_any_member_against_its_definition(shares):
    law, witness = scca(*shares), drawn(*shares)
    u = [
        t for t in [*np.linspace(0.0, 1.0, 65).tolist(), 1e-3, 1 / 3] if t not in (0.5, *law.breaks)
    ]
    exact = [witness(t, 3) for t in u]
    for k in range(4):
        peak = max(abs(float(e[k])) for e in exact)
        for t, e in zip(u, exact, strict=True):
            # 8 units of the peak; the argument of a sine is rounded by its slope
            steep = abs(float(e[k + 1])) if k < 3 else 2 * pi / min(s for s in shares if s) * peak
            error = abs(float(law(t, 3).derivatives()[k] - e[k]))
            assert error <= 8 * math.ulp(peak) + 4e-16 * steep * t, (t, k)


@pytest.mark.parametrize("shares", [*NAMED.values(), *OTHERS])
def test_peaks_are_the_closed_forms(shares):
    whole = sum(shares)
    b, c, d = (x / whole for x in shares)
    found = characteristic(scca(*shares))
    a = 4 * pi**2 / ((pi**2 - 8) * (b**2 - d**2) - 2 * pi * (pi - 2) * b + pi**2)
    # 1e-14: the closed form's own rounding, some of its terms being differences
    assert found["acceleration"] == pytest.approx(a, rel=1e-14)
    assert found["velocity"] == pytest.approx(a * ((b + d) / pi + c / 2), rel=1e-14)
    jerk = a * pi / min((x for x in (b, d) if x), default=math.inf)
    assert found["jerk"] == pytest.approx(jerk, rel=1e-14, abs=0.0)
