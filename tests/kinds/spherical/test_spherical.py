"""Spherical wheels and cranks: in closed form, through a whole motion, laid flat, and as solids."""

import math

import mpmath
import numpy as np
import pytest
from drawing_witness import vertices

from geneva_cli import Crank, Design, Size, Spherical
from geneva_cli.geometry.shapes import Contour
from geneva_cli.geometry.sphere import Cap, place
from geneva_cli.kinds.spherical.drawings import cone_of
from geneva_cli.kinds.spherical.parts import wheel_shell
from geneva_cli.kinds.spherical.regions import (
    at_mid_motion,
    edge_points,
    sectors,
    wheel_regions,
)
from geneva_cli.kinds.spherical.sizes import ball

CLEAR = Size(80.0, 5.0, slot_clearance_mm=0.05, lock_clearance_mm=0.04)
MACHINES = {
    "90": Design(Spherical(6), size=Size(80.0, 5.0)),
    "60, two rollers": Design(Spherical(5, axes_deg=60), Crank(rollers=2), size=CLEAR),
    "120": Design(Spherical(6, axes_deg=120), size=CLEAR),
    "3 slots": Design(Spherical(3), size=CLEAR),
    "no lock": Design(Spherical(8), size=Size(60.0, 3.0, lock_radius_mm=0.0)),
}


@pytest.fixture(params=MACHINES)
def machine(request):
    return MACHINES[request.param]


def sizes(design):
    return ball(design.mechanism)


def geometry(found):
    """theory.md 1.3, from z and the shafts' angle: arm, mouth, half the motion."""
    b, S = math.pi / found.z, found.axes
    arm = math.asin(math.sin(S) * math.sin(b))
    mouth = math.atan2(math.sin(S) * math.cos(b), math.cos(S))
    half = math.acos(math.tan(arm) * math.cos(S) / math.sin(S))  # tan th / tan S, at 90 degrees 0
    return arm, mouth, half


def test_sizes_are_those_of_the_theory(machine):
    found, S = sizes(machine), math.radians(machine.spec.wheel.axes_deg)
    arm, mouth, half = geometry(found)
    assert found.axes == pytest.approx(S, abs=1e-15)
    assert found.arm == pytest.approx(arm, abs=1e-15)
    assert found.half_motion == pytest.approx(half, abs=1e-14)
    assert math.cos(found.rim) == pytest.approx(math.cos(mouth) * math.cos(found.half_width))


def in_wheel(found, u):
    """How far directions (n, 3) are within the wheel, radians, by its definition; inside above 0.

    Nearer than the rim, in no slot and no recess.
    """
    depth = found.rim - np.arctan2(np.hypot(u[:, 0], u[:, 1]), u[:, 2])
    depth = np.minimum(depth, np.arctan2(np.hypot(u[:, 0], u[:, 1]), u[:, 2]) - found.inner)
    for k in range(found.z):
        for azimuth, centre in ((2 * k, None), (2 * k + 1, found.axes)):
            a = azimuth * math.pi / found.z
            if centre is None:
                depth = np.minimum(depth, beyond_slot(found, u, a))
            elif found.recess:
                c = u @ polar(centre, a)
                depth = np.minimum(depth, np.arccos(np.clip(c, -1.0, 1.0)) - found.recess)
    return depth


def beyond_slot(found, u, a):
    """The angle from a slot's middle line, less half its width."""
    end, aside = polar(found.bottom, a), np.array((-math.sin(a), math.cos(a), 0.0))
    on = polar(found.bottom + math.pi / 2.0, a)
    along = (u @ on > 0.0) & (u @ polar(math.pi / 2.0, a) > 0.0)  # and not across the wheel
    off = np.where(along, np.abs(np.arcsin(u @ aside)), np.arccos(np.clip(u @ end, -1.0, 1.0)))
    return off - found.half_width


def polar(angle, azimuth):
    s = math.sin(angle)
    return np.array((s * math.cos(azimuth), s * math.sin(azimuth), math.cos(angle)))


def points(regions, each=200):
    share = np.linspace(0.0, 1.0, each)
    return np.concatenate(
        [arc.at(arc.sweep * share)[0] for region in regions for arc in region.boundary]
    )


def slots_of(found):
    return wheel_regions(found)[: found.z]


def test_the_boundary_is_that_of_the_definition(machine):
    found = sizes(machine)
    assert np.abs(in_wheel(found, edge_points(found, 40))).max() < 1e-14
    for region in slots_of(found):
        ends = zip(region.boundary, (*region.boundary[1:], region.boundary[0]), strict=True)
        assert all(arc.end == after.start for arc, after in ends)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ["90", "60, two rollers", "no lock"])
def test_solid_angle_and_inertia_are_those_of_integrals(name):
    """Over azimuths, of what the definition leaves of each meridian; mpmath, to 1e-12."""
    found = sizes(MACHINES[name])
    b, S, w, inner = math.pi / found.z, found.axes, found.half_width, min(found.inner, 1.0)

    def circle(centre, angle, azimuth):
        """Polar angles at which a meridian enters and leaves a circle about a point on 0."""
        A, B = mpmath.cos(centre), mpmath.sin(centre) * mpmath.cos(azimuth)
        reach = mpmath.cos(angle) / mpmath.hypot(A, B)
        if reach >= 1:
            return None
        middle = mpmath.atan2(B, A)
        return middle - mpmath.acos(reach), middle + mpmath.acos(reach)

    def left(azimuth, to):
        high = found.rim
        recess = circle(S, found.recess, azimuth - b) if found.recess else None
        if recess:
            high = min(high, recess[0])
        kept = to(high) - to(inner)
        slot = circle(found.bottom, w, azimuth)
        if slot:
            out = mpmath.sin(w) / mpmath.sin(azimuth) if azimuth else 2
            # the wall leaves the meridian where it passes the rim, or on its way there
            top = found.rim if out >= mpmath.sin(found.rim) else mpmath.asin(out)
            foot = mpmath.atan(mpmath.tan(found.bottom) / mpmath.cos(azimuth))
            top = slot[1] if top < foot else top
            kept -= to(top) - to(slot[0])
        return kept

    corner, foot = found.corner, math.atan2(math.tan(w), math.sin(found.bottom))
    widest = math.asin(math.sin(w) / math.sin(found.bottom))
    breaks = sorted({0.0, corner, foot, widest, b - found.opened, b})

    def squares(polar):  # the integral of sin², over the sphere
        return mpmath.cos(polar) ** 3 / 3 - mpmath.cos(polar)

    whole = 2 * mpmath.quad(lambda a: left(a, lambda polar: -mpmath.cos(polar)), breaks)
    for region in slots_of(found):
        assert region.area == pytest.approx(float(whole), rel=1e-12)
    seen = found.z * 2 * mpmath.quad(lambda a: left(a, squares), breaks)
    seen += 2 * mpmath.pi * (squares(inner) - squares(0.0))  # closed down to the hub's hole
    low, high = found.span_mm
    hole = mpmath.quad(
        lambda s: s**3 * (mpmath.sqrt(high**2 - s * s) - mpmath.sqrt(low**2 - s * s)),
        [0, found.hub_mm],
    )
    wanted = seen * (high**5 - low**5) / 5 - 2 * mpmath.pi * hole
    assert wheel_shell(found).inertia == pytest.approx(float(wanted), rel=1e-12)


def turned(u, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.column_stack((u[:, 0] * c - u[:, 1] * s, u[:, 0] * s + u[:, 1] * c, u[:, 2]))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("at", range(len(MACHINES)))
def test_nothing_meets_in_a_motion(at):
    """The crank's edge, turned by theory's formula, is never in the wheel; the wheel's edge is
    never in a sector; the roller leaves the slot's clearance on both sides."""
    found = sizes([*MACHINES.values()][at])
    frame = np.column_stack(at_mid_motion(found))
    locking, rolling = sectors(found), points([Cap(place(found.arm, 0.0), found.roller).region])
    clearance = found.half_width - found.roller
    _, _, half = geometry(found)
    wheel = edge_points(found, 100)
    for a in np.linspace(-half, half, 31):
        n = math.tan(found.arm) * math.sin(a)
        m = math.sin(found.axes) - math.tan(found.arm) * math.cos(found.axes) * math.cos(a)
        psi = math.atan2(n, m)

        def seen(crank, a=a, psi=psi):
            return turned(turned(crank, -a) @ frame.T, -psi)

        assert in_wheel(found, seen(rolling)).max() < 1e-12 - 0.99 * clearance
        if not locking:
            continue
        assert in_wheel(found, seen(points(locking, 60))).max() < 1e-9
        # the wheel's edge in the crank's frame: between two azimuths, and nearer than the lock
        x, y, up = turned(turned(wheel, psi) @ frame, a).T
        angle, azimuth = np.arctan2(np.hypot(x, y), up), np.arctan2(y, x) % math.tau
        low = min(math.acos(min(1.0, arc.start[2])) for r in locking for arc in r.boundary)
        behind = (azimuth[:, None] - np.array(found.rollers)) % math.tau
        between = (behind > half + 1e-9).all(axis=1) & (math.tau - behind > half + 1e-9).all(axis=1)
        inside = between & (angle > low + 1e-9) & (angle < found.lock - 1e-9)
        assert not inside.any()


def test_it_is_held_in_the_dwell():
    """The sectors lie in the recess, its clearance away, on both sides of the line of centres."""
    found = sizes(MACHINES["60, two rollers"])
    held = points(sectors(found), 400)
    rest = turned(held, math.pi / 2.0) @ np.column_stack(at_mid_motion(found)).T
    gap, aside = in_wheel(found, turned(rest, math.pi / found.z)), rest[:, 1] > 0.0
    for side in (aside, ~aside):
        assert gap[side].max() == pytest.approx(-0.04 / 80.0, rel=1e-3)


@pytest.mark.sampled(10)
@pytest.mark.parametrize("curves", ["arcs", "spline"])
def test_laid_flat(machine, curves):
    """Rolled up again, every point of the outline is on the wheel's edge, seen from the centre."""
    found, L = sizes(machine), machine.mechanism.center_distance_mm
    drawing = machine.drawing("wheel", 0.01, curves)
    (outline,) = (s for s in drawing.shapes if s.layer == "WHEEL")
    flat = np.array(vertices(outline, 1e-3))
    cone = cone_of(machine.parts, "wheel")
    m, share = cone.polar, math.cos(cone.polar)
    apex = np.array((-L * math.tan(m), 0.0))
    way = flat - apex
    side = math.copysign(1.0, share)
    turn = np.unwrap(np.arctan2(side * way[:, 1], side * way[:, 0])) / share
    angle = m + np.arctan(np.hypot(*way.T) * side / L - math.tan(m))
    u = np.column_stack((np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)))
    depth = in_wheel(found, u)
    # of the seam, amid two slots, points are inside
    seam = np.abs(np.remainder(turn + math.pi / found.z + 0.1, math.tau) - 0.1) < 1e-6
    # 0.01 mm and the chords' 0.001, on a cone that is at most twice as far as the sphere
    assert np.abs(depth[~seam]).max() < 0.011 / L
    assert (~seam).sum() > 500


def test_the_crank_laid_flat():
    """Its lock is an arc about the apex; the roller's outline is as wide as its cone."""
    design = MACHINES["90"]
    found = sizes(design)
    drawing, cone = design.drawing("crank", 0.001), cone_of(design.parts, "crank")
    sector, roller = (s for s in drawing.shapes if s.layer in ("CRANK", "ROLLER"))
    assert isinstance(sector, Contour)
    apex = -cone.apex_mm
    far = cone.apex_mm + 80.0 * math.tan(found.lock - found.arm)
    assert sector.segments[0].centre == pytest.approx((apex, 0.0), abs=1e-9)
    assert sector.segments[0].radius == pytest.approx(far, rel=1e-12)
    x, _ = np.array(vertices(roller, 1e-4)).T
    wide = 80.0 * math.tan(5.0 / 80.0)  # its cone's, where its axis meets the sphere
    assert (x.min(), x.max()) == pytest.approx((-wide, wide), abs=2e-3)
    assert "sphere 30 deg from the crank's axis, 46.188 mm from its apex" in drawing.title
