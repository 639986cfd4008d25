"""The sizes of details of flat parts by keys of the spec: arm, bolts, relief, hub, flats and links.

They follow from the sizes of wheel and crank: a load changes them only through those.
"""

from __future__ import annotations

from contextlib import suppress

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.arm import bolts, crank_arm
from geneva_cli.parts.gears.gear_curves import pair_teeth
from geneva_cli.parts.links.links import drawn_links
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.crank_outline import reliefs, sectors
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.outlines.wheel_circles import dial_circle, wheel_hub_length
from geneva_cli.parts.shafts.bores import bore_of

Values = dict[str, float | str]


def detail_sizes(mechanism: Mechanism) -> Values:
    """Return the sizes of a machine's details by keys of ``[size]``: mm, diameters, or counts.

    Only details that the machine has are among them; none where its parts cannot be drawn, which
    the checks report.
    """
    out: Values = {}
    if not mechanism.spec.is_flat:
        return out
    with suppress(GenevaError):
        parts = drawn(*machine_sizes(mechanism))
        for own in (_arm, _wheel, _flats, _links):
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


def _flats(parts: Outlines) -> Values:
    """Return the depths of the flats of D bores."""
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    radii = {"wheel": sizes.wheel_bore, "crank": sizes.arm_bore or sizes.crank_bore}
    flats = {part: bore_of(size, part, radius).flat for part, radius in radii.items() if radius}
    return {f"{part}_flat_mm": flat for part, flat in flats.items() if flat}


def _links(parts: Outlines) -> Values:
    """Return pins and width of links, and the teeth of a pair of noncircular gears."""
    machine = parts.assembly.full
    links, teeth = drawn_links(machine, parts), pair_teeth(machine.spec.gears, machine.spec.size)
    out: Values = {"gear_teeth": teeth.z} if teeth else {}
    if links.sizes and any(links.plates):
        out |= {"link_pin_mm": 2.0 * links.sizes.pin, "link_width_mm": 2.0 * links.sizes.eye}
    return out
