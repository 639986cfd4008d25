"""The parts of counters: a driver, pinions and number wheels."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from geneva_cli.drawings.kinds.kind import PartsKind
from geneva_cli.errors import GenevaError
from geneva_cli.layout.missing import or_missing

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

    from geneva_cli.collisions.machine_parts import MachineParts
    from geneva_cli.drawings.kinds.kind import SharedParts
    from geneva_cli.kinematics.layout import Dimension
    from geneva_cli.layout.missing import Missing
    from geneva_cli.parts.counter_parts import CounterParts
    from geneva_cli.parts.parts_of_machine import PartsOfMachine


class Counter(PartsKind):
    """Gears on two parallel shafts."""

    DRAWN: ClassVar[Mapping[str, str]] = {
        "wheel": "drawings.counter:wheel",
        "crank": "drawings.counter:crank",
        "number-wheel": "drawings.counter:number_wheel",
        "frame": "drawings.part_drawings:frame",
        "assembly": "drawings.counter:assembly",
        "plate": "drawings.print_plate:plate",
        "sheet": "drawings.sheet.counter:sheet",
    }

    def built(self, model: SharedParts) -> CounterParts:
        """Return the parts."""
        from geneva_cli.parts.counter_parts import CounterParts

        return CounterParts(model.mechanism)

    def turned(self, model: SharedParts) -> MachineParts:
        """Raise GenevaError: the free angles of teeth are checks of their own."""
        raise GenevaError("a counter has no rollers to turn", ("wheel", "gearing"))

    def all_built(self, model: SharedParts) -> list[tuple[str, Callable[[], PartsOfMachine]]]:
        """Return name and function of all parts."""
        return [("all parts", lambda: model.built)]

    def dimensions(self, model: SharedParts) -> Iterator[Dimension | Missing]:
        """Yield the dimensions of teeth and rim."""

        def listed() -> Iterable[Dimension]:
            from geneva_cli.kinematics.layout import Dimension

            parts = self.built(model)
            yield from parts.mesh.layout
            yield Dimension("rim radius", parts.sizes.rim, "mm")

        return or_missing("dimensions of the teeth", listed)
