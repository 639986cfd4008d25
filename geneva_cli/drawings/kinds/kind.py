"""The base of the kinds of parts: how a wheel's parts are built, drawn, turned and measured."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar, Protocol, TypeAlias

from geneva_cli.spec.load_named import load_named

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from geneva_cli.collisions.machine_parts import MachineParts
    from geneva_cli.kinematics.layout import Dimension
    from geneva_cli.layout.assembly import Assembly
    from geneva_cli.layout.missing import Missing
    from geneva_cli.layout.stressed import Stressed
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.outlines.outlines import Outlines
    from geneva_cli.parts.flat_parts import FlatParts
    from geneva_cli.parts.parts_of_machine import PartsOfMachine
    from geneva_cli.parts.sphere.shells import Shells

    Known: TypeAlias = tuple[Outlines | None, Shells | None]


class SharedParts(Protocol):
    """What a ``PartsModel`` computes once for all; a protocol, as the model imports the kinds."""

    @property
    def mechanism(self) -> Mechanism:
        """The machine."""

    @property
    def flat(self) -> FlatParts:
        """Its flat parts."""

    @property
    def outlines(self) -> Outlines:
        """Its outlines; raises GenevaError where the sizes leave none."""

    @property
    def shells(self) -> Shells:
        """Its shells; raises GenevaError where the sizes leave none."""

    @property
    def built(self) -> PartsOfMachine:
        """What its kind builds."""


class PartsKind(ABC):
    """The parts of wheels of one kind; functions in tables are written ``module:function``."""

    # functions that draw parts, or make their sheets, by the names of the parts
    DRAWN: ClassVar[Mapping[str, str]] = {}
    # functions that tabulate parts, where it is not the function of the catalogue
    TABLES: ClassVar[Mapping[str, str]] = {}
    # True if it has all parts of flat machines as well, such as links and gears
    HAS_FLAT_PARTS: ClassVar[bool] = False
    # parts whose outlines are those of a surface laid flat
    LAID_FLAT: ClassVar[tuple[str, ...]] = ()

    def drawn_by(self, name: str, flat: str | None) -> str | None:
        """Return the function that draws a part; ``flat`` is that of flat machines."""
        return self.DRAWN.get(name)

    @abstractmethod
    def built(self, model: SharedParts) -> PartsOfMachine:
        """Return the parts. Raises GenevaError where the sizes leave none."""

    @abstractmethod
    def turned(self, model: SharedParts) -> MachineParts:
        """Return what is turned to find collisions. Raises GenevaError where there is none."""

    def all_built(self, model: SharedParts) -> list[tuple[str, Callable[[], PartsOfMachine]]]:
        """Return names and functions of all parts: those of links and gears are flat."""
        return [("wheel and crank", lambda: model.built), ("all parts", lambda: model.flat)]

    def known(self, model: SharedParts, assembly: Assembly) -> Known:
        """Return the outlines or shells of a machine of the same sizes, with its assembly."""
        return None, None

    def dimensions(self, model: SharedParts) -> Iterator[Dimension | Missing]:
        """Yield the dimensions of the parts, or the reason why there are none."""
        yield from ()

    def stressed(self, mechanism: Mechanism) -> Stressed | None:
        """Return the sizes of stressed parts, if a layout of flat parts does not have them."""
        return None


def kind_of(mechanism: Mechanism) -> PartsKind:
    """Return the kind of a machine's parts."""
    kinds = {
        "flat": "flat:Flat",
        "ball": "ball:Ball",
        "rack": "rack:Rack",
        "counter": "counter:Counter",
    }
    name = kinds.get(mechanism.spec.wheel.PARTS, "unbuilt:Unbuilt")
    return load_named(f"drawings.kinds.{name}")()
