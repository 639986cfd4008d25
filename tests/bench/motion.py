"""The motion of one design at very many angles: the plain wheel, then every machine."""

import math
from functools import cache, partial

import numpy as np
from witness import Geneva, mp

from bench.formulas import compiled, textbook
from bench.kinds import KINDS, values_of
from bench.method import Method, Subject, Task
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.external import External
from geneva_cli.numerics.angles import DEGREE

Z = 3  # the wheel that is hardest for a formula
NAMES = ("position", "velocity", "acceleration", "jerk")
ORDERS = (1, 2)  # the derivatives of every machine


def stable(l, x, orders):
    """Derivatives with the half angle, over whole arrays."""
    half = 0.5 * x
    h, g = np.sin(half), np.cos(half)
    v, sine, rest = 2.0 * h * h, 2.0 * h * g, 1.0 - l
    D = rest * rest + 2.0 * l * v
    k = l * rest * (1.0 + l)
    out = []
    if 0 in orders:
        out.append(np.arctan2(l * sine, rest + l * v))
    if 1 in orders:
        out.append(l * (rest - v) / D)
    if 2 in orders:
        out.append(-k * sine / (D * D))
    if 3 in orders:
        out.append(k * (v * (1.0 + 4.0 * l + l * l - 2.0 * l * v) - rest * rest) / (D * D * D))
    return out


def in_blocks(formula, x, count=2, size=8192):
    """The ``count`` arrays of a formula in blocks of angles that stay in the cache."""
    out = np.empty((count, len(x)))
    for i in range(0, len(x), size):
        out[:, i : i + size] = formula(x[i : i + size])
    return out


def stable_blocks(l, x, orders):
    return in_blocks(lambda part: stable(l, part, orders), x, len(orders))


def motion(quick):
    """Every formula for velocity and acceleration, and for position to jerk."""
    tasks = [
        _task(count, orders)
        for count in ((1_000,) if quick else (1_000, 1_000_000))
        for orders in (ORDERS, (0, 1, 2, 3))
    ]
    return Subject(
        f"Motion of a wheel of {Z} slots, and of every machine, at N angles",
        "greatest error, in units of each quantity's peak; of every machine against single angles",
        [*tasks, *(_kind_task(kind, 1_000 if quick else 1_000_000) for kind in KINDS)],
    )


def _task(count, orders):
    mechanism = build(Spec(External(Z)))
    engagement, l = mechanism.engagements[0], mechanism.ratio
    half = np.linspace(engagement.entry_deg, 0.0, count // 2 + 1)[: count // 2]
    mirrored = np.concatenate((half, -half[::-1]))
    skew = mirrored.copy()
    skew[1] = math.nextafter(skew[1], 0.0)  # no longer its own mirror image
    x = np.radians(skew)

    formulas = [
        ("textbook formula", textbook),
        ("stable formula, whole arrays", stable),
        ("stable formula, in blocks", stable_blocks),
    ]
    methods = [Method(name, count, partial(formula, l, x, orders)) for name, formula in formulas]
    motion = engagement.motion
    methods += [
        Method("jets, whole arrays", count, partial(_jets, motion, skew, orders), rival=False),
        Method("ours", count, lambda: motion.derivatives(skew, orders), True),
        Method("ours, mirrored", count, lambda: motion.derivatives(mirrored, orders), True),
    ]
    return angle_task(_named(orders), skew, lambda found: _error(found, mirrored, orders), methods)


def _named(orders):
    return ", ".join(NAMES[k] for k in orders)


def _error(results, input_deg, orders):
    """Greatest error at an even sample of the angles, with the ends and the two middle ones."""
    n = len(input_deg)
    sample = np.unique([*np.linspace(0, n - 1, 200).astype(int), n // 2 - 1, n // 2])
    exact = [_exact(float(input_deg[i])) for i in sample]
    worst = 0.0
    for values, k in zip(results, orders, strict=True):
        peak = _peak(k)
        for i, derivatives in zip(sample, exact, strict=True):
            error = abs(mp.mpf(float(values[i])) - derivatives[k]) / peak
            worst = max(worst, float(error))
    return worst


_exact = cache(Geneva(Z).derivatives)


@cache
def _peak(k):
    """Size of the peak of a derivative, to one per cent: the unit of its error."""
    half = 90.0 - 180.0 / Z
    scan = np.linspace(0.0, half, 1001) * DEGREE
    return float(np.abs(stable(math.sin(math.pi / Z), scan, (k,))[0]).max())


def _kind_task(kind, count):
    value = values_of(kind, 1)[0].item()
    engagement = build(kind.spec.with_(kind.key, value)).engagements[0]
    motion = engagement.motion
    angles = np.linspace(motion.entry_deg, motion.exit_deg, count)
    angles[1] = 0.5 * (angles[0] + angles[1])  # not its own mirror image: no half is copied
    methods = []
    if kind.formula:
        argument = kind.argument(value, engagement)
        formula, radians = partial(kind.formula, argument), np.radians(angles)
        script = partial(in_blocks, formula, radians)
        methods.append(Method("a handbook's formulas, in blocks", count, script))
        fast = compiled(kind.formula)
        if fast:
            methods.append(Method("the same by Numba", count, lambda: fast(argument, radians)))
    methods += [
        Method("jets, whole arrays", count, partial(_jets, motion, angles, ORDERS), rival=False),
        Method("ours", count, lambda: motion.derivatives(angles, ORDERS), True),
    ]
    what = f"{kind.name}: {_named(ORDERS)}"
    return angle_task(what, angles, lambda results: _kind_error(motion, angles, results), methods)


def angle_task(what, angles, error, methods):
    """A task over angles in degrees, whose baseline is their sine and cosine."""
    radians = np.radians(angles)
    return Task(
        f"{what} at {len(angles)} angles",
        f"one np.sin + np.cos over {len(angles)} angles",
        lambda: (np.sin(radians), np.cos(radians)),
        error,
        methods,
    )


def _jets(motion, angles, orders):
    """The derivatives from one jet."""
    every = motion(angles, max(orders)).derivatives()
    return [every[k] for k in orders]


def _kind_error(motion, angles, results):
    """Greatest difference from the values of single angles, by ``math`` instead of NumPy."""
    # the error is measured at 50 angles
    some = np.linspace(0, len(angles) - 1, 50).astype(int)
    exact = np.array([motion(x, ORDERS[-1]).derivatives()[1:] for x in angles[some].tolist()]).T
    errors = [
        np.abs(values[some] - own).max() / np.abs(values).max()
        for values, own in zip(results, exact, strict=True)
    ]
    return float(max(errors))
