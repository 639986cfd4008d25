"""The residual vibration of a load after a modified sine, at very many period ratios.

A script solves the oscillator's equation. A better one integrates the acceleration against the
vibration, or uses the closed form, which is 0/0 at the ratios 2/3 and 2.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache, partial
from typing import Any

import numpy as np

from bench.method import Method, Subject, Task
from bench.truth import digits
from geneva_cli.loads.vibration.oscillator import Oscillator
from geneva_cli.loads.vibration.shape import law_shape
from geneva_cli.loads.vibration.swing import residual_swing
from geneva_cli.motion import registry
from geneva_cli.numerics.jet import Array

CHECKED = 200  # ratios whose error is measured
LEAST_SHARE = 1e-3  # of the step: errors are over the residual, or over this where it is less
PEAK = 4.0 * math.pi**2 / (4.0 + math.pi)  # C_a, the greatest acceleration
# The pieces of its acceleration: from, to, rate and phase of the sine.
LAW_PIECES = (
    (0.0, 0.125, 4.0, 0.0),
    (0.125, 0.875, 4.0 / 3.0, 1.0 / 3.0),
    (0.875, 1.0, 4.0, -2.0),
)


def acceleration(u: float) -> float:
    """The law's acceleration at one place, as in a script."""
    _, _, rate, phase = next(piece for piece in LAW_PIECES if u <= piece[1])
    return PEAK * math.sin(math.pi * (rate * u + phase))


def solved(ratio: Array, damping: float, tolerance: float) -> list[float]:
    """Residuals by SciPy's solver of differential equations, piece by piece, ratio by ratio."""
    from scipy.integrate import solve_ivp

    out = []
    for value in ratio:
        omega = 2.0 * math.pi * float(value)

        def slope(u: float, y: Any, omega: float = omega) -> list[float]:
            swing = 2.0 * damping * omega * y[1] + omega * omega * y[0]
            return [y[1], -acceleration(u) - swing]

        y = [0.0, 0.0]
        for a, b, *_ in LAW_PIECES:
            run = solve_ivp(slope, (a, b), y, "DOP853", rtol=tolerance, atol=tolerance * 1e-2)
            y = run.y[:, -1]
        back = (y[1] + damping * omega * y[0]) / (omega * math.sqrt(1.0 - damping * damping))
        out.append(math.hypot(y[0], back))
    return out


def summed(ratio: Array, damping: float, points: int) -> Array:
    """Residuals by the trapezoidal rule on the integral of acceleration times vibration."""
    u = np.linspace(0.0, 1.0, points)
    bent = np.array([acceleration(x) for x in u]) / (points - 1)
    p = 2.0 * np.pi * ratio * complex(-damping, math.sqrt(1.0 - damping * damping))
    size = 256  # ratios at a time
    parts = [
        np.abs(np.exp(np.outer(p[i : i + size], 1.0 - u)) @ bent) / p[i : i + size].imag
        for i in range(0, len(p), size)
    ]
    return np.concatenate(parts)


def closed(ratio: Array, damping: float, _: int = 0) -> Array:
    """Residuals by the closed form, each sine as two exponentials."""
    p = 2.0 * np.pi * ratio * complex(-damping, math.sqrt(1.0 - damping * damping))
    with np.errstate(all="ignore"):
        residuals: Array = np.abs(_exponentials(np, np.pi, p)) * PEAK / p.imag
    return residuals


def _exponentials(m: Any, pi: Any, p: Any) -> Any:
    """Integral of the unit law times e^(p (1 - u)), with a module's exp."""
    total = 0.0
    for piece in LAW_PIECES:
        a, b, rate, phase = (pi / pi * round(24 * v) / 24 for v in piece)  # in the digits of pi
        for side in (1, -1):
            k = 1j * side * rate * pi
            at = m.exp(1j * side * phase * pi) / (2j * side)
            total = total + at * m.exp(p) * (m.exp((k - p) * b) - m.exp((k - p) * a)) / (k - p)
    return total


@cache
def _exact(ratio: float, damping: float) -> Any:
    """Residual in 50 digits; half of them remain when the ratio is moved by 1e-25 away from 0/0."""
    mp = digits()
    zeta, moved = mp.mpf(damping), mp.mpf(ratio) + mp.mpf("1e-25")
    p = 2 * mp.pi * moved * mp.mpc(-zeta, mp.sqrt(1 - zeta * zeta))
    return abs(_exponentials(mp, mp.pi, p)) * 4 * mp.pi**2 / (4 + mp.pi) / p.imag


def _error(ratio: Array, damping: float, residuals: Sequence[float] | Array) -> float:
    worst = 0.0
    for value, exact in zip(residuals[:CHECKED], ratio, strict=False):
        true = _exact(float(exact), damping)
        error = float(abs(digits().mpf(float(value)) - true) / max(true, LEAST_SHARE))
        worst = max(worst, error if math.isfinite(error) else 1.0)  # no digit is right
    return worst


def subject(quick: bool) -> Subject:
    """One task without damping, and one with a little."""
    return Subject(
        "Residual vibration of a load after a modified sine",
        f"greatest error of {CHECKED} residuals, over the residual or {LEAST_SHARE:g} of the step",
        [_task(damping, quick) for damping in (0.0, 0.02)],
    )


def _task(damping: float, quick: bool) -> Task:
    count = 1_000 if quick else 100_000
    ratio = np.random.default_rng(8).permutation(np.linspace(0.3, 20.0, count))
    # where the closed form is 0/0, and next to it
    ratio[:4] = 2.0 / 3.0, 2.0 / 3.0 + 1e-9, 2.0, 2.0 - 1e-9
    # a loop is run over a sample of the ratios
    ours, sample = law_shape(registry.law("modified-sine")()), 5 if quick else 20
    swing, motion = Oscillator(ratio, np.full(count, damping)), np.zeros(count, dtype=np.intp)
    methods = [
        Method(
            f"loop: SciPy solve_ivp (extrapolated from {sample})",
            tolerance,
            partial(solved, ratio[:sample], damping, tolerance),
            times=count / sample,
        )
        for tolerance in ((1e-6,) if quick else (1e-6, 1e-8, 1e-11))
    ]
    others: list[tuple[str, Callable[[Array, float, int], Array], Sequence[int]]] = [
        ("trapezoidal rule", summed, (101,) if quick else (101, 1001)),
        ("closed form", closed, (0,)),
    ]
    methods += [
        Method(name, size or None, partial(method, ratio, damping, size))
        for name, method, sizes in others
        for size in sizes
    ]
    methods.append(Method("ours", None, lambda: np.abs(residual_swing(ours, motion, swing)), True))
    return Task(
        f"{count} period ratios, damping {damping:g}",
        f"one np.sin + np.cos over {count} numbers",
        lambda: (np.sin(ratio), np.cos(ratio)),
        lambda residuals: _error(ratio, damping, residuals),
        methods,
    )
