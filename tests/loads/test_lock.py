"""The lock under a torque: geometry by mpmath and by the parts' own turn, contact by its field."""

import math
from types import SimpleNamespace

import mpmath
import pytest
import repo
from plane_stress import horn as in_plane_stress
from words import Spec, Wheel

from geneva_cli import load
from geneva_cli.loads.strength.lock import bending, loaded_locks
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.parts import parts_of
from geneva_cli.spec.tables import Load, Size
from geneva_cli.verdict.strength import strength

SIZES = Size(160.0, 8.0, face_width_mm=20.0, lock_clearance_mm=0.02, lock_edge_mm=0.5)
SPEC = Spec(Wheel(8), size=SIZES, load=Load(torque_Nm=20.0))


def answer(spec):
    mechanism = build(spec)
    s = parts_of(mechanism).outlines.sizes
    found = loaded_locks(mechanism, s.half_width, by(s, mechanism.spec), s.wheel_thickness)
    if found is None:
        return None, s, mechanism
    return SimpleNamespace(**{k: row.item() for k, row in found.items()}), s, mechanism


def by(s, spec):
    """The lock of parts whose disc reaches round farther than the recess."""
    radii = s.lock, s.recess, s.rim, math.radians(112.5), spec.size.lock_edge_mm or 0.0
    return Lock(spec.size.center_distance_mm, spec.wheel.SIGN, *radii)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("edge", [0.0, 1.5])
def test_the_play_uses_up_the_clearance(sign, edge):
    """The wheel turned by the play, at 30 digits: its nearest point is as far as the disc is large.

    Points of the recess, or of its rounded end, over all their angles. 1e-12: where the distance
    is least it is flat, and the end of an arc is a double.
    """
    L, R, Rk, rim = 100.0, 40.0, 40.5, 86.8
    found = Lock(L, sign, R, Rk, rim, 2.5, edge).contact()
    with mpmath.workdps(30):
        turn = mpmath.expj(mpmath.mpf(found.play))
        if found.on == "corner":  # the centre of the rounded end, of radius 0 too
            far = mpmath.mpf(rim) - sign * edge
            reach = mpmath.mpf(Rk) + edge
            at = mpmath.acos((L * L + far * far - reach * reach) / (2 * L * far))
            centre = far * mpmath.expj(at) / turn  # turned towards the line of centres
            distance = abs(centre - L) - edge
        else:  # the recess's arc, of radius Rk round the turned centre
            distance = Rk - abs(L * turn - L)
    assert float(distance) == pytest.approx(R, rel=1e-13)


@pytest.mark.sampled(5)
@pytest.mark.parametrize(
    ("name", "on"),
    [
        *[("turret", "corner"), ("internal-z6", "disc's end"), ("three-rollers-z4", "disc's end")],
        # recesses between mouths at different radii
        *[("offset-slots", "corner"), ("unequal-steps", "disc's end")],
    ],
)
def test_the_play_is_that_of_the_parts(name, on):
    """The parts turned against each other find it by bisection of outlines: to 3e-6 of it."""
    design = load(str(repo.DESIGNS / f"{name}.toml")).with_("size.lock_clearance_mm", 0.2)
    plays_as_its_parts(design, on)


def plays_as_its_parts(design, on="disc's end"):
    design = design.with_("size.face_width_mm", 20.0).with_("load.dwell_torque_Nm", 5.0)
    load = strength(design.mechanism).load
    assert load.lock_sizes[1].contact().on == on
    play_deg = strength(design.mechanism)["strength.lock.play_deg"]
    assert parts_of(design.mechanism).turn.dwell.deg == pytest.approx(play_deg, rel=3e-6)


def test_force_and_pressure_hold_the_torque():
    """The worn-in pressure p sin, summed over the arc by its moments about the wheel's axis."""
    found, s, _ = answer(SPEC)
    where = by(s, SPEC).contact()
    assert found.force_N * 0.160 * math.sin(where.phi) == pytest.approx(20.0, rel=1e-14)
    top = found.pressure_MPa / math.sin(where.phi)
    moment = mpmath.quad(
        lambda a: 20.0 * s.lock * top * mpmath.sin(a) * 160.0 * mpmath.sin(a), [0.0, where.phi]
    )
    assert float(moment) == pytest.approx(20e3, rel=1e-12)


def test_hertz_on_the_rounded_end():
    """p0² = F E*/(pi b) (1/R1 + 1/R2), steel on steel."""
    found, s, _ = answer(SPEC)
    modulus = 210e3 / (2.0 * (1.0 - 0.09))
    square = found.force_N * modulus / (math.pi * 20.0) * (1.0 / s.lock + 1.0 / 0.5)
    assert found.contact_stress_MPa == pytest.approx(math.sqrt(square), rel=1e-14)


def test_the_approach_is_the_integral_of_the_strains():
    """Below Hertz's pressure to the horn's depth, and to the axis of a roller squeezed across.

    Plane strain, on the line of force. In the half-space the stresses are Hertz's; the roller's
    have besides those of a point force at its far side and an even tension F/(pi R). The formulas
    leave out squares of a/depth: below 1e-4 here.
    """
    found, s, _ = answer(SPEC)
    where = by(s, SPEC).contact()
    line, E, nu = found.force_N / 20.0, 210e3, 0.3
    a = math.sqrt(4.0 * line * where.radius * 2.0 * (1.0 - nu * nu) / (math.pi * E))
    p0, R = 2.0 * line / (math.pi * a), s.lock

    def strain(across, down):
        return (1.0 - nu * nu) / E * (down - nu / (1.0 - nu) * across)

    def half_space(z):
        root = mpmath.sqrt(a * a + z * z)
        return strain(-p0 / a * ((a * a + 2 * z * z) / root - 2 * z), -p0 * a / root)

    def roller(z):
        root = mpmath.sqrt(a * a + z * z)
        across = -p0 / a * ((a * a + 2 * z * z) / root - 2 * z) + line / (math.pi * R)
        down = -p0 * a / root - 2 * line / (math.pi * (2 * R - z)) + line / (math.pi * R)
        return strain(across, down)

    sides = mpmath.quad(half_space, [0, a, 10 * a, s.horn]) + mpmath.quad(roller, [0, a, 10 * a, R])
    lever = 160.0 * math.sin(where.phi)
    assert math.radians(found.approach_deg) * lever == pytest.approx(-float(sides), rel=1e-3)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("z", "L", "r", "h"), [(3, 100.0, 5.0, 2.0), (6, 100.0, 5.0, 5.0), (8, 250.0, 12.0, 12.0)]
)
def test_the_horn_gives_more_in_plane_stress(z, L, r, h):
    """6 to 30 %, as the docstring says: the body beneath gives too."""
    wall = L * math.sin(math.pi / z) - r
    depth = L * (math.cos(math.pi / z) + math.sin(math.pi / z) - 1.0)
    _, _, moved = in_plane_stress(wall, wall - h, depth, math.pi - 2.0 * math.pi / z, 0.15 * h)
    mechanism = build(Spec(Wheel(z), size=Size(L, r), load=Load(torque_Nm=1.0)))
    square = 0.5 * math.pi - math.pi / z  # where the force is square to the slot
    give, _, thick = bending(mechanism, r, wall - h, square)
    assert thick == pytest.approx(h, rel=1e-9)
    assert 1.05 < moved / give < 1.31
