"""Motion laws s(u): the wheel's share of its step against the share of the motion time, both 0..1.

The common set of VDI 2143 and the sine group of Krasniqi. A law is given on its first half only,
as a function of u, and on its second as what is left to do, 1 - s, as a function of what is left
of the time, w = 1 - u: so both ends are exact, and a symmetric law is written once. Positions
come from a closed form and everything else from the velocity, written as a product wherever it
vanishes at the ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.numerics.jet import Coefficient, Jet, integral, library, piecewise, sin_cos

Half: TypeAlias = Callable[[Coefficient, int], Jet]


class Law(NamedTuple):
    """A motion law; ``first(u, order)`` is s on 0 <= u <= 1/2, ``second(w, order)`` 1 - s."""

    name: str
    first: Half
    second: Half
    breaks: tuple[float, ...] = ()  # where a derivative up to the fourth jumps, inside 0..1
    about: str = ""
    analytic: bool = True  # between the breaks; a spline is not
    # of points: the decimals given, and by how much their rounding moves the third derivative
    doubt: Callable[[], tuple[int, float]] | None = None

    def __call__(self, u: Coefficient, order: int = 3) -> Jet:
        """The law at a number or an array of u in 0..1, with its derivatives by u."""
        return piecewise(
            u,
            (0.5,),
            (lambda x: self.first(x, order), lambda x: remaining(self.second(1.0 - x, order))),
        )


def remaining(rest: Jet, end: float = 1.0) -> Jet:
    """What is left to do as a function of the time left, turned into what is done of ``end``."""
    return Jet([end - rest.c[0], *[c if k % 2 else 0.0 - c for k, c in enumerate(rest.c) if k]])


def _from_velocity(
    position: Callable[[Coefficient], Coefficient], velocity: Callable[[Jet], Jet]
) -> Half:
    """A half law from s(u) and the jet of ds/du."""

    def half(u: Coefficient, order: int) -> Jet:
        if order == 0:
            return Jet((position(u),))
        return integral(velocity(Jet.variable(u, order - 1)), position(u))

    return half


def _sine(x: Jet) -> Jet:
    return sin_cos(x)[0]


def _symmetric(name: str, half: Half, about: str, breaks: tuple[float, ...] = ()) -> Law:
    return Law(name, half, half, breaks, about)


def sine_group(shape: float) -> Law:
    """Krasniqi's law: ds/du = (8/3) sin^4 x (1 - 8 lambda cos x), x = pi u.

    Velocity to snap vanish at both ends. Beyond |lambda| = 1/8 the wheel turns back.
    """

    def half(shape: float) -> Half:
        def position(u: Coefficient) -> Coefficient:
            m = library(u)
            x = math.pi * u
            even = x - 2.0 / 3.0 * m.sin(2.0 * x) + m.sin(4.0 * x) / 12.0
            return (even - 64.0 / 15.0 * shape * m.sin(x) ** 5) / math.pi

        def velocity(u: Jet) -> Jet:
            s, c = sin_cos(u * math.pi)
            squared = s * s
            return squared * squared * (1.0 - c * (8.0 * shape)) * (8.0 / 3.0)

        return _from_velocity(position, velocity)

    about = "four sines; no jump up to snap; lambda tilts it, |lambda| <= 1/8"
    first = half(shape)
    return Law("sine-group", first, half(-shape) if shape else first, (), about)


def cycloidal() -> Law:
    """Inclined sine line: ds/du = 2 sin^2(pi u)."""

    def position(u: Coefficient) -> Coefficient:
        return u - library(u).sin(2.0 * math.pi * u) / (2.0 * math.pi)

    def velocity(u: Jet) -> Jet:
        s = _sine(u * math.pi)
        return s * s * 2.0

    about = "inclined sine line; no jump in acceleration"
    return _symmetric("cycloidal", _from_velocity(position, velocity), about)


def harmonic() -> Law:
    """Simple sine line: ds/du = (pi/2) sin(pi u)."""

    def position(u: Coefficient) -> Coefficient:
        return library(u).sin(math.pi / 2.0 * u) ** 2

    def velocity(u: Jet) -> Jet:
        return _sine(u * math.pi) * (math.pi / 2.0)

    about = "simple sine line; its acceleration jumps at both ends"
    return _symmetric("harmonic", _from_velocity(position, velocity), about)


def polynomial_345() -> Law:
    """Polynomial 3-4-5: ds/du = 30 u^2 (1-u)^2."""

    def position(u: Coefficient) -> Coefficient:
        return u**3 * (10.0 - u * (15.0 - 6.0 * u))

    def velocity(u: Jet) -> Jet:
        w = u * (1.0 - u)
        return w * w * 30.0

    about = "polynomial of degree 5; no jump in acceleration"
    return _symmetric("3-4-5", _from_velocity(position, velocity), about)


def polynomial_4567() -> Law:
    """Polynomial 4-5-6-7: ds/du = 140 u^3 (1-u)^3."""

    def position(u: Coefficient) -> Coefficient:
        return u**4 * (35.0 - u * (84.0 - u * (70.0 - 20.0 * u)))

    def velocity(u: Jet) -> Jet:
        w = u * (1.0 - u)
        return w * w * w * 140.0

    about = "polynomial of degree 7; no jump in jerk"
    return _symmetric("4-5-6-7", _from_velocity(position, velocity), about)


def modified_sine() -> Law:
    """Modified sine line: sine acceleration of period 1/2 for u < 1/8, of period 3/2 between."""
    scale = 1.0 / (4.0 + math.pi)

    def start(u: Coefficient) -> Coefficient:
        return (math.pi * u - library(u).sin(4.0 * math.pi * u) / 4.0) * scale

    def start_velocity(u: Jet) -> Jet:
        s = _sine(u * (2.0 * math.pi))
        return s * s * (2.0 * math.pi * scale)

    def middle(u: Coefficient) -> Coefficient:
        phase = math.pi / 3.0 * (1.0 + 4.0 * u)
        return (2.0 + math.pi * u - 2.25 * library(u).sin(phase)) * scale

    def middle_velocity(u: Jet) -> Jet:
        phase = (u * 4.0 + 1.0) * (math.pi / 3.0)
        return (1.0 - sin_cos(phase)[1] * 3.0) * (math.pi * scale)

    half = _joined(
        (0.125,), _from_velocity(start, start_velocity), _from_velocity(middle, middle_velocity)
    )
    about = "sines of two periods; a low peak of velocity and of torque"
    return _symmetric("modified-sine", half, about, (0.125, 0.875))


def modified_trapezoid() -> Law:
    """Modified acceleration trapezoid: constant acceleration, joined by quarter sines."""
    peak = 8.0 * math.pi / (2.0 + math.pi)
    rate = 4.0 * math.pi
    v_1 = peak / rate  # velocity at u = 1/8
    s_1 = v_1 * (0.125 - 1.0 / rate)
    v_2 = v_1 + peak / 4.0  # at u = 3/8
    s_2 = s_1 + v_1 / 4.0 + peak / 32.0

    def start(u: Coefficient) -> Coefficient:
        return v_1 * (u - library(u).sin(rate * u) / rate)

    def start_velocity(u: Jet) -> Jet:
        s = _sine(u * (rate / 2.0))
        return s * s * (2.0 * v_1)

    def flat(u: Coefficient) -> Coefficient:
        t = u - 0.125
        return s_1 + t * (v_1 + t * peak / 2.0)

    def flat_velocity(u: Jet) -> Jet:
        return (u - 0.125) * peak + v_1

    def middle(u: Coefficient) -> Coefficient:
        t = u - 0.375
        return s_2 + v_2 * t + v_1 / rate * 2.0 * library(u).sin(rate / 2.0 * t) ** 2

    def middle_velocity(u: Jet) -> Jet:
        return _sine((u - 0.375) * rate) * v_1 + v_2

    half = _joined(
        (0.125, 0.375),
        _from_velocity(start, start_velocity),
        _from_velocity(flat, flat_velocity),
        _from_velocity(middle, middle_velocity),
    )
    about = "constant acceleration joined by sines; the lowest peak without a jump"
    return _symmetric("modified-trapezoid", half, about, (0.125, 0.375, 0.625, 0.875))


def _at_order(half: Half, order: int) -> Callable[[Coefficient], Jet]:
    return lambda x: half(x, order)


def _joined(cuts: tuple[float, ...], *halves: Half) -> Half:
    def half(u: Coefficient, order: int) -> Jet:
        return piecewise(u, cuts, [_at_order(h, order) for h in halves])

    return half


# The registry: one line a law. Only sine-group takes the shape parameter.
LAWS: dict[str, Callable[[], Law]] = {
    "harmonic": harmonic,
    "cycloidal": cycloidal,
    "modified-trapezoid": modified_trapezoid,
    "modified-sine": modified_sine,
    "3-4-5": polynomial_345,
    "4-5-6-7": polynomial_4567,
    "sine-group": lambda: sine_group(0.0),
}
NAMES = (*LAWS, "table")


def named(name: str, shape: float = 0.0) -> Law:
    """The law of that name; ``shape`` is the sine group's lambda."""
    if name == "sine-group":
        return sine_group(shape)
    if name not in LAWS:
        known = ", ".join(NAMES)
        raise GenevaError(f'unknown law "{cut(name)}"{nearest(name, NAMES)}; known: {known}')
    return LAWS[name]()
