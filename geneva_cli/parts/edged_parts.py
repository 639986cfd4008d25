"""What the parts of flat machines and of racks share: all their plates have the spec's edges."""

from __future__ import annotations

from collections.abc import Iterable

from geneva_cli.curves.edges import Edge
from geneva_cli.curves.plates import Member, Plate, edged
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.parts_of_machine import PartsOfMachine


class EdgedParts(PartsOfMachine):
    """The parts of a machine whose plates have the edges of ``[size]``."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism

    @property
    def _edge(self) -> Edge:
        """The edges of all plates but gears, whose edges are teeth."""
        size = self.mechanism.spec.size
        return Edge(size.edge_mm, rounded=size.edge_chamfer_mm is None)

    def _plate(self, plate: Plate) -> Plate:
        """Return a plate with the spec's edges."""
        return plate._replace(edge=self._edge)

    def _edged(self, members: Iterable[Member]) -> tuple[Member, ...]:
        """Return members with the spec's edges."""
        return tuple(edged(one, self._edge) for one in members)
