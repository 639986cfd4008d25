"""The parts of a machine and their full turn, each computed once, on first use."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from geneva_cli.drawings.kinds.kind import kind_of
from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism

if TYPE_CHECKING:
    from collections.abc import Callable

    from geneva_cli.collisions.full_turn import FullTurn
    from geneva_cli.collisions.gaps import WorkLimit
    from geneva_cli.collisions.machine_parts import MachineParts
    from geneva_cli.layout.assembly import Assembly
    from geneva_cli.layout.plain_sizes import Sizes
    from geneva_cli.layout.roller_paths import RollerPaths
    from geneva_cli.outlines.outlines import Outlines
    from geneva_cli.parts.flat_parts import FlatParts
    from geneva_cli.parts.parts_of_machine import PartsOfMachine
    from geneva_cli.parts.sphere.shells import Shells


class PartsModel:
    """The outlines, the parts and the full turn of one machine, shared by all who need them.

    What makes them is imported at its first use: most runs need few of the parts.
    ``known`` and ``known_shells`` are its outlines or its shells, if they are computed already.
    Without ``advice`` an error does not name the roller that fits, which takes long to find.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        known: Outlines | None = None,
        advice: bool = True,
        known_shells: Shells | None = None,
    ) -> None:
        self.mechanism = mechanism
        self.known, self.known_shells = known, known_shells
        self.advice = advice
        self.kind = kind_of(mechanism)

    def over(self, mechanism: Mechanism) -> PartsModel:
        """Return the model of a machine whose parts have the same outlines and positions."""
        from geneva_cli.layout.assembly import input_of

        to_input = input_of(mechanism)
        assembly = self.parts.assembly._replace(full=mechanism, to_input=to_input)
        known, shells = self.kind.known(self, assembly)
        return PartsModel(mechanism, known, self.advice, shells)

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
        from geneva_cli.layout.sizes import machine_sizes

        own, other = (
            (spec.wheel, spec.drive.replace(n_rpm=1.0), spec.motion, spec.size)
            for spec in (self.mechanism.spec, mechanism.spec)
        )
        try:
            return own == other and machine_sizes(mechanism)[1] == self.sizes
        except GenevaError:
            return False

    @cached_property
    def assembly(self) -> Assembly:
        """Positions of flat parts; raises GenevaError for a machine without them."""
        from geneva_cli.layout.assembly import assembly

        return self.known.assembly if self.known else assembly(self.mechanism)

    @cached_property
    def paths(self) -> RollerPaths:
        """The paths of the rollers, which do not depend on sizes."""
        from geneva_cli.layout.roller_paths import roller_paths

        return roller_paths(self.assembly)

    @cached_property
    def sizes(self) -> Sizes:
        """The sizes of flat parts; raises GenevaError where those of the spec leave no wheel."""
        from geneva_cli.layout.sizes import machine_sizes

        return self.known.sizes if self.known else machine_sizes(self.mechanism)[1]

    @cached_property
    def outlines(self) -> Outlines:
        """The outlines; raises GenevaError where the sizes leave none."""
        from geneva_cli.outlines.outlines import drawn

        return self.known or drawn(self.assembly, self.sizes)

    @cached_property
    def shells(self) -> Shells:
        """The shells of a machine on a sphere; raises GenevaError where the sizes leave none."""
        from geneva_cli.parts.sphere.shells import shells

        return self.known_shells or shells(self.mechanism, self.advice)

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
    def all_built(self) -> list[tuple[str, Callable[[], PartsOfMachine]]]:
        """Names and functions of all parts: before a sphere or a rack links and gears are flat."""
        return self.kind.all_built(self)

    @cached_property
    def parts(self) -> MachineParts:
        """The parts that are turned: outlines, shells, or a rack and its crank."""
        return self.kind.turned(self)

    @property
    def turn(self) -> FullTurn:
        """The full turn; raises WorkLimit where it takes too long."""
        from geneva_cli.collisions.gaps import WorkLimit

        if isinstance(self._turn, WorkLimit):
            raise self._turn
        return self._turn

    @cached_property
    def _turn(self) -> FullTurn | WorkLimit:
        from geneva_cli.collisions.full_turn import full_turn
        from geneva_cli.collisions.gaps import WorkLimit

        # That it takes too long is remembered too.
        try:
            return full_turn(self.parts)
        except WorkLimit as error:
            return error
