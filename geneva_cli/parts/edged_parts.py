"""The base of parts of wheels and racks: plates with the spec's edges, frame, shafts."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple, Self

from geneva_cli.geometry.edges import Edge
from geneva_cli.geometry.plates import Member, Plate, edged
from geneva_cli.geometry.shapes import Circle
from geneva_cli.kept import cached_property
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.mounted_plate import mounts_of
from geneva_cli.parts.parts_of_machine import PartsOfMachine, Unborne
from geneva_cli.parts.shafts.bolt_holes import Screws, tapped

if TYPE_CHECKING:
    from geneva_cli.geometry.gear_teeth import Writer


class Screwed(NamedTuple):
    """A screw of a part that is fixed to the frame: its clearance hole, and the part's name."""

    hole: Circle
    part: str


class FrameAndShafts(NamedTuple):
    """The frame, what is on it, and the shafts, whether they reach it or not."""

    plate: Plate
    shafts: tuple[Member, ...]
    spacers: tuple[Member, ...] = ()  # below the parts that are screwed to it
    screwed: tuple[Screwed, ...] = ()
    to_fix: tuple[str, ...] = ()  # names of what the shafts turn, and nothing holds on them
    bridge: Member | None = None  # bears the crank's shaft from above
    unborne: tuple[Unborne, ...] = ()


class EdgedParts(PartsOfMachine):
    """The parts of a machine whose plates have the edges of ``[size]``.

    Curved outlines are ``curves``, "arcs" or "cubics", within ``tolerance`` mm. Without a tolerance
    they are as accurate as the checks need them.
    """

    def __init__(
        self, mechanism: Mechanism, tolerance: float | None = None, curves: str = "arcs"
    ) -> None:
        self.mechanism = mechanism
        self.tolerance, self.curves = tolerance, curves

    def within(self, tolerance: float, curves: str) -> Self:
        """Return these parts with curves of a kind within a tolerance, mm."""
        return type(self)(self.mechanism, tolerance, curves)

    def finer(self, tolerance: float) -> Self:
        """Return these parts with curves that are at least so accurate, mm."""
        own = self.tolerance
        return self.within(tolerance if own is None else min(tolerance, own), self.curves)

    def writer(self, fine: float) -> Writer:
        """Return a function that fits curves: within ``fine`` mm where no tolerance is set."""
        from geneva_cli.geometry import fit

        if self.tolerance is None:
            return lambda curve, a, b: fit.cubics(curve, a, b, fine)
        kind, tolerance = fit.KINDS[self.curves], self.tolerance
        return lambda curve, a, b: kind(curve, a, b, tolerance)

    def require_wheel(self) -> None:
        """Raise GenevaError where only links and gears are drawn; other parts have a wheel."""

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
        return tuple(tapped(one.hole) for one in self._framed.screwed)

    @property
    def frame_screws(self) -> tuple[Screws, ...]:
        """The screws that fix parts to the frame, and those of its mounting holes."""
        screwed = self._framed.screwed
        kinds = dict.fromkeys((one.part, one.hole.radius) for one in screwed)
        fixed = (
            Screws(
                part,
                sum((one.part, one.hole.radius) == (part, radius) for one in screwed),
                2.0 * radius,
                "the frame",
            )
            for part, radius in kinds
        )
        mounts = mounts_of(self._framed.plate)
        own = Screws("frame", len(mounts), 2.0 * mounts[0].radius, "its base") if mounts else None
        return (*fixed, own) if own else tuple(fixed)

    @property
    def to_fix(self) -> tuple[str, ...]:
        """Names of the parts that turn with a shaft in a round bore, which holds nothing."""
        return tuple({"crank": "arm"}.get(name, name) for name in self._framed.to_fix)

    @property
    def unborne(self) -> tuple[Unborne, ...]:
        """The shafts that have no bearing."""
        return self._framed.unborne

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
