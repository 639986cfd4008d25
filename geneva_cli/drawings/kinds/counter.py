"""The parts of counters: a driver, its pinion and the number wheels."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from geneva_cli.drawings.kinds.kind import PartsKind
from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from geneva_cli.collisions.machine_parts import MachineParts
    from geneva_cli.drawings.kinds.kind import SharedParts
    from geneva_cli.parts.flat_parts import FlatParts
    from geneva_cli.parts.parts_of_machine import PartsOfMachine


class Counter(PartsKind):
    """Gears on parallel shafts."""

    DRAWN: ClassVar[Mapping[str, str]] = {
        "wheel": "drawings.counter:wheel",
        "crank": "drawings.counter:crank",
        "number-wheel": "drawings.counter:number_wheel",
        "assembly": "drawings.counter:assembly",
    }

    def built(self, model: SharedParts) -> FlatParts:
        """Return the parts."""
        return model.flat

    def all_built(self, model: SharedParts) -> list[tuple[str, Callable[[], PartsOfMachine]]]:
        """Return name and function of all parts."""
        return [("all parts", lambda: model.flat)]

    def turned(self, model: SharedParts) -> MachineParts:
        """Raise GenevaError: teeth are not turned as rollers are."""
        raise GenevaError("a counter has no rollers to turn", ("wheel", "gearing"))
