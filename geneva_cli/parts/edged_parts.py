"""The base of parts of wheels and racks: plates with the spec's edges, frame, shafts."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable
from typing import TYPE_CHECKING

from geneva_cli.geometry.plates import Edge, Member, Plate, edged, plates
from geneva_cli.geometry.shapes import Circle
from geneva_cli.kept import cached_property
from geneva_cli.parts.parts import Parts

if TYPE_CHECKING:
    from geneva_cli.geometry.gear_teeth import Writer
    from geneva_cli.parts.mounted_plate import FrameAndShafts, Unborne
    from geneva_cli.parts.shafts.screws import Screws


class EdgedParts(Parts):
    """The parts of a machine whose plates have the edges of ``[size]``."""

    def writer(self, fine: float) -> Writer:
        """Return a function that fits curves: within ``fine`` mm where no tolerance is set."""
        from geneva_cli.geometry import fit

        if self.tolerance is None:
            return lambda curve, a, b: fit.cubics(curve, a, b, fine)
        kind, tolerance = fit.KINDS[self.curves], self.tolerance
        return lambda curve, a, b: kind(curve, a, b, tolerance)

    @property
    @abstractmethod
    def wheel(self) -> Member:
        """The wheel or the rack."""

    @property
    @abstractmethod
    def crank_without_arm(self) -> Member:
        """The crank as it lies in the plane of the wheel or the rack."""

    @property
    @abstractmethod
    def _framed(self) -> FrameAndShafts:
        """The frame and the shafts with sharp edges, computed once."""

    @cached_property
    def shafts(self) -> tuple[Member, ...]:
        """All shafts, whether they reach the frame or not."""
        return self._edged(self._framed.shafts)

    @cached_property
    def frame(self) -> Member:
        """The frame, which holds the shafts."""
        return self._edged([Member(self._framed.plate)])[0]

    @property
    def frame_threads(self) -> tuple[Circle, ...]:
        """The tapped holes of the frame."""
        return self._framed.threads

    @property
    def frame_screws(self) -> tuple[Screws, ...]:
        """The screws that fix parts to the frame, and those of its mounting holes."""
        return self._framed.screws

    @property
    def to_fix(self) -> tuple[str, ...]:
        """Names of the parts that turn with a shaft in a round bore, which holds nothing."""
        return tuple({"crank": "arm"}.get(name, name) for name in self._framed.to_fix)

    @property
    def unborne(self) -> tuple[Unborne, ...]:
        """The shafts that have no bearing."""
        return self._framed.unborne

    @property
    def required(self) -> tuple[Member, ...]:
        """The parts without which the machine is not built."""
        return self.members

    def require(self) -> None:
        """Raise GenevaError for a part that cannot be built."""
        from geneva_cli.geometry.stacks import require_faces

        for member in self.required:
            for plate in plates(member.part):
                require_faces(plate)

    @property
    def _edge(self) -> Edge:
        """The edges of all plates but gears, whose edges are teeth."""
        size = self.mechanism.spec.size
        return Edge(size.edge_mm, rounded=size.edge_chamfer_mm is None)

    def _plate(self, plate: Plate) -> Plate:
        """Return a plate with the spec's edges."""
        return plate._replace(edge=self._edge)

    def _edged(self, members: Iterable[Member]) -> tuple[Member, ...]:
        """Return members with the spec's edges."""
        return tuple(edged(one, self._edge) for one in members)
