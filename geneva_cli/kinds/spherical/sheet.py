"""The drawing sheet of a spherical machine: section, flat wheel and crank, and all angles.

Flat views have the apex of their cone as the origin, if it is near.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from geneva_cli.drawings.parts_list import part_rows
from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.composed import on_paper
from geneva_cli.drawings.sheet.machine_sheet import shafted
from geneva_cli.drawings.sheet.paper import table
from geneva_cli.drawings.sheet.points import COARSE, MIRRORED, point_table, polyline
from geneva_cli.drawings.sheet.standing import bored, draw_hub
from geneva_cli.drawings.sheet.view import Block, View, grouped, times
from geneva_cli.geometry.measure import at, mapped
from geneva_cli.geometry.plates import plates
from geneva_cli.geometry.shapes import Arc, Contour, Line, Point, Segment, Shape
from geneva_cli.geometry.sheet import CENTRE, OUTLINE, Sheet
from geneva_cli.kinds.spherical.arm import CapArm
from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.kinds.spherical.dimensions import dimensions
from geneva_cli.kinds.spherical.drawings import (
    Cone,
    arm_cone,
    arm_flat,
    crank_cone,
    crank_flat,
    slot_flat,
    wheel_cone,
    wheel_flat,
)
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.kinds.spherical.section import section
from geneva_cli.motion.pivots import Dimension
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_ANGLE, SAME_ON_SHEET
from geneva_cli.parts.shafts.fits import Fits
from geneva_cli.spec.written import degrees, length, quantity


def sheet(parts: SphereParts) -> Sheet:
    """Return the drawing sheet of a machine. Raises GenevaError where no scale fits on one."""
    ball = parts.ball
    wheel, crank = wheel_flat(parts), crank_flat(parts)
    arm = arm_flat(parts, parts.arm) if parts.arm else []
    # 4 decimals of a degree are 0.2 um on 100 mm
    rows = [
        (d.name, *quantity(d.value, d.unit, 4))
        for d in dimensions(parts)
        if isinstance(d, Dimension) and isinstance(d.value, (int, float))
    ]
    heading = ("All walls lead to the sphere's centre: angles are seen from there.",)
    wide = 80.0, 24.0, 14.0  # mm, of the table's columns
    fixed = [
        table(heading, [("dimension", "value", "unit"), *rows], wide),
        flat_slot(ball, parts.tolerance or 0.0),
    ]

    def blocks(scale: float) -> tuple[list[Block], Callable[[], list[list[Block]]]]:
        views = [
            section(parts, scale, {str(row["name"]): i for i, row in enumerate(items, 1)}),
            _flat("wheel", ball, wheel_cone(ball), wheel, scale),
            _flat("crank", ball, crank_cone(ball), crank, scale),
        ]
        if parts.arm:
            views.append(_arm(parts, parts.arm, arm, scale))
        views += _axles(parts, scale)
        return [*(view.block() for view in views), *fixed], lambda: [[]]

    spec = parts.mechanism.spec
    items = list(part_rows(spec, (one.part for one in parts.members), ball.span_mm[1]))
    return on_paper(spec, items, 2.0 * ball.span_mm[1], blocks)


def _arm(parts: SphereParts, arm: CapArm, flat: list[Contour], scale: float) -> View:
    """Return the view of the arm laid flat, with notes on pins, hub and bolts."""
    ball = parts.ball
    view = _flat("crank", ball, arm_cone(ball), flat, scale)
    view.title = "arm, laid flat"
    view.fits = Fits(parts.mechanism.spec.size.process)
    hole, pin = arm.pins[0].radius, ball.pin_mm
    text = sized.made(view.fits, parts.mechanism, "pin hole", hole)
    text += " through, to the sphere's centre"
    view.remark(f"pins: {times(len(arm.pins), text)}; pin {sized.shaft(view.fits, pin)}")
    view.remark(f"hub: {sized.plain(2.0 * arm.hub, 'Ø ')} through, about the crank's axis")
    if arm.bolts:
        text = f"{sized.screw_hole(arm.bolts[0].radius)} through, to the sphere's centre"
        view.remark(f"locking sectors: {times(len(arm.bolts), text)}")
    return view


def _axles(parts: SphereParts, scale: float) -> Iterator[View]:
    """Yield views of hubs along their axes, with bores and keyways, and of shafts' sides."""
    size = parts.mechanism.spec.size

    def begin(name: str, thick: bool) -> View:
        return View(name, scale, Fits(size.process))

    for part, whose in ((parts.wheel, "wheel"), (parts.crank, "crank")):
        for hub in (plate for plate in plates(part.part) if plate.layer != "ROLLER"):
            view = begin(hub.name, True)
            view.draw_plate(hub)
            bored(view, hub.holes, size, whose)
            view.to_fix(hub.name, parts.to_fix)
            draw_hub(view, hub)
            view.remark(f"{length(hub.thickness)} long")
            yield view
    yield from shafted(begin, parts.shafts)


def _flat(whose: str, ball: Ball, cone: Cone, shapes: Sequence[Shape], scale: float) -> View:
    """Return a cone laid flat: radii from the apex, depth of a slot, angles between slots."""
    view = View(f"{whose}, laid flat", scale)
    view.remark(cone.described(whose))
    shift = _shift(ball, cone)
    moved = [mapped(s, lambda p: (p[0] + shift, p[1])) for s in shapes]
    for shape in moved:
        view.draw(shape, CENTRE if shape.layer == "PITCH" else OUTLINE)
    contours = [s for s in moved if isinstance(s, Contour)]
    if shift:
        view.cross((0.0, 0.0), 0.05 * ball.radius_mm)
        far = max(math.hypot(*s.start) for c in contours for s in c.segments)
        _sectors(view, [c.segments[0] for c in contours if c.layer == "CRANK"], far)
        radii: dict[str, list[Arc]] = {}
        for arc in (s for c in contours for s in c.segments if isinstance(s, Arc)):
            if math.hypot(*arc.centre) < SAME_ON_SHEET * arc.radius:
                radii.setdefault(sized.plain(arc.radius, "R "), []).append(arc)
        for text, some in radii.items():
            view.of_arcs(some, text)
    axes = [
        c.segments[0] for c in contours if c.layer == "PITCH" and isinstance(c.segments[0], Line)
    ]
    if not axes:
        return view
    first, after = axes[:2]
    view.linear(*first, 0.0, sized.plain(math.dist(*first)), near=True)
    if shift:
        low, high = sorted(math.atan2(line.start[1], line.start[0]) for line in (first, after))
        view.angular([(low, high)], far, far, times(ball.z - 1, degrees(high - low, 4)))
    else:
        text = times(ball.z - 1, sized.plain(abs(after.start[1] - first.start[1])))
        view.linear(first.start, after.start, 0.5 * math.pi, text)
    return view


def _shift(ball: Ball, cone: Cone) -> float:
    """Return the distance from a cone's apex to its contact, mm; 0 if too far for a sheet."""
    near = abs(math.cos(cone.polar)) > SAME_ANGLE and abs(cone.apex_mm) < 4.0 * ball.radius_mm
    return cone.apex_mm if near else 0.0


def flat_slot(ball: Ball, tolerance: float) -> Block:
    """Return a table of half of a flat slot: its edge from between two slots to its end."""
    close = max(tolerance, COARSE * ball.radius_mm)
    cone = wheel_cone(ball)._replace(tolerance_mm=0.1 * close)
    shift = _shift(ball, cone)
    points: list[Point] = []
    # the fitted curve is ten times as accurate as the table that samples it
    for piece in slot_flat(ball, cone).segments:

        def curve(t: Array, piece: Segment = piece) -> Array:
            return np.array([at(piece, float(fraction)) for fraction in t])

        for x, y in polyline(curve, 0.0, 1.0, close, begin=1):
            apart = not points or math.dist(points[-1], (x, y)) > SAME_ON_SHEET
            if y < -SAME_ON_SHEET * ball.radius_mm and apart:
                points.append((float(x), float(y)))
    points.append(cone.point(ball.bottom - ball.half_width, 0.0))
    shown = np.array(points) + np.array([shift, 0.0])
    origin = "the cone's apex" if shift else "where the cone touches"
    title = f"slot 1 laid flat: points of its edge from {origin}{MIRRORED}"
    return point_table(title, shown, close)


def _sectors(view: View, locking: list[Segment], far: float) -> None:
    """Draw the angles of the locking sectors, and from the first roller to the first."""
    arcs = [arc for arc in locking if isinstance(arc, Arc)]
    starts = [math.atan2(arc.start[1], arc.start[0]) for arc in arcs]
    wide = ((arc.sweep, (a, a + arc.sweep)) for arc, a in zip(arcs, starts, strict=True))
    for text, pairs in grouped((degrees(sweep, 4), ends) for sweep, ends in wide):
        view.angular(pairs, arcs[0].radius, far, text)
    for start in sorted(a % math.tau for a in starts)[:1]:
        view.angular([(0.0, start)], far, far, f"roller to sector {degrees(start, 4)}")
