"""Wheels whose parts are not built."""

from __future__ import annotations

from typing import TYPE_CHECKING, NoReturn

from geneva_cli.drawings.kinds.kind import PartsKind
from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from collections.abc import Callable

    from geneva_cli.drawings.kinds.kind import SharedParts
    from geneva_cli.parts.parts_of_machine import PartsOfMachine


class Unbuilt(PartsKind):
    """No parts but the links and gears in front of the crank."""

    def built(self, model: SharedParts) -> NoReturn:
        """Raise GenevaError with the reason."""
        raise GenevaError(model.mechanism.spec.no_parts, ("wheel", "gearing"))

    def turned(self, model: SharedParts) -> NoReturn:
        """Raise GenevaError with the reason."""
        self.built(model)

    def all_built(self, model: SharedParts) -> list[tuple[str, Callable[[], PartsOfMachine]]]:
        """Return name and function of links and gears."""
        return [("all parts", lambda: model.flat)]
