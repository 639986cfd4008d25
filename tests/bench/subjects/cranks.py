"""The peak accelerations of 100,000 side-crank designs."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from bench.formulas import Proportions, acceleration, jerk
from bench.kinds import task_of_many
from bench.method import Method, Subject, missing
from bench.numeric import NUMERIC, vertex
from bench.scalar_loop import by_numba, looped
from bench.truth import acceleration_peak, relative
from geneva_cli.motion.wheels.side_crank_arrays import acceleration_peaks, wheels
from geneva_cli.numerics.angles import one_minus_sin_pi

CHECKED = 200  # designs whose error is measured


class CrankDesigns:
    """Random side-cranks: z from 3 to 24, both gearings, A from -0.9 to 0.9; always equal."""

    def __init__(self, count: int) -> None:
        random = np.random.default_rng(6)
        self.z: Any = random.integers(3, 25, count)
        self.internal = random.random(count) < 0.5
        self.A = random.uniform(-0.9, 0.9, count)
        self.arrays = Proportions.of(np.where(self.internal, -1.0, 1.0), self.z, self.A, np)

    def one(self, i: int) -> Proportions:
        """One design, for methods that take single designs."""
        return Proportions(*[float(v[i]) for v in self.arrays])

    def error(self, peaks: Any) -> float:
        """Greatest relative error of the first designs, as many as were computed."""
        return max(
            relative(
                peak,
                acceleration_peak(
                    int(self.z[i]), "internal" if self.internal[i] else "external", float(self.A[i])
                ),
            )
            for i, peak in enumerate(peaks[:CHECKED])
        )


def grid(d: Proportions, n: int) -> Any:
    """Greatest of n points, in a loop over the points."""
    best = np.zeros(len(d.half))
    for i in range(1, n):
        np.maximum(best, np.abs(acceleration(np, d, d.half * (i / (n - 1)))), out=best)
    return best


def parabola(d: Proportions, n: int) -> Any:
    """Peak of a parabola through the greatest of n points and its neighbours."""
    size = np.array([np.abs(acceleration(np, d, d.half * (i / (n - 1)))) for i in range(n)])
    i, every = size.argmax(axis=0), np.arange(len(d.half))
    inner = np.clip(i, 1, n - 2)
    top = vertex(size[inner - 1, every], size[inner, every], size[inner + 1, every])
    return np.where(i == inner, top, size[i, every])


def scanned(d: Proportions, n: int, solve: Callable[[Proportions, Any, Any], Any]) -> Any:
    """Greatest value at the end and at the slope's zeros between points, by ``solve``."""
    best = np.abs(acceleration(np, d, d.half))
    nodes = [d.half * (i / (n - 1)) for i in range(n)]
    slopes = np.array([jerk(np, d, x) for x in nodes])
    left, which = np.nonzero(slopes[:-1] * slopes[1:] < 0.0)
    part = Proportions(*[v[which] for v in d])
    a, b = part.half * (left / (n - 1)), part.half * ((left + 1) / (n - 1))
    np.maximum.at(best, which, np.abs(acceleration(np, part, solve(part, a, b))))
    return best


def find_root(d: Proportions, n: int) -> Any:
    """Peak by SciPy's vectorised bracketing solver between the points of a scan."""
    from scipy.optimize.elementwise import find_root as solve

    def root(part: Proportions, a: Any, b: Any) -> Any:
        return solve(lambda x, *of: jerk(np, Proportions(*of), x), (a, b), args=tuple(part)).x

    return scanned(d, n, root)


def secants(d: Proportions, n: int) -> Any:
    """Peak by six steps of the secant method between the points of a scan, in NumPy only."""

    def root(part: Proportions, a: Any, b: Any) -> Any:
        x, value, last, before = b, jerk(np, part, b), a, jerk(np, part, a)
        for _ in range(6):
            fall = np.where(value == before, 1.0, value - before)
            x, last = np.clip(x - value * (x - last) / fall, a, b), x
            value, before = jerk(np, part, x), value
        return x

    return scanned(d, n, root)


def subject(quick: bool) -> Subject:
    """Every method on one set of designs."""
    # name, function of a block of designs, sizes
    vectorised: list[tuple[str, Callable[..., Any], tuple[int, ...]]] = [
        ("vectorised grid", grid, (33, 101, 1001)),
        ("vectorised grid + parabola", parabola, (9, 17, 33, 101, 301)),
        ("vectorised scan + SciPy find_root", find_root, (17, 33)),
        ("vectorised scan + secants", secants, (17, 33)),
    ]
    count = 2_000 if quick else 100_000
    designs = CrankDesigns(count)
    methods = [
        Method(name, n, partial(designs.arrays.blocks, partial(method, n=n)))
        for name, method, sizes in vectorised
        for n in (sizes[:2] if quick else sizes)
    ]
    sample = 5 if quick else 50  # designs of which a loop is run
    for numeric in () if quick else NUMERIC:
        size = numeric.sizes[2]
        name = f"loop: {numeric.name} (extrapolated from {sample})"
        loop = partial(_loop, designs, numeric.run, size, sample)
        methods.append(Method(name, size, loop, times=count / sample))
    absent = missing("numba")
    if not absent:
        methods.append(Method("numba, loop over designs", None, partial(_compiled, designs)))
    sign, l, _, _ = designs.arrays
    rest = one_minus_sin_pi(1, designs.z)
    ours = lambda: acceleration_peaks(wheels(sign, l, rest, designs.A))[0]  # noqa: E731
    methods.append(Method("ours", None, ours, True))
    task = task_of_many(f"{count} designs", count, designs.error, methods)
    return Subject(
        f"Peak acceleration of {count} side-crank designs",
        f"greatest relative error of {CHECKED} designs' peaks",
        [task],
        floor=4e-15,
        absent=absent,
    )


def _compiled(designs: CrankDesigns) -> Any:
    sign, l, A, _ = designs.arrays
    out = np.empty(len(A))
    by_numba(looped)(sign, l, A, out)
    return out


def _loop(
    designs: CrankDesigns, method: Callable[[Proportions, Any], float], size: float, sample: int
) -> list[float]:
    return [method(designs.one(i), size) for i in range(sample)]
