"""The sizes of details by keys of the spec: arm, bolts, relief, hub, flats, links and gears.

They follow from the sizes of wheel and crank: a load changes them only through those.
"""

from __future__ import annotations

from contextlib import suppress

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import thing
from geneva_cli.parts.arm import bolts, crank_arm
from geneva_cli.parts.links.links import Links, drawn_links
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.crank_outline import reliefs, sectors
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.outlines.wheel_circles import dial_circle, wheel_hub_length
from geneva_cli.parts.shafts.bores import bore_of
from geneva_cli.parts.shafts.hub_and_shafts import crank_hub

Values = dict[str, float | str]


def detail_sizes(mechanism: Mechanism) -> Values:
    """Return the sizes of a machine's details by keys of ``[size]``: mm, diameters, or counts.

    Only details that the machine has are among them; none where its parts cannot be drawn, which
    the checks report.
    """
    out: Values = {}
    own_details = thing(mechanism.spec.wheel.NAME, "details")
    with suppress(GenevaError):
        if own_details:
            return {**own_details(mechanism)}
        if not mechanism.spec.is_flat:
            return out
        parts = drawn(*machine_sizes(mechanism))
        for own in (_arm, _wheel, _crank_hub, _flats, _links):
            out |= own(parts)
    return out


def _arm(parts: Outlines) -> Values:
    """Return the sizes of the crank arm, and of the locking disc on it."""
    relief: Values = {"relief": parts.relief} if parts.crank else {}
    if not parts.has_arm:
        return relief
    arm, screws = crank_arm(parts), bolts(parts)
    each = len(sectors(reliefs(parts.assembly))) if screws else 1
    bolted: Values = {"lock_bolts": len(screws) // each} if parts.crank else {}
    wide: Values = {"lock_bolt_mm": 2.0 * screws[0].radius} if screws else {}
    return {"arm_hub_mm": 2.0 * arm.hub, "arm_eye_mm": 2.0 * arm.eye, **relief, **bolted, **wide}


def _wheel(parts: Outlines) -> Values:
    """Return the length of the wheel's hub, and the bolts between it and the dial."""
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    out: Values = {}
    if size.has_hub("wheel") and sizes.wheel_hub > sizes.wheel_bore:
        out["wheel_hub_length_mm"] = wheel_hub_length(size, sizes)
    if size.dial_bolts:
        dial = dial_circle(parts.assembly, sizes)
        out |= {"dial_bolt_mm": 2.0 * dial.hole, "dial_bolt_circle_mm": 2.0 * dial.radius}
    return out


def _crank_hub(parts: Outlines) -> Values:
    """Return the length of the crank's hub, from the arm up."""
    hub, gap = crank_hub(parts), parts.assembly.mechanism.spec.size.allowances.pin_gap_mm
    return {"crank_hub_length_mm": hub.high + gap} if hub else {}


def _flats(parts: Outlines) -> Values:
    """Return the depths of the flats of D bores."""
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    radii = {"wheel": sizes.wheel_bore, "crank": sizes.arm_bore or sizes.crank_bore}
    flats = {part: bore_of(size, part, radius).flat for part, radius in radii.items() if radius}
    return {f"{part}_flat_mm": flat for part, flat in flats.items() if flat}


def _links(parts: Outlines) -> Values:
    """Return pins and width of links, and the sizes of gears."""
    links = drawn_links(parts.assembly.full, parts)
    out = _screws(links)
    if links.sizes and any(links.plates):
        out |= {"link_pin_mm": 2.0 * links.sizes.pin, "link_width_mm": 2.0 * links.sizes.eye}
    return out


def _screws(links: Links) -> Values:
    """Return the holes of the screws of a gear that stands still, and their circle."""
    circles = [gear.screws for gear in links.gears if gear.screws and gear.screws.turns]
    return {
        key: 2.0 * radius
        for one in circles
        for key, radius in (("gear_bolt_mm", one.hole), ("gear_bolt_circle_mm", one.radius))
    }
