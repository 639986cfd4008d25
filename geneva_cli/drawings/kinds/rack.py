"""The parts of racks: a rack in its guide, and its crank."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from geneva_cli.drawings.kinds.kind import PartsKind
from geneva_cli.layout.missing import or_missing

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from geneva_cli.drawings.kinds.kind import SharedParts
    from geneva_cli.kinematics.layout import Dimension
    from geneva_cli.layout.missing import Missing
    from geneva_cli.layout.stressed import Stressed
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.outlines.rack_outlines import RackOutlines
    from geneva_cli.parts.parts_of_machine import PartsOfMachine
    from geneva_cli.parts.rack_parts import RackParts


class Rack(PartsKind):
    """Plates along a line."""

    DRAWN: ClassVar[Mapping[str, str]] = {
        "slot": "drawings.rack:slot",
        "wheel": "drawings.rack:wheel",
        "crank": "drawings.rack:crank",
        "arm": "drawings.rack:arm",
        "frame": "drawings.part_drawings:frame",
        "gears": "drawings.part_drawings:gears",
        "guide": "drawings.rack:guide",
        "assembly": "drawings.rack:assembly",
        "plate": "drawings.print_plate:plate",
        "sheet": "drawings.sheet.rack:sheet",
    }

    def built(self, model: SharedParts) -> RackParts:
        """Return the parts."""
        from geneva_cli.parts.rack_parts import RackParts

        return RackParts(model.mechanism)

    def all_built(self, model: SharedParts) -> list[tuple[str, Callable[[], PartsOfMachine]]]:
        """Return name and function of all parts: a frame holds the gears before a rack, too."""
        if model.mechanism.spec.has_parts:
            return [("all parts", lambda: model.built)]
        return super().all_built(model)

    def turned(self, model: SharedParts) -> RackOutlines:
        """Return the outlines of the rack and its crank."""
        from geneva_cli.outlines.rack_outlines import rack_outlines

        return rack_outlines(model.mechanism)

    def dimensions(self, model: SharedParts) -> Iterator[Dimension | Missing]:
        """Yield the dimensions of the rack."""
        from geneva_cli.outlines.rack import rack_sizes
        from geneva_cli.parts.rack_frame import rack_dimensions

        named = "dimensions of the rack"
        return or_missing(named, lambda: rack_dimensions(rack_sizes(model.mechanism)))

    def stressed(self, mechanism: Mechanism) -> Stressed:
        """Return the sizes of stressed parts."""
        from geneva_cli.parts.rack_stressed import rack_stressed

        return rack_stressed(mechanism)
