"""The parts of a machine and a whole turn of them: each made once, when it is asked for."""

from __future__ import annotations

from functools import cached_property

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.outlines import Outlines, outlines
from geneva_cli.parts.turn.full_turn import FullTurn, full_turn
from geneva_cli.parts.turn.gaps import NotProved


class Proof:
    """Outlines and full turn of one machine, which every question about its parts shares."""

    def __init__(self, mechanism: Mechanism, made: Outlines | None = None) -> None:
        self.mechanism = mechanism
        self.made = made

    @cached_property
    def found(self) -> Outlines:
        """The outlines; raises GenevaError where the sizes leave none."""
        return self.made or outlines(self.mechanism)

    @property
    def turn(self) -> FullTurn:
        """What a whole turn shows; raises NotProved where that takes too long."""
        if isinstance(self._turned, NotProved):
            raise self._turned
        return self._turned

    @cached_property
    def _turned(self) -> FullTurn | NotProved:
        # That it takes too long is found out once, too.
        try:
            return full_turn(self.found)
        except NotProved as error:
            return error
