"""Machines at the edge of what a spec may hold, as a user writes them.

Of each list the sample takes the first.
"""

import itertools
import math
import random

from test_machines import CASES, ON_PATH
from words import LAWS

NEAR_1 = [1.0 - t for t in (1e-3, 1e-6, 1e-9, 1e-12)]

# Four-bars whose wheel's motion is short, or whose wheel is near: with places near which their
# wheel's entry and exit are. The first one's roller is 17 times slower than its links.
FOUR_BAR = (
    "wheel.z = {}\ndrive = {{kind = 'four-bar', crank_mm = {}, ground_mm = {}, coupler_mm = {}, "
    "rocker_mm = {}, point_mm = {}, point_deg = {}}}"
)
NEAR_PLACES = {
    FOUR_BAR.format(5, 35, 90, 80, 95, 120, 25): (295.13, 300.24),
    FOUR_BAR.format(12, 20, 100, 100, 60, 30, 100): (89.65, 252.03),
    **{CASES[name]: ON_PATH[name] for name in ON_PATH if name in CASES},
}

PLANE = "wheel = {{z = {}, gearing = '{}'}}\ndrive = {{{}}}"
SPHERE = "wheel = {{z = {}, gearing = 'spherical', axes_deg = {}}}"
PLANET = "wheel.z = {}\ndrive = {{kind = 'epicyclic', planet_ratio = {}, fixed = '{}'}}"


def _side(A):
    return f"kind = 'side-crank', A = {A!r}"


def _gears(e, phase):
    return f"kind = 'elliptical-gears', eccentricity = {e!r}, phase = '{phase}'"


def _like_a_side_crank(A):
    return f"kind = 'noncircular-gears', A = {A!r}"


BOTH = (1.0, -1.0)
FRONTS = {
    "crank": ["kind = 'crank'"],
    "side-crank": [
        _side(s * a) for a in (0.6, *NEAR_1[::-1], 1e-12, 0.1, 0.3, 0.9, 0.97) for s in BOTH
    ],
    "elliptical-gears": [
        _gears(e, phase)
        for e in (0.5, *NEAR_1[2:0:-1], 0.1, 0.6, 0.9)
        for phase in ("slow", "quick")
    ],
    "noncircular-gears": [_like_a_side_crank(A) for A in (0.6, 0.3, -0.6, 0.97, -1.0 + 1e-9)],
}
WHEELS = (3, 10**6, 4, 5, 6, 7, 12, 24, 97, 1000, 4099, 999_983)


def _curved(law, shape=0.0):
    """Curved slots of a law behind each drive, with alpha0 up to its limits."""
    rng = random.Random(f"{law} {shape}")
    for gearing, z in itertools.product(("external", "internal"), (3, 24, 6, 10**6)):
        natural = 180.0 - 360.0 / z if gearing == "external" else 180.0 + 360.0 / z
        # a plain crank's limits are known; another drive's motion is a little longer or shorter
        limits = [natural - 1e-9, natural - 360.0 + 1e-9]
        for front, alphas in (
            ("kind = 'crank'", limits),
            (_side(0.6), []),
            (_gears(0.5, "slow"), []),
        ):
            ratio = rng.choice(["", ", ratio = 1e-6", ", ratio = 0.3", ", ratio = 0.999999999"])
            L = rng.choice([1e-6, 1e-3, 1.0, 100.0, 12345.678, 1e6])
            for alpha in (rng.uniform(natural - 300.0, natural - 5.0), *alphas):
                lambda_ = f", lambda = {shape!r}" if shape else ""
                yield (
                    PLANE.format(z, gearing, front)
                    + f"\nmotion = {{law = '{law}'{lambda_}, alpha0_deg = {alpha!r}{ratio}}}"
                    + f"\nsize.center_distance_mm = {L!r}"
                )


EIGHTH = [0.125, math.nextafter(0.125, 0), math.nextafter(0.125, 1), 0.1249, 0.1251]
SHAPES = [s * v for v in (10.0, *EIGHTH, 0.05, 0.25, 1e-9, 1.0) for s in BOTH]
MACHINES = {
    **{
        f"{gearing}, {kind}": [
            PLANE.format(z, gearing, front) for front, z in itertools.product(fronts, WHEELS)
        ]
        for kind, fronts in FRONTS.items()
        for gearing in ("external", "internal")
    },
    # the second motion lies within one step of the first wheel
    "geneva-pair": [
        PLANE.format(z, "external", f"kind = 'geneva-pair', first_z = {first}")
        for first in (3, 4, 6)
        for z in WHEELS
        if first * (z - 2) <= 2 * z
    ],
    "rollers": [
        PLANE.format(z, "external", f"{front}, rollers = {m}")
        for front in (
            _side(0.6),
            _gears(0.5, "slow"),
            _side(1.0 - 1e-12),
            _gears(NEAR_1[2], "slow"),
        )
        for z, m in ((4, 3), (3, 2), (3, 5), (5, 3), (24, 2))
    ],
    **{f"curved, {law}": [*_curved(law)] for law in LAWS},
    "curved, sine-group": [text for shape in SHAPES for text in _curved("sine-group", shape)],
    "spherical": [
        SPHERE.format(z, axes)
        for z in (3, 10**6, 4, 6, 24, 1000)
        for axes in (
            *(3e-3, 90.0, 60.0, 1e-2, 1e-3, 1e-6, 1.0, 30.0),
            *(89.999999999, 90.000000001, 120.0, 179.0, 179.999),
        )
    ],
    "spherical, side-crank": [
        SPHERE.format(z, 60.0) + f"\ndrive = {{{_side(A)}}}"
        for z in (3, 24)
        for A in (0.6, 1.0 - 1e-12, -1.0 + 1e-12, 0.999)
    ],
    # The offset's size is below 100 cos² b: 75 for six slots. Of offsets nearer than 1e-9 of that,
    # or below 1e-6 of it, the page accuracy says more.
    "offset": [
        f"wheel = {{z = {z}, offset_mm = {sign * share * 100.0 * math.cos(math.pi / z) ** 2!r}}}"
        for z in (5, 6, 3, 24, 10**6)
        for share in (0.9999, 0.5, 1e-3, 0.1, 0.99, 0.999999, NEAR_1[2])
        for sign in BOTH
    ],
    "offset, side-crank": [
        f"wheel = {{z = 6, offset_mm = {e}}}\ndrive = {{{_side(A)}}}"
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
    # linkages, with places near which their wheel's entry and exit are
    "four-bar": [text for text in NEAR_PLACES if "four-bar" in text],
    "slider-crank": [text for text in NEAR_PLACES if "slider-crank" in text],
    "cam": [
        PLANE.format(z, gearing, "kind = 'cam'")
        + f"\nmotion = {{law = '{law}', alpha0_deg = {alpha}}}"
        for alpha in (0.0, 10.0, 59.999999)
        for law in LAWS
        for z, gearing in ((6, "external"), (8, "internal"))
    ],
}
