"""The drawing sheet of a spherical machine: its section, wheel and crank laid flat, all angles.

The section is in the plane of both shafts, with a roller at the end of its slot; the sphere's
centre is the origin, the wheel's axis points up. Flat views have their cone's apex as the origin,
where it is near.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.curves.measure import at, mapped
from geneva_cli.curves.plates import Group, plates
from geneva_cli.curves.shapes import Arc, Contour, Line, Point, Segment, Shape
from geneva_cli.curves.sheet import CENTRE, OUTLINE, Sheet
from geneva_cli.machine.layout import Dimension
from geneva_cli.numerics.tolerances import SAME_ANGLE
from geneva_cli.parts.parts_list import part_rows
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.sheet import sized
from geneva_cli.parts.sheet.bores import bored, radius_of
from geneva_cli.parts.sheet.composed import on_paper
from geneva_cli.parts.sheet.paper import table
from geneva_cli.parts.sheet.points import COARSE, MIRRORED, point_table, polyline
from geneva_cli.parts.sheet.standing import draw_hub, draw_shaft
from geneva_cli.parts.sheet.view import Block, View, number, times
from geneva_cli.parts.sphere.arm import CapArm
from geneva_cli.parts.sphere.arm_drawing import arm_cone, arm_flat
from geneva_cli.parts.sphere.built import ROLLER, BuiltBall, built
from geneva_cli.parts.sphere.dimensions import dimensions
from geneva_cli.parts.sphere.drawings import (
    PITCH,
    crank_cone,
    crank_flat,
    slot_flat,
    wheel_cone,
    wheel_flat,
)
from geneva_cli.parts.sphere.laid_flat import Cone
from geneva_cli.parts.sphere.section import degrees, section
from geneva_cli.parts.sphere.sizes import Ball

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

UP = 0.5 * math.pi
SAME = 1e-6  # of a radius
FAR = 4.0  # sphere's radii: an apex farther off is on no sheet
BEYOND = 0.1  # of the sphere's radius: axes, over the shells
FINE = 0.1  # of a table's tolerance: what its curve is fitted to
CROSS = 0.05  # of it: at the apex
HEADING = ("All walls lead to the sphere's centre: angles are seen from there.",)
COLUMNS = (80.0, 24.0, 14.0)  # mm, of the table of angles
DECIMALS = 4  # of an angle in degrees: 0.2 um on 100 mm


def sheet(proof: Proof, tolerance: float, curves: str) -> Sheet:
    """The drawing sheet of a machine. Raises GenevaError where no scale brings it on one."""
    found, locks = proof.shells.ball, proof.shells.crank
    wheel = wheel_flat(found, wheel_cone(found), tolerance, curves)
    crank = crank_flat(found, locks, crank_cone(found), tolerance, curves)
    whole = built(proof.shells)
    arm = arm_flat(found, whole.arm, tolerance, curves) if whole.arm else []
    rows = [
        (d.name, number(d.value, DECIMALS), d.unit)
        for d in dimensions(proof)
        if isinstance(d, Dimension) and isinstance(d.value, (int, float))
    ]
    fixed = [
        table(HEADING, [("dimension", "value", "unit"), *rows], COLUMNS),
        flat_slot(found, tolerance),
    ]

    def blocks(scale: float) -> Iterator[list[Block]]:
        views = [
            section(proof.shells, whole, scale),
            _flat("wheel", found, wheel_cone(found), wheel, scale),
            _flat("crank", found, crank_cone(found), crank, scale),
        ]
        if whole.arm:
            views.append(_arm(proof, found, whole.arm, arm, scale))
        views += _axles(proof, whole, scale)
        yield [*(view.block() for view in views), *fixed]

    items = list(part_rows(proof.mechanism.spec, Group("", whole.members), found.span_mm[1]))
    return on_paper(proof.mechanism.spec, items, 2.0 * found.span_mm[1], blocks)


def _arm(proof: Proof, found: Ball, made: CapArm, flat: list[Contour], scale: float) -> View:
    """The arm laid flat, and what its pins are pressed into."""
    view = _flat("crank", found, arm_cone(found), flat, scale)
    view.title = "arm, laid flat"
    hole, pin = made.pins[0].radius, found.pin_mm
    text = f"{sized.pin_hole(proof.mechanism, hole)} through, to the sphere's centre"
    view.remark(f"pins: {times(len(made.pins), text)}; pin {sized.pin(pin)}")
    view.remark(f"hub: {sized.plain(2.0 * made.hub, 'Ø ')} through, about the crank's axis")
    if made.bolts:
        text = f"{sized.bore(made.bolts[0].radius)} through, to the sphere's centre"
        view.remark(f"locking sectors: {times(len(made.bolts), text)}")
    return view


def _axles(proof: Proof, whole: BuiltBall, scale: float) -> Iterator[View]:
    """Hubs along their axes, with bores and keyways, and the shafts from the side."""
    size = proof.mechanism.spec.size
    for part, standard in ((whole.wheel, size.wheel_keyway), (whole.crank, size.crank_keyway)):
        for hub in plates(part.part):
            if hub.layer == ROLLER:
                continue
            view = View(hub.name, scale)
            for shape in (hub.outline, *hub.holes):
                view.draw(shape, OUTLINE)
            if hub.holes:
                bored(view, hub.holes, radius_of(hub.holes[0]), standard)
            draw_hub(view, hub)
            view.remark(f"{number(hub.thickness)} long")
            yield view
    for shaft in plates(Group("", whole.shafts)):
        view = View(shaft.name, scale)
        draw_shaft(view, shaft)
        yield view


def _flat(whose: str, found: Ball, cone: Cone, shapes: Sequence[Shape], scale: float) -> View:
    """A cone laid flat: its radii from the apex, the depth of a slot, the angles between slots."""
    view = View(f"{whose}, laid flat", scale)
    view.remark(cone.said(whose))
    shift = _shift(found, cone)
    near = shift != 0.0
    moved = [mapped(s, lambda p: (p[0] + shift, p[1])) for s in shapes]
    for shape in moved:
        view.draw(shape, CENTRE if shape.layer == PITCH else OUTLINE)
    contours = [s for s in moved if isinstance(s, Contour)]
    if near:
        view.cross((0.0, 0.0), CROSS * found.radius_mm)
        far = max(math.hypot(*s.start) for c in contours for s in c.segments)
        _sectors(view, [c.segments[0] for c in contours if c.layer == "CRANK"], far)
        radii: dict[str, list[Arc]] = {}
        for arc in (s for c in contours for s in c.segments if isinstance(s, Arc)):
            if math.hypot(*arc.centre) < SAME * arc.radius:
                radii.setdefault(sized.plain(arc.radius, "R "), []).append(arc)
        for text, some in radii.items():
            view.of_arcs(some, text)
    ways = [c.segments[0] for c in contours if c.layer == PITCH and isinstance(c.segments[0], Line)]
    if not ways:
        return view
    first, after = ways[:2]
    view.linear(*first, 0.0, sized.plain(math.dist(*first)), near=True)
    if near:
        legs = sorted(math.atan2(way.start[1], way.start[0]) for way in (first, after))
        text = f"{number(math.degrees(abs(legs[1] - legs[0])), DECIMALS)}°"
        view.angular([(legs[0], legs[1])], far, far, times(found.z - 1, text))
    else:
        view.linear(first.start, after.start, UP, times(found.z - 1, sized.plain(
            abs(after.start[1] - first.start[1]))))  # fmt: skip
    return view


def _shift(found: Ball, cone: Cone) -> float:
    """From a cone's apex to where it touches, mm; 0 where that is too far for a sheet."""
    near = abs(math.cos(cone.polar)) > SAME_ANGLE and abs(cone.apex_mm) < FAR * found.radius_mm
    return cone.apex_mm if near else 0.0


def flat_slot(found: Ball, tolerance: float) -> Block:
    """A table of half of a slot, laid flat: its edge from amid two slots to its end."""
    cone, close = wheel_cone(found), max(tolerance, COARSE * found.radius_mm)
    shift = _shift(found, cone)
    points: list[Point] = []
    for piece in slot_flat(found, cone, FINE * close, "arcs").segments:

        def curve(t: Array, piece: Segment = piece) -> Array:
            return np.array([at(piece, float(share)) for share in t])

        for x, y in polyline(curve, 0.0, 1.0, close, begin=1):
            if y < -SAME * found.radius_mm and (not points or math.dist(points[-1], (x, y)) > SAME):
                points.append((float(x), float(y)))
    points.append(cone.point(found.bottom - found.half_width, 0.0))
    shown = np.array(points) + np.array([shift, 0.0])
    origin = "the cone's apex" if shift else "where the cone touches"
    title = f"slot 1 laid flat: points of its edge from {origin}{MIRRORED}"
    return point_table(title, shown, close)


def _sectors(view: View, locking: list[Segment], far: float) -> None:
    """How wide the locking sectors are, and how far the first is from the first roller."""
    arcs = [arc for arc in locking if isinstance(arc, Arc)]
    wide: dict[str, list[tuple[float, float]]] = {}
    for arc in arcs:
        start = math.atan2(arc.start[1], arc.start[0])
        wide.setdefault(degrees(arc.sweep), []).append((start, start + arc.sweep))
    for text, pairs in wide.items():
        view.angular(pairs, arcs[0].radius, far, times(len(pairs), text))
    for start in sorted(pair[0] % math.tau for pairs in wide.values() for pair in pairs)[:1]:
        view.angular([(0.0, start)], far, far, f"roller to sector {degrees(start)}")
