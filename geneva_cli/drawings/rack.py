"""Drawings of the rack and the crank of a linear Geneva."""

from __future__ import annotations

import math

from geneva_cli.curves.drawing import Annotations, Drawing, LevelDistance
from geneva_cli.curves.plates import Group, Member, Plate
from geneva_cli.curves.shapes import Contour, Line, closed
from geneva_cli.layout.plain_sizes import drawn_thicknesses, pin_radius
from geneva_cli.layout.projection import outlines_of, placed, titled
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.outlines.rack import rack_contour, rack_sizes, slot_walls
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.rack_arm import rack_arm, rack_crank


def wheel(parts: FlatParts) -> Drawing:
    """Return the rack; a slot is along x, with its roller at the origin at mid-motion."""
    mechanism = parts.mechanism
    solid = _rack(mechanism)
    return Drawing(titled(mechanism, "rack"), outlines_of(solid), solid=solid)


def crank(parts: FlatParts) -> Drawing:
    """Return locking sector and roller, without the arm; x is from the axis to the roller."""
    mechanism = parts.mechanism
    solid = Group("crank", rack_crank(mechanism))
    return Drawing(titled(mechanism, "crank"), outlines_of(solid), solid=solid)


def arm(parts: FlatParts) -> Drawing:
    """Return the arm, whose x is from the crank's axis to the roller."""
    mechanism = parts.mechanism
    solid = rack_arm(mechanism)
    return Drawing(titled(mechanism, "arm"), outlines_of(solid), solid=solid)


def slot(parts: FlatParts) -> Drawing:
    """Return a slot, closed along the rack's edge, and the roller's path in it."""
    mechanism = parts.mechanism
    sizes = rack_sizes(mechanism)
    walls = slot_walls(sizes, 0.0)
    outline = closed("WHEEL", [*walls, Line(walls[-1].end, walls[0].start)])
    path = Contour("PITCH", (Line((0.0, 0.0), (sizes.arm, 0.0)),), closed=False)
    return Drawing(titled(mechanism, "slot"), (outline, path))


def assembly(parts: FlatParts) -> Drawing:
    """Return rack and crank at input angle 0: the roller is at the origin, the axis at (R, 0)."""
    mechanism = parts.mechanism
    axis = rack_sizes(mechanism).arm, 0.0
    has_pin = pin_radius(mechanism.spec.size, mechanism.roller_radius_mm) > 0.0
    arms = (Member(rack_arm(mechanism)),) if has_pin else ()
    crank = Group("crank", (*arms, *rack_crank(mechanism)))
    # the roller is on the rack's side
    members = Member(crank, axis, math.pi), Member(_rack(mechanism))
    shapes = [placed(s, one.at, one.turn) for one in members for s in outlines_of(one.part)]
    title = titled(mechanism)
    look = Annotations((LevelDistance((0.0, 0.0), axis, "R"),))
    return Drawing(title, tuple(shapes), look, Group(title, members))


def _rack(mechanism: Mechanism) -> Plate:
    high = drawn_thicknesses(mechanism.spec.size, mechanism.center_distance_mm).wheel
    outline = rack_contour(rack_sizes(mechanism), mechanism.spec.wheel.z)
    return Plate("rack", "WHEEL", outline, (), 0.0, high)
