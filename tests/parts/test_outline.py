"""Parts against the textbook's closed forms, and against shapes cut out of each other.

The witnesses know nothing of the program's contours: a blank less slots, recesses and every place
of the roller, by shapely; areas and lengths of sectors and segments, in 30 digits by mpmath.
"""

import functools
import math
from collections.abc import Iterator
from typing import NamedTuple

import mpmath
import numpy as np
import pytest
import shapely
from drawing_witness import length, polygon
from shapely import affinity
from shapely.geometry import LineString, Point, Polygon
from words import LAWS, Drive, Motion, Spec, Wheel

from geneva_cli.geometry.plates import moments
from geneva_cli.geometry.shapes import Arc, Contour
from geneva_cli.motion.laws.law import Motion as Given
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.outlines.cut_outlines import CURVED
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.spec.tables import Size

L = 100.0
FLAT = 1e-5 * L  # how far the witnesses' polygons stray from the arcs
QUARTER = 128  # chords in the quarter of a witness's circle: r (1 - cos(pi/512)) = 2e-5 r


@functools.cache
def made(
    z: int,
    gearing: str = "external",
    rollers: int = 1,
    law: str | None = None,
    kind: str = "crank",
    offset: float = 0.0,
    steps: tuple[float, ...] | None = None,
    motion: Given | None = None,
    **size: float | str,
) -> Parts:
    """Parts of a machine at L = 100 mm."""
    own = {"offset_mm": offset} if offset else {"steps_deg": steps} if steps else {}
    given = motion or Motion(law, ratio="matched" if kind == "crank" else None)
    rollers = len(steps) if steps else rollers
    wheel, drive = Wheel(z, gearing, **own), Drive(kind, rollers=rollers)
    spec = Spec(wheel, drive, motion=given, size=Size(L, **size))
    return parts_of(build(spec)).built


def disc(radius: float, x: float = 0.0, y: float = 0.0) -> Polygon:
    return Point(x, y).buffer(radius, quad_segs=4 * QUARTER)


def turned(shape: Polygon, radians: float) -> Polygon:
    return affinity.rotate(shape, radians, origin=(0.0, 0.0), use_radians=True)


def ends_meet(contour: Contour) -> bool:
    around = zip(contour.segments, (*contour.segments[1:], contour.segments[0]), strict=True)
    return contour.closed and all(p.end == q.start for p, q in around)


def apart(found: Parts, wanted: Polygon) -> float:
    """The area by which wheel and witness differ over the outline's length: a mean distance."""
    contour = polygon(found.outlines.wheel, FLAT)
    return contour.symmetric_difference(wanted).area / contour.length


class Slot(NamedTuple):
    """A straight slot in its own frame, x along its axis: where that lies, where the last roller
    is, and the rim on its lower and upper side."""

    direction: float
    level: float
    bottom: float
    low: float
    high: float


def slots_of(
    z: int, gearing: str, r: float, bottom: float, offset: float, steps: tuple[float, ...]
) -> tuple[list[Slot], list[float]]:
    """All slots of a wheel and the directions of the crank's axis while it rests, by theory."""
    if steps:
        halves = [math.radians(steps[k % len(steps)]) / 2.0 for k in range(z)]
    else:
        halves = [math.pi / z] * z
    found, rests, at = [], [], 0.0
    for k, b in enumerate(halves):
        if gearing == "internal":
            last, rims = L + L * math.sin(b) + bottom, [math.hypot(L * math.cos(b), r)] * 2
            found.append(Slot(at, 0.0, last, *rims))
        else:
            delta = math.asin(offset / L / math.cos(b))
            R = L * math.sin(b) * math.cos(delta)
            last = math.sqrt((L - R) ** 2 - offset**2) - bottom
            high = math.hypot(L * math.cos(b - delta), offset - r)
            low = math.hypot(L * math.cos(b + delta), offset + r)
            found.append(Slot(at + delta, -offset, last, low, high))
        rests.append(at - b)
        at -= b + halves[(k + 1) % z]  # slots that come later lie behind
    return found, rests


def sector(radius: float, start: float, end: float) -> Polygon:
    t = np.linspace(start, end, 4 * QUARTER)
    return Polygon([(0.0, 0.0), *np.column_stack((radius * np.cos(t), radius * np.sin(t)))])


def cut(found: Parts, slots: list[Slot], rests: list[float]) -> Polygon:
    """The wheel's material (inside: its opening) by cutting."""
    size, sign = found.sizes, found.assembly.sign
    w, z = size.half_width, len(slots)
    behind = rests  # the rest that comes after slot k lies behind it
    ahead = [rests[k - 1] for k in range(z)]
    reach = (1.0 - 0.2) * (L - size.recess)
    halves = []
    for slot, low, high in zip(slots, behind, ahead, strict=True):
        whole = low, low + (high - low) % math.tau  # the slot's axis parts it in two
        for side, rim, at in ((-1.0, slot.low, low), (1.0, slot.high, high)):
            half = sector(rim, *whole)
            y = slot.level + side * w
            if size.lock and sign > 0.0 and rim < (held := 0.2 * size.rim + reach):
                # What the recess does not reach is carried out to it, inside the roller's circle.
                corner = turned(Point(math.sqrt(rim * rim - y * y), y), slot.direction)
                axis = Point(L * math.cos(at), L * math.sin(at))
                way = disc(axis.distance(corner), axis.x, axis.y)
                half = half.union(sector(held, *whole).intersection(way))
            own = shapely.box(-2.0 * L, slot.level, 2.0 * L, slot.level + side * 2.0 * L)
            halves.append(half.intersection(turned(own, slot.direction)))
    blank = shapely.union_all(halves).buffer(0)
    far = 2.0 * L if sign > 0.0 else 0.5 * min(slots[0].low, slots[0].high)
    tools = [
        turned(
            LineString([(s.bottom, s.level), (far, s.level)]).buffer(w, quad_segs=QUARTER),
            s.direction,
        )
        for s in slots
    ]
    if size.lock:
        tools += [disc(size.recess, L * math.cos(a), L * math.sin(a)) for a in rests]
    tool = shapely.union_all(tools)
    return blank.difference(tool) if sign > 0.0 else blank.union(tool)


STRAIGHT = [
    {"z": 3, "roller_radius_mm": 3.0},
    {"z": 4, "roller_radius_mm": 6.0, "slot_clearance_mm": 0.1, "lock_clearance_mm": 0.01},
    {"z": 6, "slot_clearance_mm": 0.01, "lock_clearance_mm": 0.1},
    {"z": 8, "roller_radius_mm": 4.0, "slot_clearance_mm": 0.1},
    {"z": 24, "roller_radius_mm": 2.0, "slot_clearance_mm": 0.01},
    {"z": 3, "gearing": "internal", "roller_radius_mm": 4.0},
    {"z": 4, "gearing": "internal", "slot_clearance_mm": 0.1, "lock_clearance_mm": 0.1},
    {"z": 24, "gearing": "internal", "roller_radius_mm": 1.0},
    {"z": 4, "rollers": 3, "roller_radius_mm": 7.0},
    {"z": 8, "slot_bottom_clearance_mm": 2.5},
    {"z": 6, "law": "cycloidal", "kind": "cam"},
    {"z": 6, "offset": 8.0, "roller_radius_mm": 4.0},
    {"z": 6, "offset": -8.0, "roller_radius_mm": 4.0, "slot_clearance_mm": 0.1},
    {"z": 8, "steps": (60.0, 30.0), "roller_radius_mm": 3.0, "slot_clearance_mm": 0.1},
    {"z": 6, "steps": (90.0, 30.0)},
    {"z": 4, "steps": (120.0, 60.0), "slot_clearance_mm": 0.1, "lock_clearance_mm": 0.1},
    {"z": 4, "offset": -40.0},
]


def theory(found: Parts) -> tuple[list[Slot], list[float]]:
    mechanism = found.assembly.mechanism
    wheel, size, r = mechanism.spec.wheel, mechanism.spec.size, mechanism.roller_radius_mm
    bottom = size.slot_bottom_clearance_mm
    if bottom is None:
        bottom = max(size.allowances.slot_clearance_mm, r / 20.0)
    offset = wheel.as_dict().get("offset_mm", 0.0)
    return slots_of(wheel.z, wheel.NAME, r, bottom, offset, wheel.steps)


@pytest.mark.sampled(24)
@pytest.mark.parametrize("case", STRAIGHT, ids=str)
def test_straight_slots_against_cutting(case: dict) -> None:
    """The witness strays by chords of its circles and of the flattened contour; both lie within,
    so a mean distance of their larger error is allowed. A wall 1e-4 mm off would show."""
    found = made(**case)
    assert ends_meet(found.outlines.wheel)
    shape = polygon(found.outlines.wheel, FLAT)
    assert shape.is_valid
    assert shape.exterior.is_ccw
    assert apart(found, cut(found, *theory(found))) < FLAT


def slot_area(rim: mpmath.mpf, bottom: mpmath.mpf, w: mpmath.mpf) -> mpmath.mpf:
    """Between a radial slot's round end and the rim's circle; negative for a slot outwards."""
    under = w * mpmath.sqrt(rim**2 - w**2) + rim**2 * mpmath.asin(w / rim)
    return under - 2 * w * bottom + (1 if bottom < rim else -1) * mpmath.pi * w**2 / 2


def lens(R: mpmath.mpf, r: mpmath.mpf, d: mpmath.mpf) -> tuple[mpmath.mpf, mpmath.mpf, mpmath.mpf]:
    """Two circles' common area, and half the angles at which their centres see it."""
    a = mpmath.acos((d**2 + R**2 - r**2) / (2 * d * R))
    b = mpmath.acos((d**2 + r**2 - R**2) / (2 * d * r))
    return R**2 * (a - mpmath.sin(2 * a) / 2) + r**2 * (b - mpmath.sin(2 * b) / 2), a, b


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "case", [c for c in STRAIGHT if not {"offset", "steps", "kind"} & c.keys()], ids=str
)
def test_areas_lengths_and_walls_of_radial_slots(case: dict) -> None:
    """Relative 1e-13: some hundred units in the last place for sums of some hundred pieces."""
    found = made(**case)
    size, z, sign = found.sizes, case["z"], found.assembly.sign
    spec = found.assembly.mechanism.spec
    with mpmath.workdps(30):
        b, r = mpmath.pi / z, mpmath.mpf(found.assembly.mechanism.roller_radius_mm)
        R, rim = L * mpmath.sin(b), mpmath.sqrt((L * mpmath.cos(b)) ** 2 + r**2)
        w = r + mpmath.mpf(spec.size.allowances.slot_clearance_mm)
        recess = mpmath.mpf(size.lock) + mpmath.mpf(spec.size.allowances.lock_clearance_mm)
        bottom = L - sign * R - sign * mpmath.mpf(size.slot_bottom)
        common, seen, bent = lens(rim, recess, mpmath.mpf(L))
        slot = slot_area(rim, bottom, w)
        if sign > 0.0:
            wanted = mpmath.pi * rim**2 - z * (slot + common)
            arc = 2 * recess * bent
        else:
            wanted = mpmath.pi * rim**2 + z * (-slot + mpmath.pi * recess**2 - common)
            arc = 2 * recess * (mpmath.pi - bent)
        mouth = mpmath.asin(w / rim)
        walls = 2 * abs(mpmath.sqrt(rim**2 - w**2) - bottom) + mpmath.pi * w
        round_ = z * (walls + arc + 2 * rim * (b - seen - mouth))
        assert float(rim) == pytest.approx(size.rim, rel=1e-15)
        assert moments(found.outlines.wheel).area == pytest.approx(float(wanted), rel=1e-13)
        assert length(found.outlines.wheel) == pytest.approx(float(round_), rel=1e-13)
        assert size.recess == pytest.approx(float(recess), rel=1e-15)
        assert size.slot_end == pytest.approx(float(bottom - sign * w), rel=1e-13)
        # The horn is thinnest at the mouth: from the foot of O1's perpendicular, R - w - recess.
        assert size.horn == pytest.approx(float(R - w - recess), abs=1e-13 * L)


# --- the crank


def corners_in_the_disc(z: int, r: float, share: float) -> Iterator[np.ndarray]:
    """The paths of the recess's corners within the disc, in the crank's frame in units of L."""
    b = math.pi / z
    R, rim, rk = math.sin(b), math.hypot(math.cos(b), r / L), share * math.sin(b)
    chi = math.acos((1.0 + rim**2 - rk**2) / (2.0 * rim))
    a = np.linspace(-1.0, 1.0, 20001) * (math.pi / 2.0 - b)
    psi = np.arctan2(R * np.sin(a), 1.0 - R * np.cos(a))
    for side in (-1.0, 1.0):
        for rest in (-b, b):
            corner = rim * np.exp(1j * (rest + side * chi + psi)) - 1.0
            seen = -corner * np.exp(1j * a)  # the roller ahead, on the positive axis
            yield seen[np.abs(seen) < rk - 1e-7]  # at entry they lie on it


RELIEF = [(3, 0.7), (4, 0.45), (6, 0.31), (7, 0.8), (10, 0.48), (16, 0.67)]


@pytest.mark.parametrize(("z", "share"), RELIEF)
def test_the_relief_is_the_triangle_of_entry(z: int, share: float) -> None:
    """Centre L rk/R from the axis ahead of the roller, radius L cos b rk/R; where it clears."""
    b = math.pi / z
    R = L * math.sin(b)
    found = made(z, roller_radius_mm=2.0, lock_radius_mm=share * R)
    assert found.outlines.relief == "arc"
    (relief,) = [
        s for s in found.outlines.crank[0].segments if isinstance(s, Arc) and s.bulge < 0.0
    ]
    assert relief.centre == pytest.approx((L * share, 0.0), abs=1e-12 * L)
    assert relief.radius == pytest.approx(L * math.cos(b) * share, rel=1e-12)
    for end in (relief.start, relief.end):
        angle = abs(math.degrees(math.atan2(end[1], end[0])))
        assert angle == pytest.approx(90.0 - 180.0 / z, abs=1e-11)


@pytest.mark.parametrize(("z", "share"), [(8, 0.38), (10, 0.44), (12, 0.5), (16, 0.63), (24, 0.6)])
def test_a_small_disc_is_cut_down_to_a_sector(z: int, share: float) -> None:
    """Down to L - Rw less a clearance, and as wide as the motion or, of the smallest discs, wider:
    the recess's corners come within them beyond the motion's own angle."""
    found = made(z, roller_radius_mm=5.0, lock_radius_mm=share * L * math.sin(math.pi / z))
    assert found.outlines.relief == "sector"
    size = found.sizes
    (relief,) = [
        s
        for s in found.outlines.crank[0].segments
        if isinstance(s, Arc) and abs(s.radius - size.lock) > 1e-9
    ]
    assert relief.centre == pytest.approx((0.0, 0.0), abs=1e-12 * L)
    assert relief.radius == pytest.approx(L - size.rim - size.relief, rel=1e-12)
    wide = 0.5 * math.degrees(abs(relief.sweep))
    assert wide >= 90.0 - 180.0 / z - 1e-9
    corners = np.concatenate(list(corners_in_the_disc(z, 5.0, share)))
    far = float(np.degrees(np.abs(np.angle(corners))).max())
    assert wide >= far
    assert wide < max(far, 90.0 - 180.0 / z) + math.degrees(2.0 * size.relief / size.lock)


@pytest.mark.sampled(5)
@pytest.mark.parametrize("z", [3, 4, 6, 9, 24])
def test_the_locking_sector_of_an_internal_wheel(z: int) -> None:
    """Half width 90 deg - b opposite the roller, as far as the wheel's horns leave room."""
    found = made(z, "internal", roller_radius_mm=1.0)
    (contour,) = found.outlines.crank
    assert ends_meet(contour)
    assert polygon(contour, FLAT).is_valid
    (lock,) = [
        s
        for s in contour.segments
        if isinstance(s, Arc) and math.hypot(*s.centre) < 1e-9 * L and s.bulge > 0.0
    ]
    assert lock.radius == pytest.approx(found.sizes.lock, rel=1e-12)
    assert math.degrees(lock.sweep) <= 180.0 - 360.0 / z + 1e-9
    middle = np.add(lock.start, lock.end)
    roller = found.assembly.pin(0, np.zeros(1))[0] - [L, 0.0]
    cosine = float(middle @ roller) / math.hypot(*middle) / math.hypot(*roller)
    assert cosine == pytest.approx(-1.0, abs=1e-12)


# --- curved slots


def passed(found: Parts) -> Polygon:
    """Everything a roller, as wide as the slot, passes over in one cycle around the first slot, in
    the wheel's frame: M = L e^(-i psi) - R e^(-i (psi + phi)), and its circle in the dwell."""
    mechanism = found.assembly.mechanism
    spec, sign = mechanism.spec, found.assembly.sign
    z = spec.wheel.z
    natural = 180.0 - sign * 360.0 / z
    motion = math.radians(natural - spec.motion.alpha0_deg)
    R, step = L * mechanism.ratio, math.tau / z
    law = spec.motion.law
    # as densely at mid-motion as the roller stops there: its way is sharp
    x = np.linspace(-1.0, 1.0, 4001)
    u = 0.5 + 0.25 * x * (1.0 + x * x)
    phi = motion * (u - 0.5)
    psi = step * (np.array([law(float(v), 0).c[0] for v in u]) - 0.5)
    moving = L * np.exp(-1j * psi) - sign * R * np.exp(-1j * (psi + sign * phi))
    ways = [moving]
    for end in (-1, 1):
        t = np.linspace(motion / 2.0, math.pi, 1000)
        ways.append((L - sign * R * np.exp(-1j * end * sign * t)) * np.exp(-0.5j * end * step))
    way = np.concatenate((ways[1][::-1], ways[0], ways[2]))
    line = LineString(np.column_stack((way.real, way.imag)))
    return line.buffer(found.sizes.half_width, quad_segs=QUARTER)


def milled(found: Parts) -> Polygon:
    """The wheel (inside: its opening) less all places of the roller and the locking disc; of what
    is left the piece about the axis."""
    z, sign, size = found.assembly.mechanism.spec.wheel.z, found.assembly.sign, found.sizes
    way = passed(found)
    tools = [turned(way, math.tau * k / z) for k in range(z)]
    for k in range(z):
        a = math.tau * (k + 0.5) / z
        tools.append(disc(size.recess, L * math.cos(a), L * math.sin(a)))
    blank = disc(size.rim)
    if sign > 0.0:
        left = blank.difference(shapely.union_all(tools))
        return max(getattr(left, "geoms", [left]), key=lambda part: part.area)
    # The opening: islands of material in it fall out.
    return Polygon(shapely.union_all([blank, *tools]).exterior)


CURVED_SLOTS = [
    *[{"z": 6, "law": law} for law in LAWS if law in ("modified-sine", "4-5-6-7", "harmonic")],
    {"z": 6, "motion": Motion("sine-group", -0.1, ratio="matched")},
    {"z": 6, "motion": Motion("sine-group", 0.1, alpha0_deg=-40.0, ratio=0.5)},
    {"z": 4, "law": "cycloidal", "slot_clearance_mm": 0.1},
    {"z": 6, "motion": Motion("3-4-5", ratio=0.5)},
    {"z": 5, "gearing": "internal", "law": "harmonic"},
    {
        "z": 8,
        "gearing": "internal",
        "law": "cycloidal",
        "roller_radius_mm": 4.0,
        "lock_radius_mm": 0.0,
    },
    # Large rollers, whose circle in the dwell is long.
    {
        "z": 5,
        "motion": Motion("3-4-5", alpha0_deg=-26.0, ratio="matched"),
        "roller_radius_mm": 17.9,
        "slot_clearance_mm": 0.1,
    },
    {
        "z": 24,
        "gearing": "internal",
        "motion": Motion("cycloidal", ratio=0.124),
        "roller_radius_mm": 5.82,
    },
]


def worst(found: Parts, wanted: Polygon) -> float:
    """The greatest distance between both outlines, over one slot and its neighbours' halves."""
    shape, far = polygon(found.outlines.wheel, FLAT), 0.0
    for one, other in ((shape, wanted), (wanted, shape)):
        corners = shapely.get_coordinates(one.exterior)
        half = math.pi / len(found.assembly.slots)
        here = np.abs(np.arctan2(corners[:, 1], corners[:, 0])) < half
        points = shapely.points(corners[here])
        far = max(far, float(shapely.distance(other.exterior, points).max()))
    return far


@pytest.mark.long
@pytest.mark.parametrize("case", CURVED_SLOTS, ids=str)
def test_curved_slots_against_every_place_of_the_roller(case: dict) -> None:
    """On the mean, and at the worst place: there the flattened arcs of both polygons may differ by
    twice what each strays, and where two walls meet at a small angle by some times more."""
    found = made(**case)
    assert ends_meet(found.outlines.wheel)
    shape, wanted = polygon(found.outlines.wheel, FLAT), milled(found)
    assert shape.is_valid
    assert apart(found, wanted) < FLAT + CURVED * L
    assert worst(found, wanted) < 2.0 * (FLAT + CURVED * L)
