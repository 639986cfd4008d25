"""A roller that meets its mouth's corner: by the motions of rigid bodies, in plane and space."""

import math

import numpy as np
import pytest
from witness import mp
from words import Spec, Wheel

import geneva_cli
from geneva_cli import Design, Epicyclic, External, SideCrank
from geneva_cli.design import load
from geneva_cli.loads.impacts.entry import RestingAxis, mouth_contacts
from geneva_cli.motion.mechanism import build
from tests.repo import ROOT


def turned(v, axis, angle):
    """A vector of space turned about an axis through the origin (Rodrigues)."""
    c, s, x = mp.cos(angle), mp.sin(angle), mp.matrix([0, 0, 0])
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        x[i] = v[i] * c + (axis[j] * v[k] - axis[k] * v[j]) * s
    return x + axis * ((v.T * axis)[0] * (1 - c))


def struck(distance, reach, about):
    """Where a distance comes down to ``reach``, and how fast the wheel must turn to keep it.

    ``distance`` is that of roller and corner by the input's angle and the wheel's.
    """
    at = mp.findroot(lambda t: distance(t, 0) - reach, mp.mpf(about), tol=1e-60)
    assert distance(1.01 * at, 0) > reach > distance(0.99 * at, 0)
    with mp.workdps(50):
        by_turn, by_wheel = (mp.diff(distance, (at, 0), n) for n in ((1, 0), (0, 1)))
    return at, -by_turn / by_wheel


def flat(z, gearing, error, roller, clearance, about):
    """Of a plain crank about the origin; the wheel's axis lies along x."""
    R, b = mp.sin(mp.pi / z), mp.pi / z
    pin, axis = R * mp.expj(mp.pi / 2 - b), mp.mpc(1)
    # the crank turns the way in which the roller goes into the slot: towards the axis, or from it
    way = -1 if gearing == "external" else 1
    corner = pin + mp.sign(error) * (mp.mpf(roller) + clearance) * pin / R

    def distance(turn, wheel):
        at = (corner - axis) * mp.expj(wheel)
        return abs(pin * (1 + mp.mpf(error)) * mp.expj(way * turn) - axis - at)

    return struck(distance, mp.mpf(roller), about)


def round_(z, axes_deg, error, roller, clearance, about):
    """On a sphere: the roller is a cone, and so distances are angles at the centre."""
    b, S = mp.pi / z, mp.radians(axes_deg)
    th, up = mp.asin(mp.sin(S) * mp.sin(b)), mp.matrix([0, 0, 1])
    arm = mp.atan(mp.tan(th) * (1 + mp.mpf(error)))
    half, crank = mp.acos(mp.tan(th) / mp.tan(S)), mp.matrix([mp.sin(S), 0, mp.cos(S)])

    def pin(turn, arm):
        return turned(mp.matrix([mp.sin(S - arm), 0, mp.cos(S - arm)]), crank, turn - half)

    entry, wide = pin(0, th), mp.mpf(roller) + mp.mpf(clearance)
    across = mp.matrix([-entry[1], entry[0], 0]) / mp.hypot(entry[0], entry[1])
    side = mp.sign(error) * mp.sign(across[0] * crank[0])  # away from the crank's axis, or to it
    corner = entry * mp.cos(wide) - across * side * mp.sin(wide)

    def distance(turn, wheel):
        return mp.acos((pin(turn, arm).T * turned(corner, up, wheel))[0])

    at, jump = struck(distance, mp.mpf(roller), about)
    return at, jump * -mp.sign(entry[1])  # the wheel turns towards the line of centres


SMALL = [(6, 1e-4, 0.05, 0.0), (3, 1e-3, 0.1, 2e-4), (12, 1e-6, 0.02, 0.0)]


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize(("z", "error", "roller", "clearance"), SMALL)
@pytest.mark.parametrize("gearing", ["external", "internal", 60, 90, 110])
def test_the_corner_s_and_the_roller_s_motions(gearing, z, error, roller, clearance, sign):
    """1e-9: what is left of the error is small beside the roller."""
    round_one = isinstance(gearing, int)
    wheel = Wheel(z, "spherical", axes_deg=gearing) if round_one else Wheel(z, gearing)
    [engagement] = build(Spec(wheel)).engagements
    found = mouth_contacts(RestingAxis.of(engagement), sign * error, 0.0, (roller, clearance, 0.0))
    about = math.radians(found.at_deg[0] - engagement.entry_deg)
    witness = round_ if round_one else flat
    early, jump = witness(z, gearing, sign * error, roller, clearance, about)
    assert found.jump[0] == pytest.approx(float(jump), rel=1e-9)
    at = engagement.entry_deg + math.degrees(float(early))
    assert found.at_deg[0] == pytest.approx(at, abs=1e-9)
    assert math.copysign(1.0, found.jump[0]) == -sign


FAMILY = {
    "side-crank": lambda: Design(External(6), SideCrank(A=0.6)),
    "offset": lambda: Design(External(6, offset_mm=12.0)),
    "epicyclic": lambda: Design(External(6), Epicyclic(planet_ratio=-0.0125)),
    "gear-sector": lambda: Design(External(3), geneva_cli.GearSector(sector_deg=60)),
    "four-bar": lambda: load(str(ROOT / "designs" / "four-bar-z4.toml")),
}


@pytest.mark.parametrize("errors", [(0.0, 3e-4), (0.0, -3e-4), (2e-4, 1e-4)])
@pytest.mark.parametrize("name", list(FAMILY))
def test_whatever_leads_the_roller(name, errors):
    """From the path alone: the roller is its radius off, and the wheel turns as it must to keep so.

    Turned by differences of 1e-6 of the input, whose square and rounding leave some 1e-9 of a jump
    of 1e-2: 1e-6.
    """
    engagement = FAMILY[name]().mechanism.engagements[0]
    crank, center = errors
    roller, clearance = 0.02, 1e-5
    found = mouth_contacts(RestingAxis.of(engagement), crank, center, (roller, clearance, 0.0))

    def pin(deg):
        x, y = (jet.c[0] for jet in engagement.path(deg, 0))
        return 1.0 + center + (1.0 + crank) * (complex(x, y) - 1.0)

    x, y = engagement.path(engagement.entry_deg, 1)
    entry, speed = (complex(a, b) for a, b in zip(x.c[:2], y.c[:2], strict=True))
    sides = [1j * speed / abs(speed) * side * (roller + clearance) for side in (1.0, -1.0)]
    at, step = found.at_deg[0], math.degrees(1e-6)
    assert at < engagement.entry_deg
    corner = min((entry + side for side in sides), key=lambda c: abs(c - pin(at)))
    assert abs(pin(at) - corner) == pytest.approx(roller, rel=1e-9)
    for earlier in np.linspace(0.01, 20.0, 100):  # and no sooner, on neither
        assert min(abs(pin(at - earlier) - entry - side) for side in sides) > roller

    def kept(deg):
        """The wheel's angle at which the corner is as far from the roller: a triangle's."""
        far, here = abs(corner), pin(deg)
        cosine = (abs(here) ** 2 + far**2 - roller**2) / (2.0 * abs(here) * far)
        angles = [np.angle(here / corner) + sign * math.acos(cosine) for sign in (1.0, -1.0)]
        return min(angles, key=abs)

    slope = (kept(at + step) - kept(at - step)) / 2e-6
    assert found.jump[0] == pytest.approx(slope, rel=1e-6, abs=1e-9)
