"""How the parts of a rack's machine are built, drawn, turned and measured."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, ClassVar

from geneva_cli.drawings.model import PartsKind, PartsModel, before_links
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Dimension
from geneva_cli.parts.missing import Missing, or_missing

if TYPE_CHECKING:
    from geneva_cli.drawings.model import NamedBuilds
    from geneva_cli.kinds.linear.outlines import RackOutlines
    from geneva_cli.kinds.linear.parts import RackParts
    from geneva_cli.parts.sizes.stressed import Stressed


class Rack(PartsKind):
    """Plates along a line: a rack in its guide, and its crank."""

    DRAWN: ClassVar[Mapping[str, str]] = {
        "slot": "kinds.linear.drawings:slot",
        "wheel": "drawings.part_drawings:wheel",
        "crank": "drawings.part_drawings:crank",
        "arm": "kinds.linear.drawings:arm",
        "frame": "drawings.part_drawings:frame",
        "guide": "kinds.linear.drawings:guide",
        "assembly": "kinds.linear.drawings:assembly",
        "plate": "drawings.print_plate:plate",
        "sheet": "kinds.linear.sheet:sheet",
    }

    def built(self, model: PartsModel) -> RackParts:
        """Return the parts."""
        from geneva_cli.kinds.linear.parts import RackParts

        return RackParts(model.mechanism)

    def all_built(self, model: PartsModel) -> NamedBuilds:
        """Return names and functions of all parts; its frame holds its gears, but not links."""
        framed = model.mechanism.spec.has_parts
        return super().all_built(model) if framed else before_links(model)

    def turned(self, model: PartsModel) -> RackOutlines:
        """Return the outlines of the rack and its crank."""
        from geneva_cli.kinds.linear.outlines import rack_outlines

        return rack_outlines(model.mechanism)

    def dimensions(self, model: PartsModel) -> Iterator[Dimension | Missing]:
        """Yield the dimensions of the rack."""
        from geneva_cli.kinds.linear.frame import rack_dimensions
        from geneva_cli.kinds.linear.rack import rack_sizes

        named = "dimensions of the rack"
        return or_missing(named, lambda: rack_dimensions(rack_sizes(model.mechanism)))

    def stressed(self, mechanism: Mechanism) -> Stressed:
        """Return the sizes of stressed parts."""
        from geneva_cli.kinds.linear.stressed import rack_stressed

        return rack_stressed(mechanism)
