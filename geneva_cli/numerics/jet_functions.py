"""Functions that return jets, of which engagements are made: for type checkers only."""

from collections.abc import Sequence
from typing import Protocol, TypeAlias

from geneva_cli.numerics.jet import Jet, Number

Vector: TypeAlias = tuple[Jet, Jet]


class Path(Protocol):
    """The pin's position (x, y) in the fixed frame, by the input angle in degrees."""

    def __call__(self, input_deg: Number, order: int = 3) -> Vector: ...


class Displacement(Protocol):
    """A pin's displacement since a moment, along a ray and across it, ``tau`` input radians later.

    Or a crank's rotation d since then, as sin d and 1 - cos d.
    """

    def __call__(self, tau: Number, order: int) -> Vector: ...


class Rate(Protocol):
    """Rate of a body in radians per input radian, ``tau`` after mid-motion, as the wheel turns."""

    def __call__(self, tau: Number, order: int) -> Jet: ...


class Reactions(Protocol):
    """Reactions on the body that carries the roller, held by links without mass or friction.

    They are those of the crank's shaft, and of the body's other guide (a rocker, slider, groove or
    fixed gear), to each load, a force and a couple. ``path`` is the pin's path, one order higher
    than the loads.
    """

    def __call__(
        self, input_deg: Number, path: Vector, loads: Sequence[tuple[Vector, Jet]]
    ) -> list[tuple[Vector, Vector]]: ...
