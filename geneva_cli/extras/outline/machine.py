"""A machine whose wheel or crank somebody else drew: its outlines, ready to be turned."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, Notice, below, cut
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.loops import Loop, greatest_gap, loops, shown
from geneva_cli.geometry.measure import turned_pieces
from geneva_cli.geometry.moments import moments, total
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Line, Point, closed, two_arcs
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.jet import Jet, atan2
from geneva_cli.output.foreign import read_drawing
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.free_ranges import FreeRanges, levels

EXACT_MM, MOST_MM = 1e-6, 1e-3  # overlaps that count as touching: of exact arcs, of short lines

OFF_AXIS = 0.05  # of L: farther from the origin is no wheel with a bolt or a slot less


class Roller(NamedTuple):
    """A roller of the crank, mm; ``is_drawn`` if the crank's drawing has it."""

    distance: float  # from the crank's axis
    radius: float
    is_drawn: bool
    ideal_distance: float  # with which it would enter without an impact


class DrawnMachine(NamedTuple):
    """The outlines of wheel and crank in their own frames, and how the crank turns the wheel."""

    assembly: Assembly
    wheel: tuple[Contour, ...]
    crank: tuple[Contour, ...]  # all that lies in the wheel's plane, rollers too
    roller: Roller
    free: FreeRanges
    start: float  # crank angle in the middle of a dwell, radians from mid-motion
    rest: float  # the wheel's angle there, radians from the middle of its step
    notes: tuple[Notice, ...]

    @property
    def step(self) -> float:
        """How far the wheel should turn in a turn of the crank, radians."""
        return sum(2.0 * motion.engagement.half_step for motion in self.assembly.motions)

    @property
    def slots_a_turn(self) -> int:
        """Number of slots that a turn of the crank should pass."""
        return len(self.assembly.motions)

    def deepest(self, points: Sequence[Point]) -> tuple[float, Point]:
        """Return how deep points of the crank lie in the wheel in the middle of the dwell, mm.

        The place is that of the deepest one, in the wheel's own frame; the depth is below 0 if all
        lie outside.
        """
        turn = float(self.free.crank_direction(np.array([self.start]))[0])
        z = np.array([complex(*point) for point in points]) * np.exp(1j * turn)
        z = (z + self.assembly.L) * np.exp(-1j * self.rest)
        depth = -Polyarc(self.wheel).signed(np.column_stack((z.real, z.imag)))
        i = int(np.argmax(depth))
        return float(depth[i]), (float(z[i].real), float(z[i].imag))


def drawn_machine(mechanism: Mechanism) -> DrawnMachine:
    """Return a machine with the drawings of its ``[outline]``.

    Raises GenevaError for a drawing that cannot be read or is no outline, for a machine that no
    crank turns, and where no part reaches the other.
    """
    spec, place = mechanism.spec, _assembly(mechanism)
    outline, notes = spec.outline, list[Notice]()
    wheel, crank = (_drawn(spec, part, notes) for part in ("wheel", "crank"))
    if not (wheel and crank):
        own = parts_of(mechanism).flat.outlines
    theirs = wheel.contours if wheel else (own.wheel,)
    ours, roller = _with_rollers(crank, mechanism, place, tuple(own.crank) if not crank else ())
    rounded = sum(drawn.slack for drawn in (wheel, crank) if drawn)
    slack = outline.slack_mm or min(max(rounded, EXACT_MM), MOST_MM)
    L, z = place.L, spec.wheel.z
    both = Polyarc(theirs), Polyarc(ours)
    _require_reach(*both, L)
    if wheel and len(place.kinds) == 1:
        _require_centre(theirs, L)
    free = FreeRanges(*both, L, place.sign, math.tau / z, slack)
    first = place.motions[0]
    dwell = _dwell_deg(place)
    start = math.radians(first.entry - 0.5 * dwell)
    rest = -first.engagement.half_step
    return DrawnMachine(place, theirs, ours, roller, free, start, rest, tuple(notes))


def crank_jet(mechanism: Mechanism, input_deg: Array) -> tuple[Jet, Array]:
    """Return the crank's angle, radians, with its derivatives by the input's, and whole turns.

    The angle is within half a turn of mid-motion; the turns are those of the crank beside it.
    """
    first = mechanism.engagements[0]
    turn_deg = 360.0 * mechanism.spec.turns
    whole = np.round((input_deg - first.mid_deg) / turn_deg)
    x, y = first.path(input_deg - first.mid_deg - turn_deg * whole, 3)
    out = atan2(y, 1.0 - x) if mechanism.spec.wheel.SIGN > 0.0 else atan2(y, x - 1.0)
    size = np.zeros(len(input_deg))
    return Jet([c + size for c in out.c]), whole


def _require_centre(wheel: tuple[Contour, ...], L: float) -> None:
    """Refuse a drawing of equal steps that does not lie about its origin, the wheel's axis."""
    x, y = total(map(moments, wheel)).centroid
    if math.hypot(x, y) > OFF_AXIS * L:
        raise GenevaError(
            f"the drawn wheel's centre is at {shown((x, y))}, but its axis is the drawing's "
            "origin: move the drawing there",
            ("outline", "wheel"),
        )


def _dwell_deg(place: Assembly) -> float:
    """Return the dwell before the first motion of the plain crank, degrees."""
    first, last = place.motions[0], place.motions[-1]
    return first.entry + place.turn_deg - last.exit


def _assembly(mechanism: Mechanism) -> Assembly:
    """Return the positions of the crank; its rollers must go round its axis."""
    wheel = mechanism.spec.wheel
    if not wheel.FLAT:
        raise GenevaError(
            f'gearing = "{wheel.NAME}": an outline is turned in one plane about two axes, as those '
            'of gearing = "external" and "internal" are',
            ("outline",),
        )
    place = assembly(mechanism)
    at = np.linspace(-180.0, 180.0, 9)
    axis = np.array((place.L, 0.0))
    first = place.pin(0, at) - axis
    ahead = np.pi - np.radians(at) if place.sign > 0.0 else np.radians(at)
    R = np.hypot(*first.T)
    aligned = np.abs(first - R[:, None] * np.column_stack((np.cos(ahead), np.sin(ahead)))).max()
    if np.ptp(R) > 1e-9 * place.L or aligned > 1e-9 * place.L:
        raise GenevaError(
            "an outline is turned by rollers on a crank, but the rollers of this drive do not go "
            'round the crank\'s axis: use kind = "crank" or another drive with a crank',
            ("outline",),
        )
    return place


class _Drawn(NamedTuple):
    """The outlines of a drawing in the frame of our own, and how far rounding may overlap them."""

    loops: tuple[Loop, ...]
    slack: float  # mm

    @property
    def contours(self) -> tuple[Contour, ...]:
        return tuple(loop.contour for loop in self.loops)


def _drawn(spec: Spec, part: str, notes: list[Notice]) -> _Drawn | None:
    """Return the outlines of a part's drawing, mirrored about x and then turned; None without."""
    outline = vars(spec.outline)
    file = outline[part]
    if file is None:
        return None
    path = below(os.path.dirname(spec.path), file)
    drawn = read_drawing(path)
    notes += [Notice("outline-units", f"{cut(file, 100)}: {text}") for text in drawn.notes]
    pieces = list(drawn.pieces)
    if outline["mirror"] in (part, "both"):
        pieces = [_mirrored(piece) for piece in pieces]
    turn = math.radians(outline[f"{part}_turn_deg"])
    pieces = [p for p in turned_pieces(pieces, turn) if not isinstance(p, Cubic)]
    try:
        own = tuple(loops(pieces))
    except GenevaError as error:
        raise GenevaError(f"{cut(path, 300)}: {error}") from None
    if not (drawn.is_exact and any(isinstance(piece, Arc) for piece in pieces)):
        return _Drawn(own, MOST_MM)  # facets
    gap = 2.0 * greatest_gap(pieces)  # of numbers that were rounded
    return _Drawn(own, gap if gap > EXACT_MM else 0.0)


def _mirrored(piece: Line | Arc) -> Line | Arc:
    (x0, y0), (x1, y1) = piece.start, piece.end
    if isinstance(piece, Arc):
        return Arc((x0, -y0), (x1, -y1), -piece.bulge)
    return Line((x0, -y0), (x1, -y1))


def _with_rollers(
    drawn: _Drawn | None, mechanism: Mechanism, place: Assembly, own: tuple[Contour, ...]
) -> tuple[tuple[Contour, ...], Roller]:
    """Return the crank with its rollers: those that its drawing has, or our own."""
    axis = np.array((place.L, 0.0))
    radius = mechanism.roller_radius_mm
    # of all rollers, in the crank's frame
    pins = [place.pin(i, np.zeros(1))[0] - axis for i in range(len(place.rollers))]
    ahead = np.pi if place.sign > 0.0 else 0.0
    turned = [complex(*pin) * complex(math.cos(-ahead), math.sin(-ahead)) for pin in pins]
    R = ideal = abs(turned[0])
    if mechanism.engagements[0].built:  # radial slots on a crank that was built for others
        ideal = place.L * math.sin(math.pi / mechanism.spec.wheel.z)
    crank, found = own, list[Circle]()
    if drawn:
        found = [c for loop in drawn.loops if (c := _as_roller(loop)) is not None]
        rest = [loop.contour for loop in drawn.loops if _as_roller(loop) is None]
        crank = (*rest, *map(_round, found))
    if found:
        return crank, Roller(math.hypot(*found[0].centre), found[0].radius, True, ideal)
    if drawn and Polyarc(crank).signed(np.array([(turned[0].real, turned[0].imag)]))[0] < 0.0:
        return crank, Roller(R, radius, True, ideal)
    rollers = [_round(Circle("ROLLER", (pin.real, pin.imag), radius)) for pin in turned]
    return (*crank, *rollers), Roller(R, radius, False, ideal)


def _round(roller: Circle) -> Contour:
    """Return a roller as two arcs, whose ends are not where it touches straight slots.

    At an entry both walls touch it across the crank's arm, where ends would count as corners.
    """
    across = math.atan2(roller.centre[1], roller.centre[0])
    return closed("ROLLER", two_arcs(roller, across + 1.0))


def _as_roller(loop: Loop) -> Circle | None:
    """Return an outline that is a full circle beside the crank's axis as one."""
    circle = None if loop.is_hole else _as_circle(loop)
    return circle if circle and math.hypot(*circle.centre) > circle.radius else None


def _as_circle(loop: Loop) -> Circle | None:
    """Return an outline that is a full circle as one."""
    pieces = loop.contour.segments
    if not all(isinstance(piece, Arc) for piece in pieces):
        return None
    first = pieces[0]
    assert isinstance(first, Arc)
    near = 1e-6 * first.radius
    same = [
        isinstance(p, Arc)
        and math.dist(p.centre, first.centre) < near
        and abs(p.radius - first.radius) < near
        for p in pieces
    ]
    return Circle("ROLLER", first.centre, first.radius) if all(same) else None


def _require_reach(wheel: Polyarc, crank: Polyarc, L: float) -> None:
    """Raise GenevaError if no part reaches the other."""
    far = float(levels(crank)[1].max())
    inner, rim = (float(v) for v in (levels(wheel)[0].min(), levels(wheel)[1].max()))
    if wheel.signed(np.zeros((1, 2)))[0] < 0.0:  # its material lies about its axis
        inner = 0.0
    if L - far > rim or L + far < inner:
        raise GenevaError(
            f"no part reaches the other. The crank reaches {far:.6g} mm from its axis, the wheel "
            f"lies {inner:.6g} to {rim:.6g} mm from its own. The axes are {L:.6g} mm apart: set "
            "center_distance_mm in [size], and check the drawings' units",
            ("outline",),
        )
