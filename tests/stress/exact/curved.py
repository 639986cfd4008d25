"""Curved slots: motion, peaks, pitch curve, and its chords for a tolerance."""

import math

import numpy as np
from witness import LAWS as LAW_WITNESSES
from witness import SIGN, krasniqi, mp, to_radians
from words import Motion, law

from exact.compared import NAMES, PEAKS, Found, angles, compare, compare_peaks
from exact.fronts import FRONTS, Plain, drive_cases, from_file, spec_of
from exact.laws import Points, Series, point_cases
from exact.rates import exactly, variations
from exact.table import LIMIT, strictly, ulps, unit
from geneva_cli.errors import GenevaError
from geneva_cli.motion import machine_spec as machine_spec
from geneva_cli.motion import registry
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.path_and_motion import MOTION_MIN
from geneva_cli.motion.peaks import peaks
from geneva_cli.parts.slots.slot_profile import slot
from geneva_cli.parts.slots.slot_sampling import nodes


def law_files(table, sample):
    """Curved slots of a law from a file."""
    for u, s in point_cases(sample):
        series = Points(u, s)
        read_points = from_file(zip(u, s, strict=True), registry.law("table"), "points")
        motion = machine_spec.Motion(law("table", read_points), alpha0_deg=-10.0)
        mechanism = strictly(build, spec_of(6, "external", "crank", (), 1, motion))
        where = f"{len(u)} points, the second {u[1]!r},{s[1]!r}"
        args = (series, series.peaks(), (), Plain, "external", 6, None, where)
        laid_out(table, "curved, table", mechanism, *args)


def curved(table, sample, rng, name, shape):
    """Curved slots of a law behind every drive, with alpha0 up to its limits."""
    series = Series(krasniqi(shape) if shape else LAW_WITNESSES[name])
    top = series.peaks()
    cases = [
        (z, gearing, kind, values)
        for gearing in SIGN
        for kind, values in drive_cases()
        if not hasattr(FRONTS[kind], "fits")
        for z in ((3, 24) if sample else (3, 6, 25, 10**6))
    ]
    for case in rng.sample(cases, 1) if sample else cases:
        curved_one(table, name, shape, series, top, *case, sample, rng)


def curved_one(table, name, shape, series, top, z, gearing, kind, values, sample, rng):
    machine, front = f"curved, {name}", FRONTS[kind]
    exact_values = exactly(values)
    half_crank = mp.pi / 2 - SIGN[gearing] * mp.pi / z
    natural = 2 * front.input(exact_values, half_crank) * 180 / mp.pi
    n = float(natural)
    alphas = [rng.uniform(n - 359.0, n - 1.0), n - 1e-9, n - 360.0 + 1e-9]
    if MOTION_MIN < n < 360.0 - MOTION_MIN:
        alphas = [0.0, *alphas]
    for alpha0 in rng.sample(alphas, 2) if sample else alphas:
        ratio = rng.choice([None, 1e-6, 0.3, 0.999999999])
        L = rng.choice([1e-6, 1e-3, 1.0, 100.0, 12345.678, 1e6])
        where = f"{gearing} z={z} {kind}" + "".join(f" {v!r}" for v in values)
        where += f" lambda={shape!r} alpha0={alpha0!r} ratio={ratio} L={L:g}"
        motion = Motion(law=name, lambda_=shape, alpha0_deg=alpha0, ratio=ratio)
        try:
            mechanism = strictly(build, spec_of(z, gearing, kind, values, 1, motion, L))
        except GenevaError as error:
            table.fault(f"{machine} {where}: refused: {error}")
            continue
        engagement = mechanism.engagements[0]
        motion_deg = natural - mp.mpf(alpha0)
        u = max(unit(natural), math.ulp(alpha0), unit(motion_deg))
        h = mp.mpf(10) ** -40
        here = front.input(exact_values, half_crank)
        by = [
            2.0 * abs(float((front.input(moved, half_crank) - here) / h)) * math.ulp(v)
            for moved, v in zip(variations(exact_values, h), values, strict=True)
        ]
        cond = max([0.0, *[math.degrees(b) / u for b in by]])
        table.add(
            (machine, "motion angle"), ulps([engagement.motion_deg], [motion_deg], u), cond, where
        )
        laid_out(
            table, machine, mechanism, series, top, exact_values, front, gearing, z, ratio, where
        )


def laid_out(table, machine, mechanism, series, top, values, front, gearing, z, ratio, where):
    """Motion, peaks and slot for the motion angle that the program has."""
    engagement = mechanism.engagements[0]
    whole, step = to_radians(engagement.motion_deg), 2 * mp.pi / z
    entry = to_radians(engagement.entry_deg)

    def at(x):
        s = series.at((x - entry) / whole)
        return [step * (s[0] - mp.mpf(1) / 2), *[step * s[k] / whole**k for k in range(1, 6)]]

    x = angles(engagement, 7)
    # At a joint of the law a jump is read off on one side; keep a little off.
    joints = [float(a) for a, _ in series.pieces[1:]]
    u = (x - engagement.entry_deg) / engagement.motion_deg
    for j in joints:
        x, u = x[np.abs(u - j) > 1e-12], u[np.abs(u - j) > 1e-12]
    exact = [at(to_radians(v)) for v in x]
    scale = {"position": step, "power": step**2 / whole**3}
    scale |= {n: step / whole**k for k, n in enumerate(NAMES) if k}
    size = {n: top[n][0] * scale[n] for n in (*NAMES, "power")}
    own = np.maximum(np.array([math.ulp(v) for v in x]), math.ulp(engagement.entry_deg))
    condition = []
    for k, name in enumerate(NAMES):
        slope = np.array([abs(float(e[k + 1])) for e in exact])
        condition.append(slope * np.radians(own) / unit(size[name]))
    if hasattr(series, "moves"):
        for k, by in enumerate(series.moves(u)):
            by = by * float(scale[NAMES[k]]) / unit(size[NAMES[k]])
            condition[k] = np.maximum(condition[k], by)
    compare(table, machine, engagement, x, exact, size, condition, where)
    found = {}
    for name in PEAKS:
        places = [Found(c.size, entry + c.x * whole, c.shift * whole) for c in top[name][1]]
        found[name] = (size[name], places)
    got = strictly(peaks, engagement)
    more = peaks_move(series, top, size, scale) if hasattr(series, "moves") else None
    compare_peaks(table, machine, got, found, whole / 2, where, more)
    slot_points(table, machine, mechanism, x, exact, values, front, gearing, z, ratio, where)


def peaks_move(series, top, size, scale):
    """What the last place of any one point moves each peak, in units in the last place."""
    places = {name: float(top[name][1][0].x) for name in PEAKS}
    moves = {name: [by[0] for by in series.moves(np.array([u]))] for name, u in places.items()}
    out = {
        name: moves[name][k] * float(scale[name]) / unit(size[name])
        for k, name in enumerate(NAMES)
        if k
    }
    # a product moves with the greater relative move of its factors
    v, a = (max(1.0, out[name]) for name in ("velocity", "acceleration"))
    return out | {"power": max(v, a)}


def pitch_curve(values, front, gearing, l):
    """The pin in the wheel's frame and its rate, from the input angle and the wheel's angle."""
    g = SIGN[gearing]

    def at(x, psi, rate):
        f, f1 = front.crank(values, x)[:2]
        C = g * l * mp.expj(-g * f)
        turned = mp.expj(-psi)
        return (1 - C) * turned, (1j * g * C * f1 - 1j * rate * (1 - C)) * turned

    return at


def slot_points(table, machine, mechanism, x, exact, values, front, gearing, z, ratio, where):
    """The slot's pitch curve in millimetres."""
    l = mp.sin(mp.pi / z) if ratio is None else mp.mpf(ratio)
    wheel = max(abs(float(e[0])) for e in exact)
    curve = pitch_curve(values, front, gearing, l)
    L = mp.mpf(mechanism.center_distance_mm)
    points = [curve(to_radians(v), e[0], e[1]) for v, e in zip(x, exact, strict=True)]
    far = unit(L * max(abs(p) for p, _ in points))
    got = strictly(slot, mechanism, x)
    if not (np.isfinite(got.left).all() and np.isfinite(got.right).all()):
        table.fault(f"{machine} {where}: NaN or infinity in a flank")
    own = np.maximum(
        np.array([math.ulp(v) for v in x]), math.ulp(mechanism.engagements[0].entry_deg)
    )
    h = mp.mpf(10) ** -40
    place = [f"{where} at {v:.17g}" for v in x]
    near = []
    for (p, _), v, e, d in zip(points, x, exact, own, strict=True):
        steps = [s * to_radians(d) for s in (-1, 1)]
        near.append((p, [curve(to_radians(v) + s, e[0] + s * e[1], e[1])[0] for s in steps]))
    for i, part in enumerate(("real", "imag")):
        # the whole change: its first order can vanish where the second is large
        c = (
            np.array([max(abs(float(L * getattr(p - n, part))) for n in by) for p, by in near])
            / far
        )
        # a law of lambda = 10 turns the wheel several times round: a unit of that angle, too
        c = np.maximum(c, math.ulp(wheel) * float(L * max(abs(p) for p, _ in points)) / far)
        for moved, v in zip(variations(values, h), values, strict=True):
            other = pitch_curve(moved, front, gearing, l)
            by = [
                abs(float(L * getattr(other(to_radians(a), e[0], e[1])[0] - p, part) / h))
                for a, e, (p, _) in zip(x, exact, points, strict=True)
            ]
            c = np.maximum(c, np.array(by) * math.ulp(float(v)) / far)
        error = ulps(got.centre[:, i], [L * getattr(p, part) for p, _ in points], far)
        table.add((machine, f"slot {'xy'[i]}"), error, c, place)


def chords(table, sample, rng, name):
    """The slot's chords for a tolerance: really nearer than it, or refused in clear words."""
    for L in (1.0,) if sample else (1e-6, 1.0, 100.0, 1e6):
        for tolerance in (1.0, 1e-3) if sample else (1.0, 1e-3, 1e-6, 1e-9):
            # the finest tolerances on the largest wheels take minutes to be refused
            if L / tolerance <= 1e9:
                chord_case(table, name, L, tolerance, rng)


def chord_case(table, name, L, tolerance, rng):
    where = f"z=6 L={L:g} tolerance={tolerance:g}"
    mechanism = strictly(build, spec_of(6, "external", "crank", (), 1, Motion(law=name), L))
    try:
        x = strictly(nodes, mechanism, tolerance)
    except GenevaError as error:
        if "--tolerance" not in str(error):
            table.fault(f"chords {name} {where}: refused without naming --tolerance: {error}")
        return
    got = strictly(slot, mechanism, x).centre
    engagement, series = mechanism.engagements[0], Series(LAW_WITNESSES[name])
    curve = pitch_curve((), Plain, "external", mp.mpf(1) / 2)
    whole, entry = to_radians(engagement.motion_deg), to_radians(engagement.entry_deg)
    for i in rng.sample(range(len(x) - 1), min(len(x) - 1, 12)):
        a, b = (mp.mpc(*got[k].tolist()) for k in (i, i + 1))
        for t in (0.21, 0.44, 0.5, 0.57, 0.83):  # not the sixteenths that the program looks at
            at = to_radians(x[i]) + (to_radians(x[i + 1]) - to_radians(x[i])) * t
            s = series.at((at - entry) / whole)
            p = L * curve(at, 2 * mp.pi / 6 * (s[0] - mp.mpf(1) / 2), 0)[0]
            along = (p - a) * mp.conj(b - a) / abs(b - a) if b != a else 0
            share = min(max(along.real / abs(b - a), 0), 1) if b != a else 0
            off = float(abs(p - a - share * (b - a)))
            # in units of the tolerance, which 16 ulp of the slot's size may blur
            blur = 16 * math.ulp(L) / tolerance
            table.add(
                (f"chords, {name}", "tolerance"), LIMIT * (off / tolerance - blur), 0.0, where
            )
