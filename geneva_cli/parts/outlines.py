"""The outlines of a machine's parts, and the relief of the crank that clears the wheel."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.distance import Polyarc
from geneva_cli.curves.shapes import Contour
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.crank import crank_contours, is_whole
from geneva_cli.parts.reliefs import has_arcs, without_lock
from geneva_cli.parts.sizes import Sizes, sizes
from geneva_cli.parts.turn.gaps import Gaps, turned_points
from geneva_cli.parts.turn.turned import Pose
from geneva_cli.parts.walls.curved import curved_walls
from geneva_cli.parts.walls.straight import straight_walls
from geneva_cli.parts.wheel import wheel_contour

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

CURVED = 2e-6  # of the centre distance: how nearly curved walls are known
# Of the centre distance, 0.2 um in 100 mm: parts that overlap by less touch each other. No cutter
# and no roller is as true as that, and curved walls are known no better.
CONTACT = CURVED
TRIES = 5
SPARE = 3.0  # times an overlap that was found, kept more from the wheel
SWEPT_DEG = 0.2  # of the input, between the places of the wheel that a relief must clear
SOME = 16  # of which one of so many tells most reliefs that do not


class Outlines(NamedTuple):
    """The outlines of wheel and crank, for drawings and for the full turn.

    ``slots`` has the walls of each kind of slot; ``close`` is the overlap in mm that is rounding,
    or the walls' tolerance.
    """

    assembly: Assembly
    sizes: Sizes
    slots: dict[Engagement, Contour]
    wheel: Contour
    crank: list[Contour]
    relief: str
    gaps: Gaps
    close: float
    fine: float  # mm, the tolerance that curved walls are fitted to

    @property
    def contact(self) -> float:
        """The overlap, mm, up to which parts count as touching."""
        return CONTACT * self.assembly.L

    def over(self, assembly: Assembly) -> Outlines:
        """The same parts where another assembly has them."""
        return self._replace(assembly=assembly)

    def in_wheel(self, motion: int, at: Array) -> Array:
        """Where a motion's roller is in the wheel's frame, mm, at input angles (n,): (n, 2)."""
        return turned_points(self.assembly.driving(motion, at), -self.assembly.wheel(at))

    def past_mouth(self, motion: int, at: Array) -> Array:
        """How far that is in its slot, past the mouth's corners, mm, (n,)."""
        # these are half a slot's width beside its middle, on the rim
        level = math.sqrt(max(self.sizes.rim**2 - self.sizes.half_width**2, 0.0))
        far = np.hypot(*self.assembly.driving(motion, at).T)
        past: Array = self.assembly.sign * (level - far)
        return past

    @property
    def relief_depth(self) -> float:
        """The distance of the crank's outline from its axis at the bottom of a relief, mm."""
        return abs(float(Polyarc(self.crank).signed(np.zeros((1, 2)))[0]))


def outlines(mechanism: Mechanism, tolerance: float = 0.0) -> Outlines:
    """The outlines in lines and arcs, within ``tolerance`` mm: what the full turn is made with.

    A finer tolerance than the walls are known to is taken as that. The crank's is exact.
    Raises GenevaError where the machine has no flat parts, or its sizes leave none.
    """
    where = assembly(mechanism)
    return drawn(where, sizes(where), tolerance)


def drawn(assembly: Assembly, sizes: Sizes, tolerance: float = 0.0) -> Outlines:
    """The same of an assembly whose sizes are known."""
    kinds, L = assembly.kinds, assembly.L
    fine = max(0.5 * CURVED * L, tolerance)
    walls = {engagement: slot_walls(assembly, sizes, engagement, fine) for engagement in kinds}
    close = (CURVED if any(engagement.slot.curved for engagement in kinds) else SAME_LENGTH) * L
    wheel = wheel_contour(assembly, sizes, walls)
    crank, relief, gaps = _relieved(Gaps(assembly, sizes, wheel, []), close)
    return Outlines(assembly, sizes, walls, wheel, crank, relief, gaps, close, fine)


def slot_walls(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, tolerance: float, curves: str = "arcs"
) -> Contour:
    """The walls of one slot, straight or curved; see ``curved_walls`` for ``curves``."""
    if engagement.slot.curved:
        return curved_walls(assembly, sizes, engagement, tolerance, curves)
    return straight_walls(assembly, sizes, engagement)


def _relieved(bare: Gaps, close: float) -> tuple[list[Contour], str, Gaps]:
    """The crank with the relief that the spec asks for, or else the first that clears the wheel.

    The arc leaves the most of the disc and is one cut; where it collides, as at many slots, the
    whole sector is cut down to where the wheel never comes.
    """
    assembly, sizes = bare.assembly, bare.sizes
    if not sizes.lock:
        return [], "none", bare
    asked = assembly.mechanism.spec.size.relief
    whole = is_whole(assembly, sizes)
    swept = cache(lambda i, every: bare.swept(i, SWEPT_DEG, every))
    if whole and not asked and not without_lock(assembly) and has_arcs(assembly, sizes.lock):
        crank = crank_contours(assembly, sizes, "arc", swept)
        gaps = bare.with_crank(crank)
        if all(_overlap(gaps, close, every) <= close for every in (SOME, 1)):
            return crank, "arc", gaps
    kind, spare = asked or "sector", 0.0
    crank = crank_contours(assembly, sizes, kind, swept)
    gaps = bare.with_crank(crank)
    for _ in range(0 if whole else TRIES):
        overlap = _overlap(gaps, close)
        if overlap <= close:
            break
        # Between two of the places that were looked at the wheel came nearer still.
        spare += SPARE * overlap + 10.0 * close
        crank = crank_contours(assembly, sizes, kind, swept, spare)
        gaps = bare.with_crank(crank)
    return crank, kind, gaps


def _overlap(gaps: Gaps, close: float, every: int = 1) -> float:
    """The greatest overlap of crank and wheel in all motions, mm, or at some of the places that are
    looked at; wider gaps are not told apart than by ``close``.
    """
    least = 0.0
    for engagement, behind in gaps.assembly.motions:
        count = 2 + int(engagement.motion_deg / SWEPT_DEG)
        at = (
            behind + np.linspace(engagement.entry_deg, engagement.exit_deg, count) + 0.3 * SWEPT_DEG
        )[::every]
        # without rollers, which lock nothing
        pose = Pose(gaps.assembly.wheel(at), gaps.assembly.crank(at), np.empty((len(at), 0, 2)))
        least = min(least, float(gaps.locking(pose, near=close).min()))
    return -least
