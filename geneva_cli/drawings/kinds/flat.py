"""The parts of flat wheels and cranks on parallel shafts."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from geneva_cli.drawings.kinds.kind import PartsKind

if TYPE_CHECKING:
    from collections.abc import Callable

    from geneva_cli.drawings.kinds.kind import Known, SharedParts
    from geneva_cli.layout.assembly import Assembly
    from geneva_cli.outlines.outlines import Outlines
    from geneva_cli.parts.flat_parts import FlatParts
    from geneva_cli.parts.parts_of_machine import PartsOfMachine


class Flat(PartsKind):
    """Plates in the plane, whose functions stand in the catalogue."""

    HAS_FLAT_PARTS: ClassVar[bool] = True

    def drawn_by(self, name: str, flat: str | None) -> str | None:
        """Return the function that draws a part."""
        return flat

    def built(self, model: SharedParts) -> FlatParts:
        """Return the parts."""
        return model.flat

    def turned(self, model: SharedParts) -> Outlines:
        """Return the outlines."""
        return model.outlines

    def all_built(self, model: SharedParts) -> list[tuple[str, Callable[[], PartsOfMachine]]]:
        """Return name and function of all parts."""
        return [("all parts", lambda: model.flat)]

    def known(self, model: SharedParts, assembly: Assembly) -> Known:
        """Return the outlines with an assembly."""
        return model.outlines.over(assembly), None
