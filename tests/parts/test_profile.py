"""The slot's profile against the envelope and curvature formulas in 50 digits."""

import math
from functools import partial

import numpy as np
import pytest
from witness import mp
from words import Motion, Spec, Wheel, named

from geneva_cli.geometry.chords import FRACTIONS, chord_errors
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.parts.slots.slot_profile import flanks, nodes, profile_table, slot_columns
from geneva_cli.spec.tables import Size

L = 200.0
SIZE = Size(center_distance_mm=L, roller_radius_mm=9.0, slot_clearance_mm=0.25)


def curved(law: str, ratio: float | str | None, z: int = 6, gearing: str = "external") -> Mechanism:
    return build(Spec(Wheel(z, gearing), motion=Motion(law, ratio=ratio), size=SIZE))


@pytest.mark.parametrize("law", ["cycloidal", "3-4-5", "sine-group", "modified-sine"])
@pytest.mark.parametrize("ratio", [0.45, 0.5, "matched"])
def test_pitch_curve_flanks_pressure_and_curvature(law: str, ratio: float | str) -> None:
    """Independent witness: M = L e^(-i psi) - R e^(-i (psi + phi)), and the closed forms of its
    derivatives by psi1 and psi2. Positions to 4 ulp of L, the rest as its own digits allow."""
    mechanism = curved(law, ratio)
    x = np.array([-59.5, -47.0, -30.5, -11.0, -3.0, 5.0, 28.0, 44.5, 59.0])
    centre, left_, right_ = flanks(mechanism, x)
    *_, pressure, radius = slot_columns(mechanism, x)
    R = L * mechanism.ratio
    offset = 9.25
    for i, degrees in enumerate(x):
        phi = mp.radians(mp.mpf(float(degrees)))
        u = mp.mpf(float(degrees)) / 120 + mp.mpf(1) / 2
        s, s1, s2 = (mp.mpf(v) for v in named(law)(float(u), 2).derivatives())
        step, angle = mp.pi / 3, 2 * mp.pi / 3
        psi, psi1, psi2 = step * (s - mp.mpf(1) / 2), step * s1 / angle, step * s2 / angle**2
        M = L * mp.expj(-psi) - R * mp.expj(-(psi + phi))
        M1 = -1j * L * psi1 * mp.expj(-psi) + 1j * R * (1 + psi1) * mp.expj(-(psi + phi))
        assert abs(complex(M) - complex(*centre[i])) < 4 * math.ulp(L)
        normal = 1j * M1 / abs(M1)
        retrace = ratio == "matched" or abs(named(law)(0.5, 1).c[1] / 2.0 - R / (L - R)) < 1e-9
        side = -1 if retrace and degrees > 0 else 1
        left, right = M + side * offset * normal, M - side * offset * normal
        # the normal's direction is known to eps / |M'|, which is smallest beside the cusp
        close = offset * 1e-15 * L / float(abs(M1)) * 8 + 4 * math.ulp(L)
        assert abs(complex(left) - complex(*left_[i])) < close
        assert abs(complex(right) - complex(*right_[i])) < close
        bend = (
            psi1**3 * L**2
            + (1 + psi1) ** 3 * R**2
            - psi1 * (1 + psi1) * (1 + 2 * psi1) * L * R * mp.cos(phi)
            + psi2 * L * R * mp.sin(phi)
        ) / abs(M1) ** 3
        # the textbook M turns the other way round than the pin travels in our frame
        assert radius[i] == pytest.approx(float(-side / bend), rel=1e-9)
        lever = L * R * abs(mp.sin(phi)) / abs(M1)
        assert math.cos(math.radians(pressure[i])) == pytest.approx(
            float(lever / abs(M)), rel=1e-12
        )


def test_straight_slots_are_straight() -> None:
    table = profile_table(build(Spec(Wheel(6), size=SIZE)), 0.001, None)
    rows = list(table.rows())
    assert len(rows) == 3  # in, bottom, out: a straight line needs no more
    for row in rows:
        assert row[3] == 0.0
        assert (row[5], row[7]) == (-9.25, 9.25)
        assert row[8] == 0.0
        assert row[9] == math.inf
    # L cos b at the mouth, L - R at the bottom; 2 ulp
    assert rows[0][2] == pytest.approx(L * math.sqrt(0.75), abs=2 * math.ulp(L))
    assert rows[1][2] == pytest.approx(L / 2, abs=2 * math.ulp(L))


@pytest.mark.sampled(18)
@pytest.mark.parametrize("gearing", ["external", "internal"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize("law", ["cycloidal", "modified-trapezoid", "sine-group"])
def test_no_chord_misses_by_more_than_the_tolerance(
    law: str, tolerance: float, gearing: str
) -> None:
    if gearing == "internal" and law == "sine-group":
        law = "harmonic"  # no R/L below 1 matches the sine group inside
    mechanism = curved(law, "matched", 8, gearing)
    x = nodes(mechanism, tolerance)
    assert chord_errors(partial(flanks, mechanism), x, FRACTIONS).max() <= tolerance
    assert dense_error(mechanism, x) <= tolerance * 1.005  # 15 points a chord miss 1/256 of it
    assert 0.0 in x


def dense_error(mechanism: Mechanism, x: np.ndarray) -> float:
    """The greatest distance of 31 points a chord from it, by another formula than the program's."""
    at, worst = np.linspace(0.0, 1.0, 33), 0.0
    for line in flanks(mechanism, (x[:-1, None] + np.diff(x)[:, None] * at).ravel()):
        p = (line @ [1, 1j]).reshape(-1, 33)
        turned = (p - p[:, :1]) * np.exp(-1j * np.angle(p[:, -1:] - p[:, :1]))
        worst = max(worst, float(np.abs(turned.imag).max()))
    return worst
