"""The first of two wheels in series with its crank, as a machine in front of the second one.

It is fixed on the second's crank shaft, in the plane below the crank arm, and its crank is a link.
"""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.motion import registry
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.parts.first_wheel import first_spec
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.projection import titled
from geneva_cli.parts.shafts.bores import has_shape, round_bore
from geneva_cli.spec.defaults import wall_min


def first_pair(mechanism: Mechanism, outlines: Outlines | None) -> Mechanism:
    """Return the first wheel and its crank as a machine, for the second pair's ``outlines``."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    first = mechanism.first_wheel
    if first is None:
        having = registry.drives_with("first_wheel")
        raise GenevaError(
            f'--part first-wheel, first-crank: kind = "{spec.drive.NAME}" has one wheel; '
            f"{' or '.join(having)} has two"
        )
    if has_shape(spec.size, "crank"):
        key = "crank_bore" if spec.size.crank_keyway is None else "crank_keyway"
        raise GenevaError(
            f"{key}: the first wheel on the crank's shaft has a round bore; remove {key}",
            ("size", key),
        )
    bars = drawn_links(mechanism, outlines)
    second, own = (L, 0.0), (L + first[1], 0.0)
    bore = 0.0 if bars.one_piece(own, L) else bars.shaft(own, L)
    alone = first_spec(mechanism, first)
    size = alone.size.replace(
        wall_min_mm=wall_min(spec.size, L),
        crank_bore_mm=2.0 * bore,
        wheel_bore_mm=2.0 * bars.shaft(second, L),
    )
    if bars.sizes:
        link, shaft = bars.sizes, bars.shaft(own, L)
        size = size.replace(
            wheel_thickness_mm=link.thickness,
            arm_thickness_mm=link.thickness,
            pin_mm=2.0 * link.roller_stands,
            arm_bore_mm=2.0 * shaft,
            arm_hub_mm=2.0 * link.hub(round_bore(spec.size, shaft)),
            arm_eye_mm=2.0 * link.roller_eye,
        )
    return build(alone.replace(size=size, title=f"{titled(mechanism)}, first pair"))
