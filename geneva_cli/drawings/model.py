"""The parts of a machine and their full turn, each computed once, on first use.

Each kind of parts is a class below, and a line in ``kind_of``: how the parts of some wheels are
built, drawn, turned and measured. A kind is imported with the model, and what it builds is not.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, ClassVar, NoReturn, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.kept import cached_property
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Dimension
from geneva_cli.motion.records import of_wheel
from geneva_cli.parts.missing import Missing
from geneva_cli.spec.load_named import load_named

if TYPE_CHECKING:
    from geneva_cli.kinds.spherical.shells import Shells
    from geneva_cli.parts.flat_parts import FlatParts
    from geneva_cli.parts.outlines.outlines import Outlines
    from geneva_cli.parts.parts_of_machine import PartsOfMachine
    from geneva_cli.parts.sizes.stressed import Stressed
    from geneva_cli.parts.turn.full_turn import FullTurn
    from geneva_cli.parts.turn.machine_parts import MachineParts, WorkLimit

    NamedBuilds: TypeAlias = list[tuple[str, Callable[[], PartsOfMachine]]]


class PartsModel:
    """The outlines, the parts and the full turn of one machine, shared by all who need them.

    What makes them is imported at its first use: most runs need few of the parts.
    Without ``advice`` an error does not name the roller that fits, which takes long to find.
    """

    def __init__(self, mechanism: Mechanism, advice: bool = True) -> None:
        self.mechanism, self.advice = mechanism, advice
        self.kind = kind_of(mechanism)

    def over(self, mechanism: Mechanism) -> PartsModel:
        """Return the model of a machine whose parts have the same outlines and positions."""
        from geneva_cli.parts.assembly import input_of

        own, to_input = self.parts, input_of(mechanism)
        model = PartsModel(mechanism, self.advice)
        parts = own.over(own.assembly._replace(full=mechanism, to_input=to_input))
        vars(model)[self.kind.TURNED] = parts
        return model

    def following(self, mechanism: Mechanism) -> PartsModel:
        """Return the model of the next design, with these outlines and this turn if they are equal.

        They are equal if wheel, drive, motion and ``[size]`` are, but for the speed, and all sizes
        that follow from the load.
        """
        computed = vars(self)
        if "outlines" not in computed or not self._has_parts_of(mechanism):
            return PartsModel(mechanism)
        model = self.over(mechanism)
        if "_turn" in computed:
            vars(model)["_turn"] = computed["_turn"]
        return model

    def _has_parts_of(self, mechanism: Mechanism) -> bool:
        from geneva_cli.parts.outlines.outline_sizes import machine_sizes

        own, other = (
            (spec.wheel, spec.drive.replace(n_rpm=1.0), spec.motion, spec.size)
            for spec in (self.mechanism.spec, mechanism.spec)
        )
        try:
            return own == other and machine_sizes(mechanism)[1] == self.outlines.sizes
        except GenevaError:
            return False

    @cached_property
    def front(self) -> PartsModel:
        """The model of the first of two wheels in series. Raises GenevaError without a second."""
        from geneva_cli.parts.first_pair import first_pair

        return PartsModel(first_pair(self.mechanism))

    @cached_property
    def outlines(self) -> Outlines:
        """The outlines; raises GenevaError where the sizes leave none."""
        from geneva_cli.parts.outlines.outline_sizes import outlines

        return outlines(self.mechanism)

    @cached_property
    def shells(self) -> Shells:
        """The shells of a machine on a sphere; raises GenevaError where the sizes leave none."""
        from geneva_cli.kinds.spherical.shells import shells

        return shells(self.mechanism, self.advice)

    @cached_property
    def flat(self) -> FlatParts:
        """The parts of a flat machine, as accurate as the checks need them."""
        from geneva_cli.parts.flat_parts import FlatParts

        return FlatParts(self.mechanism, self.outlines if self.mechanism.spec.is_flat else None)

    @cached_property
    def built(self) -> PartsOfMachine:
        """The parts that the checks at rest measure."""
        return self.kind.built(self)

    @property
    def all_built(self) -> NamedBuilds:
        """Names and functions of all parts: before a sphere or a rack links and gears are flat."""
        return self.kind.all_built(self)

    @cached_property
    def parts(self) -> MachineParts:
        """The parts that are turned: outlines, shells, or a rack and its crank."""
        return self.kind.turned(self)

    @property
    def turn(self) -> FullTurn:
        """The full turn; raises WorkLimit where it takes too long."""
        from geneva_cli.parts.turn.machine_parts import WorkLimit

        if isinstance(self._turn, WorkLimit):
            raise self._turn
        return self._turn

    @cached_property
    def _turn(self) -> FullTurn | WorkLimit:
        from geneva_cli.parts.turn.full_turn import full_turn
        from geneva_cli.parts.turn.machine_parts import WorkLimit

        # That it takes too long is remembered too.
        try:
            return full_turn(self.parts)
        except WorkLimit as error:
            return error


class PartsKind(ABC):
    """The parts of wheels of one kind; functions in tables are written ``module:function``."""

    # functions that draw parts, or make their sheets, by the names of the parts, where they are not
    # those of the catalogue
    DRAWN: ClassVar[Mapping[str, str]] = {}
    # functions that tabulate parts, where it is not the function of the catalogue
    TABLES: ClassVar[Mapping[str, str]] = {}
    # True if it has all parts of flat machines as well, such as links and gears
    HAS_FLAT_PARTS: ClassVar[bool] = False
    # the property of a model that holds what is turned
    TURNED: ClassVar[str] = "parts"
    # parts whose outlines are those of a surface laid flat
    LAID_FLAT: ClassVar[tuple[str, ...]] = ()

    @abstractmethod
    def built(self, model: PartsModel) -> PartsOfMachine:
        """Return the parts. Raises GenevaError where the sizes leave none."""

    @abstractmethod
    def turned(self, model: PartsModel) -> MachineParts:
        """Return what is turned to find collisions. Raises GenevaError where there is none."""

    def all_built(self, model: PartsModel) -> NamedBuilds:
        """Return names and functions of all parts."""
        return [("all parts", lambda: model.built)]

    def dimensions(self, model: PartsModel) -> Iterator[Dimension | Missing]:
        """Yield the dimensions of the parts, or the reason why there are none."""
        yield from ()

    def stressed(self, mechanism: Mechanism) -> Stressed | None:
        """Return the sizes of stressed parts, if a layout of flat parts does not have them."""
        return None


class Flat(PartsKind):
    """Plates in the plane, whose functions stand in the catalogue."""

    HAS_FLAT_PARTS: ClassVar[bool] = True
    TURNED: ClassVar[str] = "outlines"

    def built(self, model: PartsModel) -> FlatParts:
        """Return the parts."""
        return model.flat

    def turned(self, model: PartsModel) -> Outlines:
        """Return the outlines."""
        return model.outlines


class Unbuilt(PartsKind):
    """No parts but the links and gears in front of the crank."""

    def built(self, model: PartsModel) -> NoReturn:
        """Raise GenevaError with the reason."""
        raise GenevaError(model.mechanism.spec.no_parts, ("wheel", "gearing"))

    def turned(self, model: PartsModel) -> NoReturn:
        """Raise GenevaError with the reason."""
        self.built(model)

    def all_built(self, model: PartsModel) -> NamedBuilds:
        """Return name and function of links and gears."""
        return [("all parts", lambda: model.flat)]


def before_links(model: PartsModel) -> NamedBuilds:
    """Return names and functions of all parts where those of links and gears are flat."""
    return [("wheel and crank", lambda: model.built), ("all parts", lambda: model.flat)]


def kind_of(mechanism: Mechanism) -> PartsKind:
    """Return the kind of a machine's parts."""
    of_parts = [kind.parts for kind in of_wheel(mechanism.spec.wheel.NAME) if kind.parts]
    kind: PartsKind = load_named(of_parts[-1])() if of_parts else Unbuilt()
    return kind
