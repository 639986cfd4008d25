"""The first of two wheels in series with its crank, as a machine in front of the second one.

The first wheel is fixed on the second's crank shaft, in the plane below the crank arm. Its locking
disc lies in that plane on the first crank, which is a link. All other sizes are those of the
second.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.curves.plates import Member, Plate
from geneva_cli.errors import GenevaError
from geneva_cli.kinematics import registry
from geneva_cli.kinematics.wheels.external import External
from geneva_cli.layout.plain_sizes import drawn_thicknesses, wall_min
from geneva_cli.layout.projection import titled
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.outlines.outlines import Outlines, outlines
from geneva_cli.parts.links import Links, drawn_links
from geneva_cli.parts.plates import locking_plates, wheel_plate
from geneva_cli.spec.tables import Size


def first_pair(mechanism: Mechanism, bars: Links | None = None) -> Mechanism:
    """Return the first wheel and its crank as a machine; ``bars`` are the second's links if known.

    Raises GenevaError for a machine without a first wheel.
    """
    spec, L = mechanism.spec, mechanism.center_distance_mm
    first = spec.drive.first_wheel(L)
    if first is None:
        having = [k for k in registry.DRIVES if registry.drive(k).IN_SERIES]
        raise GenevaError(
            f'--part first-wheel, first-crank: kind = "{spec.drive.NAME}" has one wheel; '
            f"{' or '.join(having)} has two"
        )
    if bars is None:
        bars = drawn_links(mechanism, outlines(mechanism) if spec.is_flat else None)
    second, own = (L, 0.0), (L + first.distance_mm, 0.0)
    bore = 0.0 if bars.one_piece(own, L) else bars.shaft(own, L)
    sizes = spec.size
    size = Size(
        center_distance_mm=first.distance_mm,
        roller_radius_mm=mechanism.roller_radius_mm,
        process=sizes.process,
        slot_clearance_mm=sizes.slot_clearance_mm,
        lock_clearance_mm=sizes.lock_clearance_mm,
        press_fit_mm=sizes.press_fit_mm,
        shaft_fit_mm=sizes.shaft_fit_mm,
        pin_mm=sizes.pin_mm,
        wall_min_mm=wall_min(sizes, L),
        wheel_thickness_mm=bars.sizes.thickness if bars.sizes else drawn_thicknesses(sizes, L).link,
        crank_bore_mm=2.0 * bore,
        wheel_bore_mm=2.0 * bars.shaft(second, L),
        lock_bolts=0,  # the link below its disc has no holes for them
    )
    title = f"{titled(mechanism)}, first pair"
    drive = Crank(n_rpm=spec.drive.n_rpm)
    return build(Spec(External(first.z), drive, size=size, title=title))


def in_front(first: Outlines, bars: Links, L: float) -> Iterator[Member]:
    """Yield the first wheel and its locking disc as plates at input angle 0.

    ``first`` are their outlines, and ``bars`` the links of both wheels. The first wheel's axis is
    at the distance L from the second's.
    """
    assert bars.sizes is not None  # the first crank is a link
    # the first wheel lies two planes below the wheel
    low, high = bars.sizes.span(2)

    def placed(plate: Plate, x: float, turn: float) -> Member:
        own = plate._replace(name=f"first {plate.name}", low=low, high=high)
        return Member(own, (x, 0.0), turn)

    # at mid-motion the first slot of the first wheel's frame points at the first crank
    yield placed(wheel_plate(first, first.wheel), L, 0.0)
    for plate in locking_plates(first):
        yield placed(plate, L + first.assembly.L, math.pi)
