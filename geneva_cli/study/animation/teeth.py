"""Gears with their teeth in a scene: on shafts that stand, and on a link that moves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Member, Plate, placed
from geneva_cli.geometry.shapes import Shape
from geneva_cli.motion.pivots import Link
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.output.scene import Body, Track
from geneva_cli.parts.links.link_positions import links_at, same
from geneva_cli.parts.links.link_sizes import places
from geneva_cli.study.animation.animated_turn import MachineTurn
from geneva_cli.study.animation.tracks import still


class DrawnTeeth(NamedTuple):
    """Toothed outlines with bores, about each gear's axis at input angle 0, as far as there are."""

    pair: tuple[tuple[Shape, ...], ...]  # driven gear and driver of noncircular ones
    round: dict[str, tuple[Shape, ...]]
    why: str = ""  # reason why teeth of the spec are not drawn


def drawn_teeth(design: Design) -> DrawnTeeth:
    """The teeth of a design's gears; none without a module."""
    if design.spec.size.gear_module_mm is None:
        return DrawnTeeth((), {})
    try:
        # a hundredth of a millimetre is less than a screen shows
        *_, (_, built) = design.parts.all_built
        parts = built().within(0.01, "arcs")
        pair = tuple(map(_shapes, parts.gear_pair))
        return DrawnTeeth(pair, {one.name: _shapes(one.member) for one in parts.toothed if one.cut})
    except GenevaError as error:
        return DrawnTeeth((), {}, str(error))


def _shapes(gear: Member) -> tuple[Shape, ...]:
    assert isinstance(gear.part, Plate)
    return (gear.part.outline, *gear.part.holes)


def round_gears(turn: MachineTurn, teeth: DrawnTeeth) -> Iterator[Body]:
    """Round gears with teeth on shafts that stand."""
    for link in links_at(turn.mechanism, np.zeros(1)):
        angle = _angle(turn, link)
        if link.name in teeth.round and angle:
            (x, y) = (float(c[0]) for c in link.joints[0])
            yield Body(link.name, teeth.round[link.name], (x, y), angle)


def _angle(turn: MachineTurn, link: Link) -> Track | None:
    """The angle of a gear from its place at input angle 0; None on an axis that moves."""
    at = (float(link.joints[0][0][0]), float(link.joints[0][1][0]))
    if link.teeth.fixed:
        return still()
    if same(at, turn.mechanism.crank_shaft.at, turn.L):
        return turn.crank_from_mid()
    if same(at, (0.0, 0.0), turn.L):
        return turn.wheel(turn.mechanism.wheel_places[0])
    return None


def carried_gear(turn: MachineTurn, teeth: DrawnTeeth, link: Link) -> tuple[Shape, ...]:
    """The gear with teeth that turns with a link about its first joint; empty without one.

    Its shapes are in the link's frame, whose x is towards the second joint.
    """
    joints = [complex(*(float(c[0]) for c in joint)) for joint in link.joints]
    for other in links_at(turn.mechanism, np.zeros(1)):
        here = abs(complex(places(other)[0][0]) - joints[0]) < SAME_LENGTH * turn.L
        if other.name in teeth.round and here and len(joints) > 1 and not _angle(turn, other):
            ahead = joints[1] - joints[0]
            back = -math.atan2(ahead.imag, ahead.real)
            return tuple(placed(shape, (0.0, 0.0), back) for shape in teeth.round[other.name])
    return ()
