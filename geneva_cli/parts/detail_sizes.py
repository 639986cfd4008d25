"""The sizes of details by keys of the spec: arm, bolts, relief, hub, flats, links and gears.

They follow from the sizes of wheel and crank: a load changes them only through those.
"""

from __future__ import annotations

from contextlib import suppress

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import thing
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.crank_outline import reliefs, sectors
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.parts.outlines.outlines import Outlines, dial_circle, wheel_hub_length
from geneva_cli.parts.shafts.arm_and_shafts import bolts, crank_arm, crank_hub
from geneva_cli.parts.shafts.bores import bore_of

Values = dict[str, float | str]


def detail_sizes(mechanism: Mechanism) -> Values:
    """Return the sizes of a machine's details by keys of ``[size]``: mm, diameters, or counts.

    None where its parts cannot be drawn, which the checks report.
    """
    own_details = thing(mechanism.spec.wheel.NAME, "details")
    out: Values = {}
    with suppress(GenevaError):
        if own_details:
            return {**own_details(mechanism)}
        if mechanism.spec.is_flat:
            parts = drawn(*machine_sizes(mechanism))
            for own in (_arm_and_lock, _hubs_and_bores, _links):
                out |= own(parts)
    return out


def _arm_and_lock(parts: Outlines) -> Values:
    out: Values = {"relief": parts.relief} if parts.crank else {}
    if parts.has_arm:
        arm, screws = crank_arm(parts), bolts(parts)
        out |= {"arm_hub_mm": 2.0 * arm.hub, "arm_eye_mm": 2.0 * arm.eye}
        if parts.crank:
            each = len(sectors(reliefs(parts.assembly))) if screws else 1
            out["lock_bolts"] = len(screws) // each
        if screws:
            out["lock_bolt_mm"] = 2.0 * screws[0].radius
    return out


def _hubs_and_bores(parts: Outlines) -> Values:
    """Return the lengths of hubs, the bolts of the dial, and the depths of the flats of D bores."""
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    out: Values = {}
    if size.has_hub("wheel") and sizes.wheel_hub > sizes.wheel_bore:
        out["wheel_hub_length_mm"] = wheel_hub_length(size, sizes)
    if size.dial_bolts:
        dial = dial_circle(parts.assembly, sizes)
        out |= {"dial_bolt_mm": 2.0 * dial.hole, "dial_bolt_circle_mm": 2.0 * dial.radius}
    if hub := crank_hub(parts):
        out["crank_hub_length_mm"] = hub.high + size.allowances.pin_gap_mm
    radii = {"wheel": sizes.wheel_bore, "crank": sizes.arm_bore or sizes.crank_bore}
    for part, radius in radii.items():
        if radius and (flat := bore_of(size, part, radius).flat):
            out[f"{part}_flat_mm"] = flat
    return out


def _links(parts: Outlines) -> Values:
    """Return pins and width of links, and the screws of gears that stand still."""
    links, out = drawn_links(parts.assembly.full, parts), Values()
    for gear in links.gears:
        if gear.screws and gear.screws.holes:
            out["gear_bolt_mm"] = 2.0 * gear.screws.hole
            out["gear_bolt_circle_mm"] = 2.0 * gear.screws.radius
    if links.sizes and any(links.plates):
        out |= {"link_pin_mm": 2.0 * links.sizes.pin, "link_width_mm": 2.0 * links.sizes.eye}
    return out
