"""Parts for a milling cutter: places that it does not reach, and dog bones in the corners.

Dog bones lie in keyways and in the reliefs of the locking disc. They are never in the walls on
which the rollers run, nor on the locking arcs.
"""

from __future__ import annotations

import math
from contextlib import suppress

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.cutter import TooWide, faults, freed
from geneva_cli.geometry.plates import Group, Part, Plate, plates
from geneva_cli.geometry.shapes import Arc, Contour, Layer, Line, Shape
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.preferred import rounded_radius
from geneva_cli.numerics.roots import boundary
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.parts import Parts
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.spec.rules import TOOL_MM, require_mm


def judged(drawing: Drawing, cutter_mm: float) -> tuple[str, list[str]]:
    """Return places that a cutter does not reach, "" if none, and notes on what else it leaves.

    Raises GenevaError for a diameter outside of TOOL_MM, and for outlines with cubics.
    """
    require_mm("--cutter", cutter_mm, TOOL_MM)
    cut = dict.fromkeys(plates(drawing.solid)) if drawing.solid else {}
    all_faults = [fault for plate in cut for fault in faults(plate, 0.5 * cutter_mm)]
    stops = [fault.text for fault in all_faults if fault.stops]
    refused = f"--cutter {cutter_mm:g}: {'; '.join(stops)}" if stops else ""
    return refused, [f"--cutter {cutter_mm:g}: {f.text}" for f in all_faults if not f.stops]


def with_dog_bones(drawing: Drawing, parts: Parts, cutter_mm: float) -> Drawing:
    """Return a drawing with dog bones for a cutter of a diameter in its inner corners.

    Raises GenevaError where one does not fit.
    """
    mechanism, solid = parts.mechanism, drawing.solid
    if solid is None:
        return drawing
    wall = wall_min(mechanism.spec.size, mechanism.center_distance_mm)
    lock = parts.outlines.sizes.lock if mechanism.spec.is_flat else 0.0

    def works(piece: Line | Arc, layer: Layer) -> bool:
        return layer == "WHEEL" or (layer == "CRANK" and _locks(piece, lock, mechanism))

    def boned_by(diameter: float) -> dict[Shape, Contour]:
        each = (freed(p, 0.5 * diameter, wall, works) for p in dict.fromkeys(plates(solid)))
        return {shape: contour for one in each for shape, contour in one.items()}

    def fits(diameter: float) -> bool:
        with suppress(GenevaError):
            return bool(boned_by(diameter))
        return False

    try:
        boned = boned_by(cutter_mm)
    except TooWide as error:
        # 14 halvings between a cutter whose dog bones fit and one whose do not
        most = 2.0 * rounded_radius(0.5 * boundary(fits, 0.0, cutter_mm, 14))
        helps = f"use a cutter up to {most:g} mm" if most else "no cutter is small enough"
        raise GenevaError(f"--dog-bones: {error}; {helps}, or omit it") from None
    shapes = tuple(boned.get(shape, shape) for shape in drawing.shapes)
    if drawing.shells:  # laid flat, they have no dog bones
        return drawing._replace(shapes=shapes, solid=None, shells=None)
    return drawing._replace(shapes=shapes, solid=_replaced(solid, boned))


def _locks(piece: Line | Arc, lock: float, mechanism: Mechanism) -> bool:
    near = SAME_LENGTH * mechanism.center_distance_mm
    return (
        isinstance(piece, Arc)
        and abs(piece.radius - lock) < near
        and math.hypot(*piece.centre) < near
    )


def _replaced(part: Part, by: dict[Shape, Contour]) -> Part:
    if isinstance(part, Plate):
        return part._replace(
            outline=by.get(part.outline, part.outline),
            holes=tuple(by.get(hole, hole) for hole in part.holes),
        )
    if not isinstance(part, Group):
        return part
    members = (one._replace(part=_replaced(one.part, by)) for one in part.members)
    return Group(part.name, tuple(members))
