"""The figure: curves that a command hands to the output."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple, TypeAlias

from geneva_cli.table import Table, rows_table

Piece: TypeAlias = tuple[Sequence[float], Sequence[float]]  # x ascending, and y

# joined: points with a line from each to the next
LINE, POINTS, JOINED = "line", "points", "joined"


class Axis(NamedTuple):
    """A quantity with its name, its label in words, and its unit ("": none)."""

    name: str
    label: str
    unit: str = ""


class Mark(NamedTuple):
    """A place on a curve with its exact value; ``y`` is None where the curve is unbounded."""

    word: str  # "max", "min" or, of either sign, "peak"
    x: float
    y: float | None


class Curve(NamedTuple):
    """One curve of a panel; ``number`` and ``name`` are its design's, equal in all panels.

    Within a piece the curve is smooth, and the chords between its points approximate it. If a piece
    begins at the x at which the one before it ended, the curve jumps there. A piece may be a single
    point.
    """

    number: int
    name: str
    pieces: tuple[Piece, ...]
    marks: tuple[Mark, ...] = ()
    style: str = LINE

    def jumps(self) -> Iterator[tuple[float, float, float]]:
        """The jumps of the curve: x, the value before and the value after."""
        for (x, y), (next_x, next_y) in zip(self.pieces, self.pieces[1:], strict=False):
            if x[-1] == next_x[0] and y[-1] != next_y[0]:
                yield x[-1], y[-1], next_y[0]


class Panel(NamedTuple):
    """Curves of one quantity. ``bounds`` is the visible range of unbounded curves."""

    y: Axis
    curves: tuple[Curve, ...]
    bounds: tuple[float, float] | None = None
    from_zero: bool = True  # whether 0 is always shown

    def span(self) -> tuple[float, float]:
        """The least and the greatest value to show."""
        if self.bounds:
            return self.bounds
        values = [v for curve in self.curves for _, y in curve.pieces for v in y]
        values += [m.y for curve in self.curves for m in curve.marks if m.y is not None]
        values += [0.0] if self.from_zero else []
        return min(values), max(values)


class Figure(NamedTuple):
    """Panels, stacked over one x axis; ``shaded`` are its stretches at rest."""

    title: str
    x: Axis
    panels: tuple[Panel, ...]
    window: tuple[float, float]  # of x
    shaded: tuple[tuple[float, float], ...] = ()

    def curves(self) -> dict[int, Curve]:
        """One curve of each number, in the order of the numbers."""
        by_number = {c.number: c for panel in reversed(self.panels) for c in panel.curves}
        return dict(sorted(by_number.items()))

    def table(self) -> Table:
        """The points as rows: panel, curve, piece (counted from 1), x and y.

        >>> curve = Curve(0, "a", (([0.0, 1.0], [2.0, 3.0]),))
        >>> panel = Panel(Axis("velocity", "Velocity"), (curve,))
        >>> Figure("", Axis("input_deg", "Input angle"), (panel,), (0.0, 1.0)).table().to_rows()[1]
        {'quantity': 'velocity', 'curve': 'a', 'piece': 1, 'input_deg': 1.0, 'value': 3.0}
        """
        rows = [
            (panel.y.name, curve.name, number, x, y)
            for panel in self.panels
            for curve in panel.curves
            for number, piece in enumerate(curve.pieces, 1)
            for x, y in zip(*piece, strict=True)
        ]
        return rows_table(("quantity", "curve", "piece", self.x.name, "value"), rows, mixed=True)
