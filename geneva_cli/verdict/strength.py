"""Strength and life of a single design: its values, and the keys that missing ones need."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import Notice
from geneva_cli.kept import cached_property
from geneva_cli.loads.strength.horn import STOUT
from geneva_cli.loads.strength.lock import held_torque_Nm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Number
from geneva_cli.parts.machine_sizes import sized
from geneva_cli.verdict.quantities.batch_designs import single
from geneva_cli.verdict.quantities.groups import REPORT, only
from geneva_cli.verdict.quantities.under_load import under_load

# The groups by the names of their tables, and by the whole names of their quantities.
REPORT_GROUPS = {name: group for group in REPORT for name in (group.table, *group.names)}


class Strength:
    """The strength and life of one design; a value is computed when it is first used."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.spec = mechanism.spec
        self.design = single(mechanism)
        self.load = under_load(self.design)

    def __getitem__(self, name: str) -> float | None:
        """A value by its whole name, such as ``strength.pin.stress_MPa``; None if unknown."""
        return only(self.column(name))

    def column(self, name: str) -> Number | None:
        """A value by its whole name as its group has it: infinite if it is unbounded."""
        table, _, own = name.rpartition(".")
        columns = (REPORT_GROUPS.get(name) or REPORT_GROUPS[table]).columns(self.design)
        return columns.get(own)

    @cached_property
    def life(self) -> dict[str, float | None]:
        """The values of the group ``life``, by name."""
        names = (name for name in REPORT_GROUPS if name.startswith("life."))
        return {name.removeprefix("life."): self[name] for name in names}

    @cached_property
    def reversal(self) -> dict[str, float | None]:
        """The impact at a change of sides: the values of ``shock.reversal``, by name."""
        table = "shock.reversal"
        return {name: self[f"{table}.{name}"] for name in REPORT_GROUPS[table].own}

    @property
    def contact_mm(self) -> float | None:
        """Length of the contact line; None if it is not known."""
        width = self.load.contact_mm
        return None if width is None else float(np.ravel(width)[0])

    def warnings(self) -> list[Notice]:
        """A note on the limits of a known stress."""
        if self["strength.horn.stress_MPa"] is None:
            return []
        stout, recess = self.load.stoutest_horn()
        if stout <= STOUT:
            return []
        return [
            Notice(
                "stout-horns",
                "horn_stress_MPa is that of a slender beam, but the horns are thick: "
                f"{stout:.3g} times their recess's radius ({recess:.4g} mm) at the mouth. The "
                "stress is 7 % too small for horns of half that radius, more for thicker ones",
            )
        ]

    def reason(self, name: str) -> str | None:
        """The keys that a value of ``REASONS`` needs, in words.

        None for a known value, or for one that the machine lacks, such as a horn's without a lock.
        """
        part = name.removesuffix("_stress_MPa").removesuffix("_pressure_MPa")
        for step in REASONS[name].split("; "):
            unmet = [need for one in step.split() if not (need := NEEDS[one]).met(self, part)]
            if unmet:
                each = [
                    need.words if isinstance(need.words, str) else need.words(self)
                    for need in unmet
                ]
                # without a load nothing else helps
                load = self.spec.load_keys
                words = load if load in each else " and ".join(each)
                return words.replace("{part}", part.removesuffix("_shaft")) or None
        return None

    def missing(self, among: Sequence[str]) -> list[str]:
        """The keys that the unknown values of ``among`` need, in words."""
        by_key: dict[str, list[str]] = {}
        for name in among:
            keys = self.reason(name)
            if keys:
                by_key.setdefault(keys, []).append(name)
        if self.spec.load_keys in by_key:  # nearly all
            by_key[self.spec.load_keys] = ["forces", "stresses", "life"]
        return [
            f"{', '.join(names)}: need{'s' * (len(names) == 1)} {keys}"
            for keys, names in by_key.items()
        ]

    @property
    def has_bound(self) -> bool:
        """True if the roller's force has a bound."""
        return math.isfinite(self.load.force_N[0])

    def has_part(self, part: str) -> bool:
        """Return True unless the machine lacks an arm, a key or a shaft; unknown ones count."""
        parts = self.load.parts
        return parts is None or not np.isnan(getattr(parts, part)[0][0])

    def has_shaft(self, part: str, key: str) -> bool:
        """Return True if overhang or diameter of a shaft is known, of the spec or as drawn."""
        drawn = self.load.parts is not None and (key == "overhang" or self.has_part(part))
        own = f"{part.removesuffix('_shaft')}_{key}_mm"
        return drawn or vars(self.spec.shaft)[own] is not None


class Need(NamedTuple):
    """What a value needs: whether it is met, and its keys in words.

    Both are asked for the part that a check is named after. Without words the machine lacks the
    part, and nothing more is needed.
    """

    met: Callable[[Strength, str], bool]
    words: str | Callable[[Strength], str] = ""


BOUND = "a force with a bound: see the warnings"
_FLAT = "a wheel that is drawn as a flat outline"
_CUT = "parts that can be cut: see `geneva check`"
_WIDTH = "face_width_mm in [size]"


def _edge(of: Strength) -> str:
    """The keys of a finite contact stress of the lock: on a sharp edge it has no bound."""
    if of.load.lock and of.load.lock.on == "corner":
        return "lock_edge_mm in [size]"
    return "lock_clearance_mm = 0 in [size]: the end of a short locking disc is sharp"


def _pv_bounded(of: Strength, _: str) -> bool:
    pv = of.column("life.pv_max_W_m2")
    return pv is not None and bool(np.all(np.isfinite(pv)))


NEEDS = {
    "load": Need(lambda of, _: of.spec.is_loaded, lambda of: of.spec.load_keys),
    "bound": Need(lambda of, _: of.has_bound, BOUND),
    "bound_if_loaded": Need(lambda of, _: not of.spec.is_loaded or of.has_bound, BOUND),
    "face": Need(lambda of, _: of.spec.size.face_width_mm is not None, _WIDTH),
    # the width of the contact: of the spec, or of the drawn wheel
    "width": Need(lambda of, _: of.load.contact_mm is not None, _WIDTH),
    "flat": Need(lambda of, _: of.spec.is_flat, _FLAT),
    "cut": Need(lambda of, _: bool(of.load.lock_sizes or sized(of.mechanism)), _CUT),
    "horns_drawn": Need(lambda of, _: of.spec.is_flat or bool(of.load.horn_sizes), _FLAT),
    "horns_cut": Need(lambda of, _: bool(of.load.horn_sizes or sized(of.mechanism)), _CUT),
    "horns": Need(lambda of, _: of.load.has_horns),
    "lock": Need(lambda of, _: of.load.lock_sizes is not None),
    "held": Need(lambda of, _: bool(held_torque_Nm(of.mechanism)), "dwell_torque_Nm in [load]"),
    "edge": Need(lambda of, _: not (of.load.lock and np.isnan(of.load.lock.approach_deg)), _edge),
    "turns": Need(lambda of, _: of.spec.output.turns, "a wheel that turns on a shaft"),
    "overhang": Need(
        lambda of, part: of.has_shaft(part, "overhang"), "{part}_overhang_mm in [shaft]"
    ),
    "diameter": Need(
        lambda of, part: of.has_shaft(part, "diameter"), "{part}_diameter_mm in [shaft]"
    ),
    "part": Need(lambda of, part: of.has_part(part)),
    "rated": Need(
        lambda of, _: of.spec.material_roller.dynamic_capacity_N is not None,
        "dynamic_capacity_N in [material.roller]",
    ),
    "friction": Need(lambda of, _: bool(of.spec.load.friction), "friction in [load]"),
    "pv": Need(_pv_bounded, "a stress with a bound: see the warnings"),
    "worn": Need(
        lambda of, _: of.spec.material_wheel.wear_mm3_Nm is not None,
        "wear_mm3_Nm in [material.wheel]",
    ),
    "rubs": Need(lambda of, _: of.spec.load.rubs_in_slot, 'friction_at = "slot" in [load]'),
}
_LOCK = "flat; cut; lock; width held"
_WEAR = "worn rubs face load; bound"
_PART = "part; load; bound"
_LIFE = "bound_if_loaded; rated load"
# The needs of each value under its name in checks and in ``life``. Those of a step, up to a
# semicolon, are given together, if the earlier ones are met.
REASONS = {
    "pin_stress_MPa": "width load; bound",
    "horn_stress_MPa": "horns_drawn; horns_cut; horns; width load; bound",
    "lock_stress_max_MPa": f"{_LOCK}; edge",
    "lock_deflection_max_deg": f"{_LOCK}; edge",
    "lock_horn_stress_MPa": _LOCK,
    "wheel_shaft_stress_MPa": "turns; bound_if_loaded; overhang diameter load",
    "crank_shaft_stress_MPa": "bound_if_loaded; overhang diameter load",
    "arm_stress_MPa": _PART,
    "wheel_key_pressure_MPa": _PART,
    "crank_key_pressure_MPa": _PART,
    "roller_life_min_h": _LIFE,
    "roller_life_turns": _LIFE,
    "roller_life_motions": _LIFE,
    "roller_life_h": _LIFE,
    "equivalent_force_N": "load; bound",
    "friction_work_J": "friction load",
    "pv_max_W_m2": "face load; pv",
    "slot_wear_mm_per_million": _WEAR,
    "slot_wear_max_mm_per_million": _WEAR,
}
# Values of ``life``, in the order in which `geneva loads` lists their needs.
OF_LIFE = (
    "roller_life_turns",
    "roller_life_motions",
    "roller_life_h",
    "equivalent_force_N",
    "horn_stress_MPa",
    "friction_work_J",
    "pv_max_W_m2",
    "pin_stress_MPa",
    "slot_wear_mm_per_million",
)


@lru_cache(maxsize=16)
def strength(mechanism: Mechanism) -> Strength:
    """The strength of a machine, cached for its checks, advice and report."""
    return Strength(mechanism)
