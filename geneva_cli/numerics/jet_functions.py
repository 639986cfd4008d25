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


class Ends(Protocol):
    """A motion's entry and exit, degrees from mid-motion."""

    entry_deg: float
    exit_deg: float


class Groove(Protocol):
    """A fixed groove about the crank's axis, which guides the roller along the crank."""

    sign: float  # 1 for an external wheel, -1 for an internal one

    @property
    def motion(self) -> Ends:
        """Motion of the wheel, from which the groove follows."""

    @property
    def ends(self) -> tuple[Sequence[Number], Sequence[Number]]:
        """Roller distance from the crank's axis with two derivatives, at entry and exit."""

    def __call__(self, input_deg: Number, order: int = 3) -> Vector: ...

    def distances(self, input_deg: Number, order: int = 3) -> Vector:
        """Roller distances from the wheel's axis and from the crank's, in units of L."""

    def groove(self, input_deg: Number, order: int = 3) -> Vector:
        """Pitch curve (x, y) of the groove about the crank's axis."""
