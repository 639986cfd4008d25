"""The sizes that a rule or a load chose: what a spec leaves out, with the reason of each.

A size that the spec has stays. One that it leaves out follows from its rule, or is as large as the
load of the run needs. ``chosen`` has all of them, ``by_load`` those that another load changes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.machine_sizes import key_sizes
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Size

# Not sizes of a part, or sizes whose mere presence makes one: a hub, a limit of `check`.
LEFT_OUT = ("wheel_hub_mm", "crank_hub_mm", "wall_min_mm")
# Clearances and fits, which a process sets; without one they are 0, and no rule chose them.
ALLOWED = (
    *("slot_clearance_mm", "lock_clearance_mm", "press_fit_mm", "shaft_fit_mm"),
    "pin_gap_mm",
)
# What people call the sizes that a load chooses, the first one that is to be looked at first.
NAMES = {
    "size.crank_bore_mm": "crank shaft {:g}",
    "size.arm_bore_mm": "crank shaft {:g}",
    "size.wheel_bore_mm": "wheel shaft {:g}",
    "size.pin_mm": "pin {:g}",
    "size.arm_thickness_mm": "arm {:g} thick",
    "size.wheel_thickness_mm": "wheel {:g} thick",
    "size.link_thickness_mm": "links {:g} thick",
}

# Tables of quantities that depend on the sizes of the parts.
OF_SIZES = ("parts", "strength", "life", "checks", "tolerance")


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
        texts = (NAMES[key].format(self.sizes[key].value) for key in NAMES if key in self.sizes)
        return ", ".join(dict.fromkeys(text for text in texts if not text.endswith(" 0")))

    @property
    def changes(self) -> str:
        """The sizes that were chosen anew, as "crank shaft 12 → 17 mm"; empty if none was."""
        return ", ".join(dict.fromkeys(self._changes()))

    def _changes(self) -> Iterator[str]:
        for key, name in NAMES.items():
            now, was = (sizes[key].value if key in sizes else 0.0 for sizes in self)
            # a bore of 0 ends the shaft in the arm, whose bore is a key of its own
            if now and was and now != was:
                yield name.format(was).replace(f"{was:g}", f"{was:g} → {now:g} mm")

    @property
    def record(self) -> dict[str, dict[str, float | str | None]]:
        """The sizes as json has them: ``value``, ``was`` (null if unchanged) and ``why``."""
        return {
            key: {"value": one.value, "was": self._was(key), "why": one.why}
            for key, one in self.sizes.items()
        }

    def _was(self, key: str) -> float | str | None:
        was = self.before[key].value if key in self.before else None
        return None if was == self.sizes[key].value else was


def chosen(
    mechanism: Mechanism, details: Mapping[str, float | str] = MappingProxyType({})
) -> dict[str, Chosen]:
    """Return every size that a rule or the load chose, by its key ``size.NAME``; mm.

    ``details`` are those of ``detail_sizes``, which need the parts.
    They are in the order of the keys of ``[size]``. Written into the spec they make the same
    machine. Left out are sizes that differ from place to place, as those of bolt circles and of
    shafts of links; they follow from the others.

    >>> chosen(Design(External(6)).mechanism)["size.roller_radius_mm"]
    Chosen(value=5.0, why='default L/20')
    """
    size = mechanism.spec.size
    values = {**key_sizes(mechanism).values, **details}
    loaded, meanings = by_load(mechanism), _meanings()
    return {
        f"size.{key}": loaded.get(f"size.{key}")
        or Chosen(values[key], _rule(meanings[key], mechanism.spec))
        for key, own in size.as_dict().items()
        if own is None and key in values and _is_written(mechanism, key, values)
    }


def by_load(mechanism: Mechanism) -> dict[str, Chosen]:
    """Return the sizes that the load chose, by their keys ``size.NAME``; empty without a load.

    >>> heavy = Design(External(6), load=Load(torque_Nm=100.0))
    >>> by_load(heavy.mechanism)["size.pin_mm"]
    Chosen(value=7.0, why='by load: 2000 N on the pin')
    """
    if not mechanism.spec.is_loaded:
        return {}
    values, keys = key_sizes(mechanism)
    armed = "arm_bore_mm" in values
    own = [key for key in keys if key in values and (armed or key != "arm_thickness_mm")]
    held = [key for key in own if _is_written(mechanism, key, values)]
    if not held:
        return {}
    whys = _loads(mechanism)
    return {f"size.{key}": Chosen(values[key], f"by load: {whys[key]}") for key in held}


def _is_written(mechanism: Mechanism, key: str, values: Mapping[str, float | str]) -> bool:
    """Return True for a size of a part that the machine has."""
    spec, value = mechanism.spec, values[key]
    if key == "lock_bolts" or isinstance(value, str):
        return True
    if key in LEFT_OUT or (key in ALLOWED and spec.size.process is None):
        return False
    if key == "center_distance_mm":  # some drives solve for it, or it follows from R
        return value == spec.given_distance_mm and spec.size.crank_radius_mm is None
    if key == "crank_bore_mm":  # 0: the shaft ends in the arm
        return value > 0.0 or "arm_bore_mm" in values
    if key == "relief_clearance_mm":
        return bool(values["lock_radius_mm"])
    if key == "link_thickness_mm":
        return _has_links(mechanism)
    return value > 0.0


def _has_links(mechanism: Mechanism) -> bool:
    """Return True for a machine with plates as thick as its links: links, gears or a groove."""
    grooved = mechanism.engagements[0].groove is not None
    return bool(links_at(mechanism, np.zeros(1)) or mechanism.spec.gears or grooved)


def _rule(meaning: str, spec: Spec) -> str:
    """Return what the meaning of a key says of its default, without a load."""
    rule = meaning.partition("default")[2].lstrip(": ").partition(";")[0]
    if rule.endswith("by process") and spec.size.process:
        return f"by process {spec.size.process}"
    return f"default {re.sub(',? or by load$', '', rule)}"


def _meanings() -> dict[str, str]:
    return {field.key: field.meaning for field in fields(Size)}


def _loads(mechanism: Mechanism) -> dict[str, str]:
    """Return the load that each size holds, in words."""
    from geneva_cli.loads.strength.part_loads import single_loads

    loads = single_loads(mechanism)
    crank = f"{loads.crank_N:.4g} N and {loads.crank_Nm:.4g} N m on the crank's shaft"
    return {
        "crank_bore_mm": crank,
        "arm_bore_mm": crank,
        "wheel_bore_mm": f"{loads.wheel_shaft_N:.4g} N and {loads.wheel_Nm:.4g} N m on its shaft",
        "pin_mm": f"{loads.pin_N:.4g} N on the pin",
        "arm_thickness_mm": f"{loads.wheel_N:.4g} N on the arm",
        "wheel_thickness_mm": f"{loads.pin_N:.4g} N on the horns",
        "link_thickness_mm": f"{loads.crank_Nm:.4g} N m on the first wheel",
    }
