"""The sizes that a rule or a load chose: what a spec leaves out, with the reason of each.

``chosen`` has all of them, ``by_load`` those that another load changes, ``detail_sizes`` those of
details, which a load changes only through wheel and crank.
"""

import re
from collections.abc import Mapping
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import thing
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.machine_sizes import key_sizes, machine_sizes
from geneva_cli.parts.outlines.crank_outline import reliefs, sectors
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.parts.outlines.outlines import Outlines, dial_circle, wheel_hub_length
from geneva_cli.parts.shafts.arm_and_shafts import bolts, crank_arm, crank_hub
from geneva_cli.parts.shafts.bores import bore_of
from geneva_cli.parts.sizes import CLEARANCES
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Size

# Not sizes of a part, or sizes whose mere presence makes one: a hub, a limit of `check`.
LEFT_OUT = ("wheel_hub_mm", "crank_hub_mm", "wall_min_mm")
BY_LOAD = "by load"  # the reason of a size that the load chose, before the load
CRANK = "crank shaft {}", "{0.crank_N:.4g} N and {0.crank_Nm:.4g} N m on the crank's shaft"
WHEEL = "wheel shaft {}", "{0.wheel_shaft_N:.4g} N and {0.wheel_Nm:.4g} N m on its shaft"
# What people call the sizes that a load chooses, the first one that is to be looked at first, and
# what of the loads chooses them.
NAMES = {
    "size.crank_bore_mm": CRANK,
    "size.arm_bore_mm": CRANK,
    "size.wheel_bore_mm": WHEEL,
    "size.pin_mm": ("pin {}", "{0.pin_N:.4g} N on the pin"),
    "size.arm_thickness_mm": ("arm {} thick", "{0.wheel_N:.4g} N on the arm"),
    "size.wheel_thickness_mm": ("wheel {} thick", "{0.pin_N:.4g} N on the horns"),
    "size.link_thickness_mm": ("links {} thick", "{0.crank_Nm:.4g} N m on the first wheel"),
}

Values = dict[str, float | str]


class Chosen(NamedTuple):
    """A size that the spec leaves out: its value in the key's unit, and who chose it."""

    value: float | str
    why: str


class ByLoad(NamedTuple):
    """The sizes that a load chose, by their keys; and those that it chose without an option."""

    sizes: Mapping[str, Chosen]
    before: Mapping[str, Chosen]

    @property
    def words(self) -> str:
        """The sizes in words, as "crank shaft 12, pin 7"; empty without any."""
        texts = dict[str, None]()  # once, in the order of their names
        for key, (words, _) in NAMES.items():
            if key in self.sizes and (value := self.sizes[key].value):
                texts[words.format(f"{value:g}")] = None
        return ", ".join(texts)

    @property
    def changes(self) -> str:
        """The sizes that were chosen anew, as "crank shaft 12 → 17 mm"; empty if none was."""
        texts = dict[str, None]()
        for key in filter(self.sizes.__contains__, filter(self.before.__contains__, NAMES)):
            now, was = self.sizes[key].value, self.before[key].value
            # a bore of 0 ends the shaft in the arm, whose bore is a key of its own
            if now and was and now != was:
                texts[NAMES[key][0].format(f"{was:g} → {now:g} mm")] = None
        return ", ".join(texts)

    @property
    def record(self) -> dict[str, dict[str, float | str | None]]:
        """The sizes as json has them: ``value``, ``was`` (null if unchanged) and ``why``."""
        out: dict[str, dict[str, float | str | None]] = {}
        for key, one in self.sizes.items():
            was = self.before.get(key, one).value
            changed = None if was == one.value else was
            out[key] = {"value": one.value, "was": changed, "why": one.why}
        return out


def chosen(mechanism: Mechanism, details: Values | None = None) -> dict[str, Chosen]:
    """Return every size that a rule or the load chose, by its key ``size.NAME``; mm.

    ``details`` are those of ``detail_sizes``, which need the parts. Written into the spec the sizes
    make the same machine. Left out are those that differ from place to place.

    >>> chosen(Design(External(6)).mechanism)["size.roller_radius_mm"]
    Chosen(value=5.0, why='default L/20')
    """
    (known, keys), out = key_sizes(mechanism), dict[str, Chosen]()
    values, loads = {**known, **(details or {})}, None
    if keys:
        from geneva_cli.loads.strength.part_loads import single_loads

        loads = single_loads(mechanism)
    size = mechanism.spec.size
    for field in fields(Size):
        key, own = field.key, getattr(size, field.attribute)
        if own is not None or key not in values or not _is_written(mechanism, key, values):
            continue
        # what the meaning of a key says of its default, without a load
        rule = field.meaning.partition("default")[2].lstrip(": ").partition(";")[0]
        why = f"default {re.sub(',? or by load$', '', rule)}"
        # a crank without an arm has no arm's thickness
        if key in keys and ("arm_bore_mm" in values or key != "arm_thickness_mm"):
            why = f"{BY_LOAD}: {NAMES[f'size.{key}'][1].format(loads)}"
        elif rule.endswith("by process") and size.process:
            why = f"by process {size.process}"
        out[f"size.{key}"] = Chosen(values[key], why)
    return out


def by_load(mechanism: Mechanism) -> dict[str, Chosen]:
    """Return the sizes that the load chose, by their keys ``size.NAME``; empty without a load.

    >>> heavy = Design(External(6), load=Load(torque_Nm=100.0))
    >>> by_load(heavy.mechanism)["size.pin_mm"]
    Chosen(value=7.0, why='by load: 2000 N on the pin')
    """
    every = chosen(mechanism) if mechanism.spec.is_loaded else {}
    return {key: every[key] for key in NAMES if key in every and every[key].why.startswith(BY_LOAD)}


def _is_written(mechanism: Mechanism, key: str, values: Mapping[str, float | str]) -> bool:
    """Return True for a size of a part that the machine has."""
    spec, value = mechanism.spec, values[key]
    if key == "lock_bolts" or isinstance(value, str):
        return True
    if key in LEFT_OUT or (key in CLEARANCES and spec.size.process is None):  # those are 0
        return False
    if key == "center_distance_mm":  # some drives solve for it, or it follows from R
        return value == spec.given_distance_mm and spec.size.crank_radius_mm is None
    if key == "crank_bore_mm":  # 0: the shaft ends in the arm
        return value > 0.0 or "arm_bore_mm" in values
    if key == "relief_clearance_mm":
        return bool(values["lock_radius_mm"])
    if key == "link_thickness_mm":  # of links, gears or a groove's plates
        grooved = mechanism.engagements[0].groove is not None
        return bool(links_at(mechanism, np.zeros(1)) or spec.gears or grooved)
    return value > 0.0


def detail_sizes(mechanism: Mechanism) -> Values:
    """Return the sizes of a machine's details by keys of ``[size]``; none where it is not drawn."""
    own_details = thing(mechanism.spec.wheel.NAME, "details")
    with suppress(GenevaError):
        if own_details:
            return {**own_details(mechanism)}
        if mechanism.spec.is_flat:
            return _flat_details(drawn(*machine_sizes(mechanism)))
    return {}


def _flat_details(parts: Outlines) -> Values:
    """Return the sizes of arm, lock, hubs, the flats of D bores, links, and gears that stand."""
    from geneva_cli.parts.links.link_plates import drawn_links

    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    out: Values = {"relief": parts.relief} if parts.crank else {}
    if parts.has_arm:
        arm, screws = crank_arm(parts), bolts(parts)
        out |= {"arm_hub_mm": 2.0 * arm.hub, "arm_eye_mm": 2.0 * arm.eye}
        if parts.crank:
            each = len(sectors(reliefs(parts.assembly))) if screws else 1
            out["lock_bolts"] = len(screws) // each
        if screws:
            out["lock_bolt_mm"] = 2.0 * screws[0].radius
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
    links = drawn_links(parts.assembly.full, parts)
    if links.bolts:
        out["gear_bolt_mm"] = 2.0 * links.bolts.hole
        out["gear_bolt_circle_mm"] = 2.0 * links.bolts.radius
    if links.plates:
        out |= {"link_pin_mm": 2.0 * links.sizes.pin, "link_width_mm": 2.0 * links.sizes.eye}
    return out
