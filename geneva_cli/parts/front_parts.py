"""The links and gears in front of the crank of a machine whose other parts are not flat."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NoReturn, Self

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Member
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.links.link_shafts import links_to_fix
from geneva_cli.parts.parts import NamedBuilds
from geneva_cli.parts.shafts.bolt_holes import Screws

if TYPE_CHECKING:
    from geneva_cli.parts.framed import FrameAndShafts
    from geneva_cli.parts.missing import NamedParts


class FrontParts(FlatParts):
    """Links and gears without frame and shafts; all parts of a machine with no others."""

    @property
    def built(self) -> NoReturn:
        """Raise GenevaError with the reason why wheel and crank have no parts."""
        raise GenevaError(self.mechanism.spec.no_parts, ("wheel", "gearing"))

    @property
    def flat(self) -> Self:
        """These parts."""
        return self

    @property
    def all_built(self) -> NamedBuilds:
        """Name and function of links and gears."""
        return [("all parts", lambda: self)]

    @property
    def _framed(self) -> FrameAndShafts:
        gearing = self.mechanism.spec.wheel.NAME
        raise GenevaError(
            f'--part frame: the shafts of gearing = "{gearing}" are not parallel, so one plate '
            "cannot hold them"
        )

    @property
    def screws(self) -> tuple[Screws, ...]:
        """The screws between the parts; none."""
        return ()

    @property
    def to_fix(self) -> tuple[str, ...]:
        """Names of the parts that turn with a shaft in a round bore, which holds nothing."""
        return tuple(links_to_fix(self.links, self.mechanism))

    @property
    def members(self) -> tuple[Member, ...]:
        """Links and gears."""
        return (*self.linked, *self.round_gears, *self.gear_pair)

    def by_name(self) -> Iterator[NamedParts]:
        """Yield links and gears in the order of a list, as names and functions that build them."""
        yield "links", lambda: [one.part for one in self.linked]
        yield "gears", lambda: [one.part for one in (*self.round_gears, *self.gear_pair)]
