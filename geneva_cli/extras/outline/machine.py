"""A machine whose wheel or crank somebody else drew: its outlines, ready to be turned."""

import math
import os
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError, Notice, below, cut
from geneva_cli.geometry import shapes
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.loops import greatest_gap, loops, shown
from geneva_cli.geometry.plates import moments, total
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.jet import Jet, atan2
from geneva_cli.output.foreign import read_drawing
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.turn.free_ranges import FreeRanges, levels

EXACT_MM, MOST_MM = 1e-6, 1e-3  # overlaps that count as touching: of exact arcs, of short lines
Contours: TypeAlias = tuple[shapes.Contour, ...]
OFF_AXIS = 0.05  # of L: farther from the origin is no wheel with a bolt or a slot less


class DrawnMachine(NamedTuple):
    """The outlines of wheel and crank in their own frames, and how the crank turns the wheel."""

    assembly: Assembly
    wheel: Contours
    crank: Contours  # all that lies in the wheel's plane, rollers too
    roller: shapes.Circle  # the first of them, in the crank's frame
    free: FreeRanges
    start: float  # crank angle in the middle of a dwell, radians from mid-motion
    rest: float  # the wheel's angle there, radians from the middle of its step
    notes: tuple[Notice, ...]

    @property
    def step(self) -> float:
        """How far the wheel should turn in a turn of the crank, radians."""
        return sum(2.0 * motion.engagement.half_step for motion in self.assembly.motions)

    def deepest(self, points: Sequence[shapes.Point]) -> tuple[float, shapes.Point]:
        """How deep points of the crank lie in the wheel in mid-dwell, mm, and where."""
        turn = float(self.free.crank_direction(np.array([self.start]))[0])
        z = np.array([complex(*point) for point in points]) * np.exp(1j * turn)
        z = (z + self.assembly.L) * np.exp(-1j * self.rest)
        depth = -Polyarc(self.wheel).signed(np.column_stack((z.real, z.imag)))
        i = int(np.argmax(depth))
        return float(depth[i]), (float(z[i].real), float(z[i].imag))


def drawn_machine(mechanism: Mechanism) -> DrawnMachine:
    """A machine with the drawings of its ``[outline]``."""
    spec, place = mechanism.spec, _assembly(mechanism)
    notes = list[Notice]()
    wheel, crank = (_drawn(spec, part, notes) for part in ("wheel", "crank"))
    if not (wheel and crank):
        own = parts_of(mechanism).flat.outlines
    theirs = wheel[0] if wheel else (own.wheel,)
    ours, roller = _with_rollers(crank[0] if crank else own.crank, mechanism, place)
    rounded = sum(drawn[1] for drawn in (wheel, crank) if drawn)
    slack = spec.outline.slack_mm or min(max(rounded, EXACT_MM), MOST_MM)
    L, both = place.L, (Polyarc(theirs), Polyarc(ours))
    far, (inner, rim) = float(levels(both[1])[1].max()), levels(both[0])
    near, most = float(inner.min()), float(rim.max())
    if both[0].signed(np.zeros((1, 2)))[0] < 0.0:  # the wheel's material lies about its axis
        near = 0.0
    if L - far > most or L + far < near:
        raise GenevaError(
            f"no part reaches the other. The crank reaches {far:.6g} mm from its axis, the wheel "
            f"lies {near:.6g} to {most:.6g} mm from its own. The axes are {L:.6g} mm apart: set "
            "center_distance_mm in [size], and check the drawings' units",
            ("outline",),
        )
    if wheel and len(place.kinds) == 1:  # of equal steps
        x, y = total(map(moments, theirs)).centroid
        if math.hypot(x, y) > OFF_AXIS * L:
            raise GenevaError(
                f"the drawn wheel's centre is at {shown((x, y))}, but its axis is the drawing's "
                "origin: move the drawing there",
                ("outline", "wheel"),
            )
    free = FreeRanges(*both, L, place.sign, math.tau / spec.wheel.z, slack)
    first, last = place.motions[0], place.motions[-1]
    dwell_deg = first.entry + place.turn_deg - last.exit
    start, rest = math.radians(first.entry - 0.5 * dwell_deg), -first.engagement.half_step
    return DrawnMachine(place, theirs, ours, roller, free, start, rest, tuple(notes))


def crank_jet(mechanism: Mechanism, input_deg: Array) -> tuple[Jet, Array]:
    """The crank's angle, radians, with its derivatives by the input's, and whole turns.

    The angle is within half a turn of mid-motion; the turns are those of the crank beside it.
    """
    first = mechanism.engagements[0]
    turn_deg = 360.0 * mechanism.spec.turns
    whole = np.round((input_deg - first.mid_deg) / turn_deg)
    x, y = first.path(input_deg - first.mid_deg - turn_deg * whole, 3)
    out = atan2(y, 1.0 - x) if mechanism.spec.wheel.SIGN > 0.0 else atan2(y, x - 1.0)
    return Jet([c + np.zeros(len(input_deg)) for c in out.c]), whole


def _assembly(mechanism: Mechanism) -> Assembly:
    """The positions of the crank; its rollers must go round its axis."""
    wheel = mechanism.spec.wheel
    if not wheel.FLAT:
        raise GenevaError(
            f'gearing = "{wheel.NAME}": an outline is turned in one plane about two axes, as those '
            'of gearing = "external" and "internal" are',
            ("outline",),
        )
    if mechanism.spec.drive.crank is None:
        raise GenevaError(
            "an outline is turned by rollers on a crank, but the rollers of this drive do not go "
            'round the crank\'s axis: use kind = "crank" or another drive with a crank',
            ("outline",),
        )
    return assembly(mechanism)


def _drawn(spec: Spec, part: str, notes: list[Notice]) -> tuple[Contours, float] | None:
    """The outlines of a part's drawing in the frame of our own, mirrored about x and then turned.

    Beside them is how far rounding may overlap them, mm. None without a drawing.
    """
    outline = vars(spec.outline)
    file = outline[part]
    if file is None:
        return None
    path = below(os.path.dirname(spec.path), file)
    drawn = read_drawing(path)
    notes += [Notice("outline-units", f"{cut(file, 100)}: {text}") for text in drawn.notes]
    turn, over = math.radians(outline[f"{part}_turn_deg"]), outline["mirror"] in (part, "both")
    shape = shapes.placed(shapes.Contour("", tuple(drawn.pieces)), turn=turn, mirror=over)
    pieces = [p for p in shape.segments if not isinstance(p, shapes.Cubic)]
    try:
        own = tuple(loops(pieces))
    except GenevaError as error:
        raise GenevaError(f"{cut(path, 300)}: {error}") from None
    if not (drawn.is_exact and any(isinstance(piece, shapes.Arc) for piece in pieces)):
        return own, MOST_MM  # facets
    gap = 2.0 * greatest_gap(pieces)  # of numbers that were rounded
    return own, gap if gap > EXACT_MM else 0.0


def _with_rollers(
    drawn: Sequence[shapes.Contour], mechanism: Mechanism, place: Assembly
) -> tuple[Contours, shapes.Circle]:
    """The crank with its rollers, those that its drawing has or our own; and the first of them."""
    circles = {one: _roller(one) for one in drawn}
    rollers = [circle for circle in circles.values() if circle]
    crank = tuple(one for one in drawn if not circles[one])
    if not rollers:
        for i in range(len(place.rollers)):
            x, y = (place.pin(i, np.zeros(1))[0] - (place.L, 0.0)).tolist()
            centre = (-x, -y) if place.sign > 0.0 else (x, y)
            rollers.append(shapes.Circle("ROLLER", centre, mechanism.roller_radius_mm))
        # a drawn crank may have the rollers in its outline
        if crank and Polyarc(crank).signed(np.array([rollers[0].centre]))[0] < 0.0:
            return crank, rollers[0]
    round_ = []
    for one in rollers:
        # At an entry both walls touch a roller across the crank's arm, where ends of its arcs would
        # count as corners.
        across = math.atan2(one.centre[1], one.centre[0])
        round_.append(shapes.closed("ROLLER", shapes.two_arcs(one, across + 1.0)))
    return (*crank, *round_), rollers[0]


def _roller(contour: shapes.Contour) -> shapes.Circle | None:
    """An outline, not a hole, that is a full circle beside the crank's axis, as one."""
    first, *others = contour.segments
    if not isinstance(first, shapes.Arc) or first.bulge < 0.0:
        return None
    centre, radius = first.centre, first.radius
    is_round = math.hypot(*centre) > radius and all(
        isinstance(p, shapes.Arc)
        and max(abs(p.radius - radius), math.dist(p.centre, centre)) < 1e-6 * radius
        for p in others
    )
    return shapes.Circle("ROLLER", centre, radius) if is_round else None
