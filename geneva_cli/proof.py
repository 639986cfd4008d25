"""The parts of a machine and a whole turn of them: each made once, when it is asked for."""

from __future__ import annotations

from functools import cached_property

from geneva_cli.full_turn import FullTurn, full_turn
from geneva_cli.mechanism import Mechanism
from geneva_cli.outline import Outlines, outlines


class Proof:
    """Outlines and full turn of one machine, which every question about its parts shares."""

    def __init__(self, mechanism: Mechanism, made: Outlines | None = None) -> None:
        self.mechanism = mechanism
        self.made = made

    @cached_property
    def found(self) -> Outlines:
        """The outlines; raises GenevaError where the sizes leave none."""
        return self.made or outlines(self.mechanism)

    @cached_property
    def turn(self) -> FullTurn:
        """What a whole turn shows."""
        return full_turn(self.found)
