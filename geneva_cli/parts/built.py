"""All parts of a flat machine as they are built, at input angle 0.

The wheel's axis is the origin, and the crank's is on the x axis.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from geneva_cli.curves.plates import Member
from geneva_cli.curves.shapes import Contour
from geneva_cli.machine.layout import Joint
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.arm import CrankArm, crank_arm, has_arm
from geneva_cli.parts.first_pair import first_members
from geneva_cli.parts.frame import framed, groove_plates
from geneva_cli.parts.gear_drawings import gear_members
from geneva_cli.parts.groove_plate import TOLERANCE
from geneva_cli.parts.link_positions import links_at
from geneva_cli.parts.link_sizes import places
from geneva_cli.parts.links import Links, drawn_links
from geneva_cli.parts.model import PartsModel
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.placed import PlacedParts
from geneva_cli.parts.plates import crank_group, roller_plates, wheel_part
from geneva_cli.parts.sizes import pin_radius, thicknesses


def link_gears(bars: Links) -> list[Member]:
    """Return the gears among links, as blanks."""
    return [gear.member for gear in bars.gears]


def link_members(model: PartsModel) -> tuple[Member, ...]:
    """Return links and gears with shafts and frame, for a machine whose wheel is not drawn."""
    mechanism = model.mechanism
    bars = drawn_links(mechanism)
    carried = _carried(mechanism, bars)
    members = (*bars.cut, *bars.joined, *carried, *link_gears(bars), *gear_members(model))
    if not mechanism.spec.wheel.FLAT:
        return members
    frame = framed(model, [], bars)
    return (*members, *frame.shafts, Member(frame.plate))


def _carried(mechanism: Mechanism, bars: Links) -> Iterator[Member]:
    """Yield the rollers on links, with their pins."""
    size, L, r = mechanism.spec.size, mechanism.center_distance_mm, mechanism.roller_radius_mm
    if bars.pin_low is None:
        return
    plates = roller_plates(r, pin_radius(size, r), bars.pin_low, thicknesses(size, L).wheel)
    for link in links_at(mechanism, np.zeros(1)):
        for joint, kind in zip(places(link), link.kinds, strict=True):
            if link.plane == 1 and kind in (Joint.ROLLER, Joint.CARRIED):
                at = float(joint[0].real), float(joint[0].imag)
                yield from (Member(plate, at) for plate in plates)


def built(
    parts: Outlines,
    contour: Contour | None = None,
    tolerance: float = TOLERANCE,
    curves: str = "arcs",
    pitch: bool = True,
    fitted: bool = True,
) -> PlacedParts[CrankArm]:
    """Return all parts of a flat machine; ``contour`` is the wheel's, if drawn finer or coarser.

    Without ``pitch`` noncircular gears are omitted, without ``fitted`` a cam's groove plates too:
    their curves take long to fit. Raises GenevaError, naming the key, for sizes that leave no arm,
    links, shafts or groove plate.
    """
    assembly = parts.assembly
    mechanism, at = assembly.full, np.zeros(1)
    bars = drawn_links(mechanism, parts)
    arm = crank_arm(parts) if has_arm(parts) else None
    model = PartsModel(mechanism, parts)
    fixed = groove_plates(parts, bars, tolerance, curves, fitted)
    first = tuple(first_members(mechanism, bars))
    frame = framed(model, fixed, bars, first)
    return PlacedParts(
        Member(wheel_part(parts, contour or parts.wheel), turn=float(assembly.wheel(at)[0])),
        Member(
            crank_group(parts, arm, bars.pin_low),
            (assembly.L, 0.0),
            float(assembly.crank(at)[0]),
        ),
        arm,
        frame.shafts,
        bars,
        (*([] if first else link_gears(bars)), *(gear_members(model) if pitch and fitted else ())),
        first,
        (*fixed, Member(frame.plate)),
    )
