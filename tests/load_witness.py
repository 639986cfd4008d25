"""Loads by Newton and Euler: every body cut free, its balance solved as a 3 x 3 system.

The bodies are the wheel, the body that carries the roller (its pin does not turn in that body), and
each body that carries another. Each has two forces and a moment in balance; only the wheel has
mass. The forces on one body act reversed on the next, up to the torque on the input shaft. Work and
power are not used, so that they can be checked. 50 digits, lengths in units of the
centre distance, the wheel's axis the origin, the crank's at 1. Imports nothing of the program.
"""

from typing import NamedTuple

import machine_witness
from machine_witness import Front, fitted, linkage, motions
from witness import mp, to_radians


class Chain(NamedTuple):
    """The bodies that carry the roller: places and angles as functions of the input angle."""

    body: object  # angle of the body that carries the roller
    # contact point and force on the roller, input angle -> torque on the input shaft, force on the
    # shaft that carries the crank, and force of what guides the roller's body besides
    shaft: object
    sense: int  # which way the input shaft turns: 1 with the wheel, -1 against it
    # contact point and force on the roller, input angle -> place of the pin that the input shaft
    # carries, force on that pin, and force of what guides the roller's body besides
    pin: object = None


class Loads(NamedTuple):
    torque: object
    force: object
    shaft: object
    rubbing: object  # friction's force times the speed of sliding, per input radian
    sliding: object  # speed of the roller along the wall, positive outwards, over L and radian
    wheel_bearing: object
    crank_bearing: object
    guide: object  # None where the crank carries the roller


def speed(spec):
    """Of the input, rad/s."""
    return mp.mpf(spec.drive.n_rpm) * mp.pi / 30


def rate(f, x):
    return mp.diff(f, x, h=mp.mpf(10) ** -18)


def balance(*unknown, force, at):
    """Sizes of unknown forces (unit force, place) or couples (None, 1) that balance a known force.

    All moments are about the origin.
    """
    columns = [(0, 0, p) if d is None else (d.real, d.imag, cross(p, d)) for d, p in unknown]
    left = mp.matrix(3, 3)
    for j, column in enumerate(columns):
        for i in range(3):
            left[i, j] = column[i]
    right = mp.matrix([-force.real, -force.imag, -cross(at, force)])
    return list(mp.lu_solve(left, right))


def cross(a, b):
    a, b = mp.mpc(a), mp.mpc(b)
    return a.real * b.imag - a.imag * b.real


X, Y = mp.mpc(1), mp.mpc(0, 1)


def on_shaft(pin):
    """Torque and force on the input shaft, and the guide's force, from a force on its pin."""

    def shaft(x, contact, force):
        at, on, guide = pin(x, contact, force)
        p, q, torque = balance((X, 1), (Y, 1), (None, 1), force=on, at=at)
        return torque, mp.hypot(p, q), guide

    return shaft


def crank(g):
    """The body is the crank on the input shaft itself."""

    def shaft(x, contact, force):
        p, q, torque = balance((X, 1), (Y, 1), (None, 1), force=force, at=contact)
        return torque, mp.hypot(p, q), None

    return Chain(None, shaft, -g)


def coulisse(g, A, mid=0, r=None):
    """The body is a coulisse on the crank's axis; a block on the input crank drives it.

    ``mid`` is how far the input has turned at mid-motion from where the coulisse points ahead;
    ``r`` the input crank's length over L, without which the torque alone is known.
    """

    def on(v):  # from the crank's own axes, on which it points at the wheel at 0
        return 1 - g * (mp.conj(v) if g > 0 else v) * (r or mp.mpf(1) / 10)

    def shaft(x, contact, force):
        block, axis = on(A + mp.expj(mid + x)), on(A)
        way = (block - 1) / abs(block - 1)
        p, q, push = balance((X, 1), (Y, 1), (1j * way, block), force=force, at=contact)
        back = -push * 1j * way  # on the input crank
        torque = balance((X, axis), (Y, axis), (None, 1), force=back, at=block)[2]
        return (torque, mp.hypot(p, q), abs(push)) if r else (torque, abs(force), None)

    return Chain(None, shaft, -g)


def behind(g, place, way, axis, known=True):
    """A body on a parallel shaft at ``axis`` pushes the crank at a place along a way, by x.

    It turns against the crank. Unless its size is ``known`` the torque alone is.
    """

    def shaft(x, contact, force):
        at, along = place(x), way(x)
        p, q, push = balance((X, 1), (Y, 1), (along, at), force=force, at=contact)
        torque = balance((X, axis), (Y, axis), (None, 1), force=-push * along, at=at)[2]
        return (-torque, mp.hypot(p, q), abs(push)) if known else (-torque, abs(force), None)

    return Chain(None, shaft, -g)


def mesh(driver, driven, torque):
    """The torque on a gear that holds another with ``torque``; their pitch radii."""
    (push,) = [torque / driven]  # along the common tangent, about the driven wheel's axis
    return push * driver


def geared(g, front, mid, distance, driver):
    """Gears ``distance`` over L apart: ``driver(x)`` is the driver's share of it.

    The driven gear's curve on its own axes is what its pitch point has drawn on it.
    """

    def radius(x):
        return distance * (1 - driver(x))

    def turn(x):
        return -g * front.crank(mid + x)

    def way(x):
        drawn = rate(lambda y: radius(y) * mp.expj(-turn(y)), x) * mp.expj(turn(x))
        return drawn / abs(drawn)

    return behind(g, lambda x: 1 + radius(x), way, 1 + distance)


def ellipses(g, front, mid, keys, L):
    """Two equal ellipses about their foci, 2 p apart: the driver's radius towards the other."""
    e = front.e
    return geared(
        g,
        front,
        mid,
        keys.gear_distance_mm / L,
        lambda x: (1 - e * e) / (1 + e * mp.cos(mid + x)) / 2,
    )


def rolling(g, front, mid, keys, L):
    """Gears cut for a ratio: the pitch point divides the centre distance by the speeds."""

    def driver(x):
        speed = rate(front.crank, mid + x)
        return speed / (1 + speed)

    return geared(g, front, mid, keys.gear_distance_mm / L, driver)


def first_wheel(g, front, mid, keys, L):
    """A wheel with a crank of its own, without friction: its pin pushes across its slot."""
    l, distance_mm = mp.sin(front.first), keys.first_distance_mm
    distance = (distance_mm or 1) / L

    def pin(x):
        return 1 + distance * (1 - l * mp.expj(g * (mid + x)))

    def way(x):
        return 1j * (pin(x) - 1) / abs(pin(x) - 1)

    return behind(g, pin, way, 1 + distance, bool(distance_mm))


def gears(spec, g, front, mid):
    """The chain of a drive that turns the crank with gears or a first wheel."""
    kinds = {"elliptical-gears": ellipses, "noncircular-gears": rolling, "geneva-pair": first_wheel}
    if spec.drive.NAME not in kinds:
        return None
    return kinds[spec.drive.NAME](g, front, mid, spec.drive, mp.mpf(spec.given_distance_mm))


def sector(spec):
    """Slot, gears, slot: half angle b and ratio l of the slots, ratio u of the gears, their angle.

    Without a jump of speed u = l/(1 - l), and both halves of a step are b + u D/2.
    """
    D = to_radians(spec.drive.sector_deg)

    def ratio(b):
        return mp.sin(b) / (1 - mp.sin(b))

    step = mp.pi / spec.wheel.z
    b = mp.findroot(lambda b: b + ratio(b) * D / 2 - step, step / 2)
    return mp.sin(b), ratio(b), D


def slots_beside_gears(spec):
    """The wheel's angle and the roller of the slot at either end, mid-motion being the gears'."""
    l, u, D = sector(spec)

    def pin(x):
        return 1 - l * mp.expj(mp.sign(x) * D / 2 - x)

    def wheel(x):
        return mp.arg(pin(x)) + mp.sign(x) * u * D / 2

    def body(x):
        return mp.arg((pin(x) - 1) / -l)

    return crank(1)._replace(body=body), wheel, pin, mp.mpf(spec.given_distance_mm)


def in_gear(spec, deg):
    """The loads and the speed while gear sectors drive; None where a roller does."""
    _, u, D = sector(spec)
    if spec.drive_before:
        return in_gear_behind(spec, to_radians(deg), u, D)
    if abs(to_radians(deg)) > D / 2:
        return None
    torque, L = mp.mpf(spec.load.torque_Nm), mp.mpf(spec.given_distance_mm) / 1000
    driven = L / (1 + u)
    force, none = torque / driven, mp.mpf(0)
    shaft = mesh(u * driven, driven, torque)
    return Loads(torque, force, shaft, none, none, force, force, None), u


def in_gear_behind(spec, x, u, D):
    """The loads in gear with a drive before, which pushes the crank with the loaded gear."""
    front = Front(spec.drive_before)
    if abs(front.crank(x)) > D / 2:
        return None
    L = mp.mpf(spec.given_distance_mm) / 1000
    w = mp.mpf(spec.drive.n_rpm) * mp.pi / 30
    bend = u * mp.diff(front.crank, x, 2, h=mp.mpf(10) ** -15)
    torque = mp.mpf(spec.load.inertia_kgm2) * w * w * bend + mp.mpf(spec.load.torque_Nm)
    force, none = torque * (1 + u) / L, mp.mpf(0)
    chain, *_ = in_series(spec, crank(1), None, None, mp.mpf(spec.given_distance_mm))
    shaft, bearing, push = chain.shaft(x, 1 / (1 + u), -1j * force)
    size = abs(force)
    result = Loads(torque, size, shaft * L * chain.sense, none, none, size, bearing, push)
    return result, u * rate(front.crank, x)


def planet(spec):
    """The body is a planet on a carrier, in mesh with a fixed gear about the crank's axis."""
    keys, z = spec.drive, spec.wheel.z
    u = mp.mpf(2 * z) / (z - 2)
    c = 1 + u if keys.fixed == "sun" else 1 - u
    l = mp.sin(mp.pi / z)
    rp = l / (c * c - 1) if keys.planet_ratio == "shockless" else mp.mpf(keys.planet_ratio)
    R0 = l + rp
    fixed = R0 * u / (u + 1) if keys.fixed == "sun" else R0 * u / (u - 1)  # pitch radius

    def pin(x, contact, force):
        arm = -mp.expj(-x)
        at, mesh = 1 + R0 * arm, 1 + fixed * arm
        a, b, push = balance((X, at), (Y, at), (1j * arm, mesh), force=force, at=contact)
        return at, -mp.mpc(a, b), abs(push)

    return Chain(lambda x: -c * x, on_shaft(pin), -1, pin)


def groove(g, pin):
    """The body slides along the crank, and its roller runs in a fixed groove."""

    def shaft(x, contact, force):
        back, torque, hold = on_crank(x, contact, force)
        return torque, abs(back), abs(hold)

    def on_crank(x, contact, force):
        way = rate(pin, x)
        arm = (pin(x) - 1) / abs(pin(x) - 1)
        wall = 1j * way / abs(way)
        across = 1j * arm
        hold, push, couple = balance(
            (wall, pin(x)), (across, pin(x)), (None, 1), force=force, at=contact
        )
        back = -push * across
        torque = balance((X, 1), (Y, 1), (None, 1), force=back, at=pin(x))[2]
        return back, torque + couple, hold

    def held(x, contact, force):  # force and couple as one force on another line
        back, torque, hold = on_crank(x, contact, force)
        return 1 + 1j * back * torque / abs(back) ** 2, back, abs(hold)

    return Chain(None, shaft, -g, held)


def link(spec, entry_deg, exit_deg):
    """A four-bar's or slider-crank's coupler: the chain, wheel and pin, and L in millimetres."""
    keys, kind = spec.drive, spec.drive.NAME
    path, b = linkage(kind, keys), mp.pi / spec.wheel.z
    entry, exit_, centre = fitted(path, b, to_radians(entry_deg), to_radians(exit_deg))
    middle = (entry + exit_) / 2
    sense = 1 if mp.arg((path(exit_) - centre) / (path(entry) - centre)) > 0 else -1

    def turned(z):
        return z if sense > 0 else mp.conj(z)

    def world(z):
        return turned((z - centre) / -centre)

    def way(v):
        return turned(v / -centre)

    def pin(x):
        return world(path(middle + x))

    first = mp.arg(pin(entry - middle))

    def wheel(x):
        return mp.arg(pin(x) * mp.expj(-first)) - b

    def joint(x):
        return mp.mpf(keys.crank_mm) * mp.expj(middle + x)

    def coupler(x):  # its angle on the path's axes: C is an arm at a fixed angle from A
        return mp.arg((path(middle + x) - joint(x)) / mp.expj(to_radians(keys.point_deg)))

    def held(x, contact, force):
        A = joint(x)
        if kind == "four-bar":  # the rocker pulls along itself
            B = A + mp.mpf(keys.coupler_mm) * mp.expj(coupler(x))
            hold = B - mp.mpf(keys.ground_mm)
        else:  # the slider's guide pushes across itself
            B, hold = A + mp.mpf(keys.rod_mm) * mp.expj(coupler(x)), mp.mpc(0, 1)
        at = world(A)
        hold = way(hold) / abs(way(hold))
        p, q, third = balance((X, at), (Y, at), (hold, world(B)), force=force, at=contact)
        return at, -mp.mpc(p, q), abs(third)

    def angle(x):
        return sense * coupler(x)

    return Chain(angle, on_shaft(held), sense, held), wheel, pin, abs(centre)


def in_series(spec, chain, wheel, pin, distance_mm):
    """The machine whose input shaft another drive turns: a crank that its own pin loads.

    A crank that carries its roller is loaded at the contact, and has no guide but the push.
    """
    before, none = spec.drive_before, mp.mpf(0)
    g = -1 if spec.wheel.NAME == "internal" else 1  # the front's crank points as the wheel's does
    mirrored = g * chain.sense > 0
    front = Front(before)
    kinds = {"elliptical-gears": ellipses, "noncircular-gears": rolling}
    if before.NAME in kinds:
        first = kinds[before.NAME](g, front, none, before, distance_mm)
    else:
        first = coulisse(g, front.A, none, before.input_crank_mm / distance_mm)

    def shaft(x, contact, force):
        at, on, guide = contact, force, None
        if chain.pin:
            at, on, guide = chain.pin(front.crank(x), contact, force)
        if mirrored:  # a shaft that turns with the wheel, seen from its other side
            at, on = mp.conj(at), mp.conj(on)
        torque, bearing, push = first.shaft(x, at, on)
        return -torque if mirrored else torque, bearing, guide if chain.pin else push

    def body(x):
        return chain.body(front.crank(x))

    sense = -first.sense if mirrored else first.sense
    whole = Chain(body, shaft, sense)
    return whole, lambda x: wheel(front.crank(x)), lambda x: pin(front.crank(x)), distance_mm


def machine(spec, near=None, number=0):
    """The chain, wheel's angle and roller's place of an engagement, and L in millimetres."""
    if spec.drive_before:
        return in_series(spec, *machine(spec.replace(drive_before=None), near, number))
    if near:
        return link(spec, *near)
    kind = spec.drive.NAME
    g = -1 if spec.wheel.NAME == "internal" else 1
    if kind == "gear-sector":
        return slots_beside_gears(spec)
    motion = motions(spec)[number]
    wheel, pin = motion.wheel, motion.path
    if kind == "epicyclic":
        chain = planet(spec)
    elif kind == "cam":
        chain = groove(g, pin)
    else:
        front, mid = Front(spec.drive), motion.mid
        chain = gears(spec, g, front, mid)
        if chain is None and front.A:
            r = spec.drive.input_crank_mm
            chain = coulisse(g, front.A, mid, r and r / mp.mpf(spec.given_distance_mm))
        chain = chain or crank(g)
    if chain.body is None:
        chain = chain._replace(body=lambda x: mp.arg((pin(x) - 1) * -g))
    return chain, wheel, pin, mp.mpf(spec.given_distance_mm)


def loads(spec, chain, wheel, pin, distance_mm, deg):
    """The loads at an input angle in degrees from mid-motion; torques in N m, force in N."""
    x = to_radians(deg)
    L = distance_mm / 1000
    roller_mm = spec.size.roller_radius_mm
    r = (distance_mm / 20 if roller_mm is None else mp.mpf(roller_mm)) / distance_mm
    f = mp.mpf(spec.load.friction)
    w = mp.mpf(spec.drive.n_rpm) * mp.pi / 30
    speed = rate(wheel, x)
    bend = mp.diff(wheel, x, 2, h=mp.mpf(10) ** -15)
    torque = mp.mpf(spec.load.inertia_kgm2) * w * w * bend + mp.mpf(spec.load.torque_Nm)
    # The slot's tangent: the way of the roller's centre as the wheel sees it.
    place, turn = pin(x), mp.expj(wheel(x))
    seen = rate(lambda t: pin(t) * mp.expj(-wheel(t)), x) * turn
    tangent = seen / abs(seen)
    # The wall that bears pushes the wheel the way of the torque it needs.
    normal = 1j * tangent
    normal = normal if cross(place, normal) * torque > 0 else -normal
    contact = place + r * normal
    roller = rate(pin, x) + 1j * rate(chain.body, x) * (contact - place)
    rubs = ((roller - 1j * speed * contact) * mp.conj(tangent)).real
    unit = normal + f * mp.sign(rubs) * tangent  # force on the wheel for a pin force of 1
    # Wheel: bearing and torque of the load; its moment fixes the pin force.
    p, q, held = balance((X, 0), (Y, 0), (None, 1), force=unit, at=contact)
    force = -torque / held / L
    shaft, crank_bearing, guide = chain.shaft(x, contact, -force * unit)
    outwards = rubs * mp.sign((tangent * mp.conj(place)).real)
    wheel_bearing = abs(force) * mp.hypot(p, q)
    lost = f * force * abs(rubs) * L
    sped = mp.mpf(0)  # torque that turns the wheel with its carrier: test_carousel.py has its proof
    if spec.drive.NAME == "carousel":
        sped = mp.mpf(spec.load.inertia_kgm2) * w * w * bend * -chain.sense
    result = Loads(
        torque,
        force,
        shaft * L * chain.sense + sped,
        lost,
        outwards * L,
        wheel_bearing,
        crank_bearing,
        guide,
    )
    return result, speed


def on_the_sphere(spec, deg):
    """The loads in space: a conical roller that meets the slot's wall at right angles to its path.

    Pin and wheel on the unit sphere, the wheel's axis up, the crank's in the xz plane.
    """
    S = to_radians(spec.wheel.axes_deg)
    th = mp.asin(mp.sin(S) * mp.sin(mp.pi / spec.wheel.z))
    a, L = to_radians(deg), mp.mpf(spec.given_distance_mm) / 1000
    roller_mm = spec.size.roller_radius_mm
    r = mp.mpf(1) / 20 if roller_mm is None else mp.mpf(roller_mm) / 1000 / L

    def place(t):
        return machine_witness.on_the_sphere(S, th, t)

    def wheel(t):
        x, y, _ = place(t)
        return mp.atan2(y, x)

    u, psi = place(a), wheel(a)
    psi1, psi2 = rate(wheel, a), mp.diff(wheel, a, 2, h=mp.mpf(10) ** -15)
    w = mp.mpf(spec.drive.n_rpm) * mp.pi / 30
    torque = mp.mpf(spec.load.inertia_kgm2) * w * w * psi2 + mp.mpf(spec.load.torque_Nm)
    side = mp.sign(torque)
    normal = [-side * mp.sin(psi), side * mp.cos(psi), mp.mpf(0)]
    tangent = vector(u, normal)
    at = [p + r * n for p, n in zip(u, normal, strict=True)]
    turns = [-mp.sin(S), mp.mpf(0), -mp.cos(S)]  # the crank turns against the wheel
    spin = [t - k for t, k in zip(turns, (0, 0, psi1), strict=True)]
    rubs = dot(vector(spin, at), tangent)
    rub = mp.mpf(spec.load.friction) * mp.sign(rubs)
    unit = [n + rub * t for n, t in zip(normal, tangent, strict=True)]
    force = torque / vector(at, unit)[2] / L
    shaft = dot(vector(at, unit), turns) * force * L
    return torque, force, shaft, psi1


def vector(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def dot(a, b):
    return mp.fdot(a, b)
