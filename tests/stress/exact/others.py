"""What is no wheel of radial slots behind a front: specs as a user writes them."""

import math
import tempfile

import machine_witness
import numpy as np
from test_machines import CASES, ON_PATH
from witness import mp, to_radians
from words import LAWS, load

from exact.compared import NAMES, PEAKS, PICK, angles, compare
from exact.rates import NEAR_1
from exact.table import strictly, ulps, unit
from geneva_cli.errors import GenevaError
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.peaks import peaks
from geneva_cli.numerics.tolerances import TIE
from geneva_cli.spec.schema import fields

# Four-bars whose wheel's motion is short, or whose wheel is near: with places near which their
# wheel's entry and exit are.
FOUR_BAR = (
    "wheel.z = {}\ndrive = {{kind = 'four-bar', crank_mm = {}, ground_mm = {}, coupler_mm = {}, "
    "rocker_mm = {}, point_mm = {}, point_deg = {}}}"
)
NEAR_PLACES = {
    FOUR_BAR.format(12, 20, 100, 100, 60, 30, 100): (89.65, 252.03),
    **{CASES[name]: ON_PATH[name] for name in ON_PATH if name in CASES},
}

# The point moves 17 times slower than its links there: what rounds is larger than what is left,
# while a change of the links moves the wheel, too.
HARD = {FOUR_BAR.format(5, 35, 90, 80, 95, 120, 25): (295.13, 300.24)}

# Specs, as text, for the witnesses of machine_witness.py. Of each line the sample takes the first.
SPHERE = "wheel = {{z = {}, gearing = 'spherical', axes_deg = {}}}"
PLANET = "wheel.z = {}\ndrive = {{kind = 'epicyclic', planet_ratio = {}, fixed = '{}'}}"
OTHERS = {
    "spherical": [
        SPHERE.format(z, axes)
        for z in (3, 10**6, 4, 6, 24, 1000)
        for axes in (
            3e-3,
            90.0,
            60.0,
            1e-2,
            1e-3,
            1e-6,
            1.0,
            30.0,
            89.999999999,
            90.000000001,
            120.0,
            179.0,
            179.999,
        )
    ],
    "spherical, side-crank": [
        SPHERE.format(z, 60.0) + f"\ndrive = {{kind = 'side-crank', A = {A!r}}}"
        for z in (3, 24)
        for A in (0.6, 1.0 - 1e-12, -1.0 + 1e-12, 0.999)
    ],
    # the offset's size is below 100 cos² b: 75 for six slots
    "offset": [
        f"wheel = {{z = {z}, offset_mm = {sign * share * 100.0 * math.cos(math.pi / z) ** 2!r}}}"
        for z in (5, 6, 3, 24, 10**6)
        for share in (0.9999, 0.5, 1e-9, 0.1, 0.99, 0.999999, *NEAR_1[2:], 1.0 - 1e-14)
        for sign in (1.0, -1.0)
    ],
    "offset, side-crank": [
        f"wheel = {{z = 6, offset_mm = {e}}}\ndrive = {{kind = 'side-crank', A = {A}}}"
        for e in (74.9999, -74.9999, 30.0)
        for A in (0.6, -0.3, 0.999)
    ],
    "steps": [
        "wheel = {z = 6, steps_deg = [70.0, 50.0]}",
        "wheel = {z = 4, steps_deg = [90.000000001, 89.999999999]}",
        "wheel = {z = 3, steps_deg = [100.0, 122.5, 137.5]}",
    ],
    "epicyclic": [
        PLANET.format(z, rp, fixed)
        for z in (4, 3, 6)
        for rp in ('"shockless"', 0.01, 1e-12, -0.01)
        for fixed in ("sun", "ring")
    ],
    # linkages, with places near which their wheel's entry and exit are, are that file's cases
    "four-bar": [text for text in NEAR_PLACES if "four-bar" in text],
    "slider-crank": [text for text in NEAR_PLACES if "slider-crank" in text],
    "cam": [
        f"wheel = {{z = {z}, gearing = '{g}'}}\ndrive.kind = 'cam'\n"
        f"motion = {{law = '{law}', alpha0_deg = {alpha}}}"
        for alpha in (0.0, 10.0, 59.999999)
        for law in LAWS
        for z, g in ((6, "external"), (8, "internal"))
    ],
}


def others(table, sample, name):
    """Everything else, read from a spec as a user would write it."""
    built = 0
    for text in OTHERS[name][:1] if sample else OTHERS[name]:
        mechanism = read(text)
        if mechanism is not None:
            built += 1
            other_one(table, name, text, mechanism, sample)
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
    """The spec with each of its numbers that shape the motion one unit up, a number at a time."""
    common = {field.key for field in fields(Drive)}
    for part in ("wheel", "drive", "motion"):
        for key, v in spec.table(part).items():
            if isinstance(v, float) and v and key not in common:
                yield spec.with_(f"{part}.{key}", math.nextafter(v, math.inf))


def other_one(table, name, text, mechanism, sample):
    where = " ".join(text.split())
    specs = [mechanism.spec, *varied_specs(mechanism.spec)]
    near = {**NEAR_PLACES, **HARD}.get(text)
    witnesses = [
        [machine_witness.on_path(s, *near)] if near else machine_witness.motions(s) for s in specs
    ]
    for j, engagement in enumerate(mechanism.engagements):
        place = where if len(mechanism.engagements) == 1 else f"{where} engagement {j + 1}"
        w, *moved = [m[j] for m in witnesses]
        x = angles(engagement, 5)[:: 3 if sample else 1]
        if w.law is not None and hasattr(w.law, "pieces"):
            x = np.array([v for v in x if abs(v) > 1e-9 * engagement.exit_deg or v == 0.0])
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
            table.add((name, f"peak {quantity}, angle"), float(less / u), c[1], place)
        condition = []
        for k, quantity in enumerate(NAMES):
            u = unit(peak[quantity])
            c = np.array([abs(float(e[k + 1])) for e in exact]) * step / u
            for other in by:
                change = [abs(float(b[k] - a[k])) for a, b in zip(exact, other, strict=True)]
                c = np.maximum(c, np.array(change) / u)
            condition.append(c)
        compare(table, name, engagement, x, exact, peak, condition, place)


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
