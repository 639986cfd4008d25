"""The first of two wheels in series with its crank, as a machine in front of the second one.

It is fixed on the second's crank shaft, whose greatest torque it bears, in the plane below the
crank arm. Its crank is a link.
"""

import math

from geneva_cli.drives.crank import Crank
from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.loads.strength.part_loads import single_loads
from geneva_cli.motion import registry
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.wheels.external import External
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.projection import titled
from geneva_cli.parts.shafts.bores import has_shape, round_bore
from geneva_cli.parts.sizes import CLEARANCES
from geneva_cli.spec.defaults import wall_min
from geneva_cli.spec.tables import Load, Size

THICK = "wheel_thickness_mm", "arm_thickness_mm"  # as thick as the links


def first_spec(mechanism: Mechanism) -> Spec:
    """Return the spec of the first wheel and its crank, with the sizes that it shares."""
    spec, size = mechanism.spec, mechanism.spec.size
    assert mechanism.first_wheel is not None
    slots, distance_mm = mechanism.first_wheel
    shared = {key: vars(size)[key] for key in ("process", "pin_mm", *CLEARANCES)}
    shared |= dict.fromkeys(THICK, size.link_thickness_mm)
    # the link below its disc has no holes for bolts
    shared |= {"arm_bore_mm": size.link_bore_mm, "lock_bolts": 0}
    own = Size(distance_mm, mechanism.roller_radius_mm, **shared)
    torque = single_loads(mechanism).crank_Nm if spec.is_loaded else 0.0
    return Spec(
        External(slots),
        Crank(n_rpm=spec.drive.n_rpm),
        size=own,
        load=Load(torque_Nm=torque if math.isfinite(torque) else 0.0),
        shaft=spec.shaft.replace(wheel_diameter_mm=None, crank_diameter_mm=None),
        material_wheel=spec.material_wheel,
        material_roller=spec.material_roller,
    )


def first_pair(mechanism: Mechanism, outlines: Outlines | None) -> Mechanism:
    """Return the first wheel and its crank as a machine, for the second pair's ``outlines``."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    first = mechanism.first_wheel
    if first is None:
        having = registry.drives_with("first_wheel")
        text = f'--part first-wheel, first-crank: kind = "{spec.drive.NAME}" has one wheel; '
        raise GenevaError(f"{text}{' or '.join(having)} has two")
    key = "crank_bore" if spec.size.crank_keyway is None else "crank_keyway"
    text = f"{key}: the first wheel on the crank's shaft has a round bore; remove {key}"
    refuse_size(has_shape(spec.size, "crank"), key, text)
    bars = drawn_links(mechanism, outlines)
    second, own = (L, 0.0), (L + first[1], 0.0)
    bore = 0.0 if bars.one_piece(own, L) else bars.shaft(own, L)
    alone = first_spec(mechanism)
    link, shaft = bars.sizes, bars.shaft(own, L)
    radii = {"crank_bore": bore, "wheel_bore": bars.shaft(second, L), "arm_bore": shaft}
    radii |= {"arm_hub": link.hub(round_bore(spec.size, shaft)), "arm_eye": link.roller_eye}
    known = {f"{name}_mm": 2.0 * r for name, r in {**radii, "pin": link.roller_stands}.items()}
    known |= {"wall_min_mm": wall_min(spec.size, L), **dict.fromkeys(THICK, link.thickness)}
    size = alone.size.replace(**known)
    return build(alone.replace(size=size, title=f"{titled(mechanism)}, first pair"))
