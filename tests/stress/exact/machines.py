"""Motion, peaks and slots of a machine, read from a spec as a user writes it, and a witness's."""

import math
import tempfile

import machine_witness
import numpy as np
from witness import mp, to_radians
from words import load

from exact.cases import MACHINES, NEAR_PLACES
from exact.table import strictly, ulps, unit
from geneva_cli.errors import GenevaError
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.peaks import peaks
from geneva_cli.numerics.tolerances import TIE
from geneva_cli.parts.slots.slot_profile import flanks
from geneva_cli.spec.schema import fields

NAMES = ("position", "velocity", "acceleration", "jerk")
PEAKS = ("velocity", "acceleration", "jerk", "power")
# from the derivatives 0..5 of the wheel's angle: a quantity with its first two derivatives
PICK = {
    "position": lambda p: (p[0], p[1], p[2]),
    "velocity": lambda p: (p[1], p[2], p[3]),
    "acceleration": lambda p: (p[2], p[3], p[4]),
    "jerk": lambda p: (p[3], p[4], p[5]),
    "power": lambda p: (p[1] * p[2], p[2] ** 2 + p[1] * p[3], 3 * p[2] * p[3] + p[1] * p[4]),
}


def machines(table, sample, name):
    """All machines of one name."""
    built = 0
    for text in MACHINES[name][:1] if sample else MACHINES[name]:
        mechanism = read(text)
        if mechanism is not None:
            built += 1
            compare_machine(table, name, text, mechanism, sample)
    if not built:
        table.fault(f"{name}: every spec was refused")


def read(text):
    """The mechanism, or None where the values do not go together."""
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(text)
        file.flush()
        try:
            return strictly(load, file.name)
        except GenevaError:
            return None


def varied_specs(spec):
    """The spec with one number that shapes the motion moved by a unit, for each of them."""
    common = {field.key for field in fields(Drive)}
    for part in ("wheel", "drive", "motion"):
        for key, v in spec.table(part).items():
            if isinstance(v, float) and v and key not in common:
                try:
                    yield spec.with_(f"{part}.{key}", math.nextafter(v, math.inf))
                except GenevaError:  # the greatest value that may be
                    yield spec.with_(f"{part}.{key}", math.nextafter(v, 0.0))


def compare_machine(table, name, text, mechanism, sample):
    where = " ".join(text.split())
    specs = [mechanism.spec, *varied_specs(mechanism.spec)]
    near = NEAR_PLACES.get(text)
    witnesses = [
        [machine_witness.on_path(s, *near)] if near else machine_witness.motions(s) for s in specs
    ]
    for j, engagement in enumerate(mechanism.engagements):
        place = where if len(mechanism.engagements) == 1 else f"{where} engagement {j + 1}"
        w, *moved = [m[j] for m in witnesses]
        x = angles(engagement)[:: 3 if sample else 1]
        joints, apart = joints_of(w), 1e-11 * (w.exit - w.entry)
        # a jump is read off on one side of them
        x = x[[all(abs(to_radians(v) - joint) > apart for joint in joints) for v in x]]
        exact = [w.derivatives(v) for v in x]
        by = [[m.derivatives(v) for v in x] for m in moved]
        turned = max(
            math.ulp(v) for v in (engagement.entry_deg, engagement.exit_deg, engagement.mid_deg)
        )
        step = np.radians(np.maximum([math.ulp(v) for v in x], turned))
        found = strictly(peaks, engagement)
        peak = {"position": w.b}
        for quantity in PEAKS:
            p, pick = getattr(found, quantity), PICK[quantity]
            here = abs(pick((*w.derivatives(p.at_deg), 0))[0])
            # nowhere is it greater than what was found, and what was found is there, or where it
            # is greater by less than 1e-13: of tops so nearly equal the first place is told
            at, top = greatest_top(w, pick, x, exact, p.at_deg, here)
            peak[quantity] = max(top, *[abs(pick((*e, 0))[0]) for e in exact])
            u = unit(peak[quantity])
            c = [float(size_moves(w, moved, pick, v, turned) / u) for v in (at, p.at_deg)]
            table.add((name, f"peak {quantity}"), ulps([p.max], [peak[quantity]], u), c[0], place)
            less = max(0, top * (1 - 2 * mp.mpf(TIE)) - here)
            table.add((name, f"peak {quantity}, size there"), float(less / u), c[1], place)
            if all(abs(to_radians(p.at_deg) - v) > 1e-8 for v in (w.entry, w.exit, *joints)):
                off, shift = place_of_top(w, moved, pick, p.at_deg, exact)
                if p.at_deg == 0.0 and off < 1e-11:  # pieces of a search meet there: it is as great
                    off = 0
                half = unit(w.exit - w.entry) / 2
                shift = max(shift, to_radians(turned))
                row = name, f"peak {quantity}, angle"
                table.add(row, float(off / half), float(shift / half), place)
        condition = []
        for k, quantity in enumerate(NAMES):
            u = unit(peak[quantity])
            c = np.array([abs(float(e[k + 1])) for e in exact]) * step / u
            for other in by:
                change = [abs(float(b[k] - a[k])) for a, b in zip(exact, other, strict=True)]
                c = np.maximum(c, np.array(change) / u)
            condition.append(c)
        compare(table, name, engagement, x, exact, peak, condition, place)
        if mechanism.spec.motion and isinstance(w, machine_witness.LawMotion) and name != "cam":
            compare_slot(table, name, mechanism, [w, *moved], x, step, place)


def joints_of(w):
    """The places, in radians, where pieces of the motion's law meet."""
    if not hasattr(w.law, "pieces"):
        return []
    return [w.entry + end * w.whole for _, end, *_ in w.law.pieces[:-1]]


def place_of_top(w, moved, pick, deg, exact):
    """How far a told place is from where the slope is 0; what moves that by one unit."""
    ends = [mp.degrees(end) for end in (w.entry, w.exit)]
    beside = [deg + (end - deg) / 4**k for end in ends for k in range(1, 9)]
    each = (*exact, *(w.derivatives(float(v)) for v in beside))
    slope_unit = unit(max(abs(pick((*e, 0))[1]) for e in each))

    def slope(motion, at_deg):
        return pick((*motion.derivatives(at_deg), 0))[1]

    here, h = slope(w, deg), 1e-6
    bend = abs(slope(w, deg + h) - slope(w, deg - h)) / (to_radians(deg + h) - to_radians(deg - h))
    if not bend:
        return mp.mpf(0), mp.mpf(0)
    by_keys = [abs(slope(m, deg) - here) for m in moved]
    return abs(here) / bend, max([mp.mpf(slope_unit), *by_keys]) / bend


def compare_slot(table, name, mechanism, witnesses, x, step, where):
    """The slot's pitch curve in millimetres: the pin's place in the wheel's frame."""
    L = mp.mpf(mechanism.center_distance_mm)

    def at(w, rad):
        return L * w.path(rad) * mp.expj(-w.wheel(rad))

    w, *moved = witnesses
    points = [at(w, to_radians(v)) for v in x]
    far = unit(max(map(abs, points)))
    centre, *walls = strictly(flanks, mechanism, x)
    if not np.isfinite(walls).all():
        table.fault(f"{name} {where}: NaN or infinity in a flank")
    turned = math.ulp(float(w.b)) * float(max(map(abs, points)))  # by a unit of the wheel's angle
    for i, part in enumerate(("real", "imag")):
        condition = []
        for v, d, p in zip(x, step, points, strict=True):
            near = [at(w, to_radians(v) + s * mp.mpf(float(d))) for s in (-1, 1)]
            near += [at(m, to_radians(v)) for m in moved]
            by = [abs(float(getattr(p - n, part))) for n in near]
            condition.append(max([turned, *by]) / far)
        error = ulps(centre[:, i], [getattr(p, part) for p in points], far)
        table.add((name, f"slot {'xy'[i]}"), error, np.array(condition), where)


def size_moves(w, moved, pick, deg, turned):
    """What one unit of a place, of the engagement's own or of a key moves a size by there."""
    size, slope = pick((*w.derivatives(deg), 0))[:2]
    by_keys = [abs(abs(pick((*m.derivatives(deg), 0))[0]) - abs(size)) for m in moved]
    return max([abs(slope) * to_radians(max(math.ulp(deg), turned)), *by_keys])


def greatest_top(w, pick, x, exact, at_deg, told):
    """A peak's place and size, or those of another top between two of the places x."""
    here, known = (at_deg, told), [pick((*e, 0))[:2] for e in exact]
    for a, b, (p, s), (q, t) in zip(x, x[1:], known, known[1:], strict=False):
        # no cubic with these slopes has a higher top
        reach = max(abs(p), abs(q)) + to_radians(b - a) * max(abs(s), abs(t))
        if s * t < 0 < p * s and not a <= at_deg <= b and reach > told:
            top = mp.findroot(
                lambda v: pick((*w.derivatives(v), 0))[1],
                (a, b),
                solver="anderson",
                tol=1e-30,
                verify=False,
            )
            size = abs(pick((*w.derivatives(float(top)), 0))[0])
            here = max(here, (float(top), size), key=lambda found: found[1])
    return here


def angles(engagement):
    """Input angles in degrees, ascending: evenly, and close to both ends, the middle, the cuts."""
    half = []
    for end in (engagement.entry_deg, engagement.exit_deg):
        near = [end]
        for _ in range(3):
            near.append(math.nextafter(near[-1], 0.0))
        half += near
        # 1e-15 rad is less than a double's step at most ends; 1e-13 degrees always more
        half += [end - math.copysign(d, end) for d in (1e-13, 1e-9, 1e-5, 0.01, 0.4999999, 0.51)]
        half += [end * t for t in (0.7499999999, 0.75, 0.7500000001, 1e-3, 1e-6, 1e-9, 1e-15)]
        half += [math.copysign(t, end) for t in (math.degrees(1e-15), 1e-15, 1e-12, 1e-4)]
        half += [end * (i + 0.37) / 5 for i in range(5)]
    inside = {x for x in half if engagement.entry_deg <= x <= engagement.exit_deg}
    return np.array(sorted({0.0, *inside}))


def values_at(engagement, x):
    """Position to jerk by each route through the program."""
    routes = [
        engagement.motion(x, 3).derivatives(),
        engagement.motion.derivatives(x),
        engagement.motion.derivatives(x[:-1]),
    ]
    some = x[:: max(1, len(x) // 7)]
    return routes, some, [engagement.motion(float(v), 3).derivatives() for v in some]


def compare(table, machine, engagement, x, exact, peak, condition, where):
    """Position to jerk at the angles x, by every route."""
    routes, some, numbers = strictly(values_at, engagement, x)
    place = [f"{where} at {v:.17g}" for v in x]
    for k, name in enumerate(NAMES):
        u, values = unit(peak[name]), [e[k] for e in exact]
        for route in routes:
            n = len(route[k])
            error = ulps(route[k], values[:n], u)
            table.add((machine, name), error, condition[k][:n], place[:n])
        at = np.searchsorted(x, some)
        one = ulps([n[k] for n in numbers], [values[i] for i in at], u)
        table.add((machine, name), one, condition[k][at], [place[i] for i in at])
