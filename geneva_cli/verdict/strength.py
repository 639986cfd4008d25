"""Strength and life of a single design: its values, and the keys that missing ones need."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from geneva_cli.errors import Notice
from geneva_cli.kept import cached_property
from geneva_cli.loads.strength import horn, lock, shaft_stress
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Number
from geneva_cli.parts.outlines.outline_sizes import sized
from geneva_cli.verdict.quantities.batch_designs import single
from geneva_cli.verdict.quantities.groups import REPORT, only
from geneva_cli.verdict.quantities.under_load import under_load

# The groups by the names of their tables, and by the whole names of their quantities.
REPORT_GROUPS = {name: group for group in REPORT for name in (group.table, *group.names)}

# A need: whether it is met, and its keys in words.
Key: TypeAlias = tuple[bool, str]
Keys: TypeAlias = Iterator[Sequence[Key]]


class Strength:
    """The strength and life of one design; a value is computed when it is first used."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.spec = mechanism.spec
        self.design = single(mechanism)
        self.load = under_load(self.design)

    def __getitem__(self, name: str) -> float | None:
        """A value by its whole name, such as ``strength.pin.stress_MPa``; None if unknown."""
        return only(self._column(name))

    def _column(self, name: str) -> Number | None:
        """A value as its group has it: infinite if it is unbounded."""
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
        assert self.load.horns  # which have the stress
        stout, recess = self.load.horns.stoutness()
        if stout <= horn.STOUT:
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
        for keys in REASONS[name](self):
            missing = [words for there, words in keys if not there]
            if missing:  # without a load nothing else helps
                needs_load = self.spec.load_keys
                return needs_load if needs_load in missing else " and ".join(missing)
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
    def _has_face(self) -> Key:
        return self.spec.size.face_width_mm is not None, "face_width_mm in [size]"

    @property
    def _has_width(self) -> Key:
        """The width of the contact: of the spec, or of the drawn wheel."""
        return self.load.contact_mm is not None, "face_width_mm in [size]"

    @property
    def _has_load(self) -> Key:
        return self.spec.is_loaded, self.spec.load_keys

    @property
    def has_bound(self) -> Key:
        """True if the roller's force has a bound, and the words for it."""
        return math.isfinite(self.load.force_N[0]), "a force with a bound: see the warnings"

    def _drawn_parts(self) -> Sequence[Key]:
        """The needs of a value that is computed from the parts."""
        if not self.spec.is_flat:
            return [(False, "a wheel that is drawn as a flat outline")]
        return [(self._has_parts, "parts that can be cut: see `geneva check`")]

    @cached_property
    def _has_parts(self) -> bool:
        return self.load.lock_sizes is not None or sized(self.mechanism) is not None

    def _pin(self) -> Keys:
        yield self._has_width, self._has_load
        yield [self.has_bound]

    def _horn(self) -> Keys:
        if self.load.horns is None:
            yield self._drawn_parts()
        if self.load.has_horns:
            yield from self._pin()

    def _lock(self) -> Keys:
        yield self._drawn_parts()
        if self.load.lock_sizes is not None:
            has_torque = bool(lock.held_torque_Nm(self.mechanism))
            yield self._has_width, (has_torque, "dwell_torque_Nm in [load]")

    def _contact(self) -> Keys:
        """The needs of the lock's contact stress, which is unbounded on a sharp edge."""
        yield from self._lock()
        lock_load = self.load.lock
        if lock_load is not None:
            rounds = (
                "lock_edge_mm in [size]"
                if lock_load.on == "corner"
                else "lock_clearance_mm = 0 in [size]: the end of a short locking disc is sharp"
            )
            yield [(not np.isnan(lock_load.approach_deg), rounds)]

    def _wheel_shaft(self) -> Keys:
        yield [(self.spec.output.turns, "a wheel that turns on a shaft")]
        yield from self._shaft("wheel", shaft_stress.wheel_shaft(self.spec.shaft))

    def _crank_shaft(self) -> Keys:
        yield from self._shaft("crank", shaft_stress.crank_shaft(self.spec.shaft))

    def _shaft(self, which: str, ends: shaft_stress.ShaftDimensions) -> Keys:
        if self.spec.is_loaded:
            yield [self.has_bound]
        drawn = self.load.parts and getattr(self.load.parts, f"{which}_shaft")
        has_shaft = drawn is not None and not np.isnan(drawn[0][0])
        placed = (ends.overhang_mm is not None or drawn, f"{which}_overhang_mm in [shaft]")
        thick = (ends.diameter_mm is not None or has_shaft, f"{which}_diameter_mm in [shaft]")
        yield [(bool(met), keys) for met, keys in (placed, thick)] + [self._has_load]

    def _part(self, name: str) -> Keys:
        """The needs of an arm or a key, which a machine may lack."""
        if self.load.parts is None or not np.isnan(getattr(self.load.parts, name)[0][0]):
            yield [self._has_load]
            yield [self.has_bound]

    def _rated(self) -> Keys:
        if self.spec.is_loaded:
            yield [self.has_bound]
        rated = self.spec.material_roller.dynamic_capacity_N is not None
        yield (rated, "dynamic_capacity_N in [material.roller]"), self._has_load

    def _bearing(self) -> Keys:
        yield [self._has_load]
        yield [self.has_bound]

    def _friction(self) -> Keys:
        yield (bool(self.spec.load.friction), "friction in [load]"), self._has_load

    def _pressure_speed(self) -> Keys:
        yield self._has_face, self._has_load
        pv = self._column("life.pv_max_W_m2")
        bounded = pv is not None and bool(np.all(np.isfinite(pv)))
        yield [(bounded, "a stress with a bound: see the warnings")]

    def _wear(self) -> Keys:
        worn = self.spec.material_wheel.wear_mm3_Nm is not None
        rubs = (self.spec.load.rubs_in_slot, 'friction_at = "slot" in [load]')
        yield (worn, "wear_mm3_Nm in [material.wheel]"), rubs, self._has_face, self._has_load
        yield [self.has_bound]


# The needs of each value, step by step, under its name in checks and in ``life``.
REASONS: dict[str, Callable[[Strength], Keys]] = {
    "pin_stress_MPa": Strength._pin,
    "horn_stress_MPa": Strength._horn,
    "lock_stress_max_MPa": Strength._contact,
    "lock_deflection_max_deg": Strength._contact,
    "lock_horn_stress_MPa": Strength._lock,
    "wheel_shaft_stress_MPa": Strength._wheel_shaft,
    "crank_shaft_stress_MPa": Strength._crank_shaft,
    "arm_stress_MPa": lambda of: of._part("arm"),
    "wheel_key_pressure_MPa": lambda of: of._part("wheel_key"),
    "crank_key_pressure_MPa": lambda of: of._part("crank_key"),
    "roller_life_min_h": Strength._rated,
    "roller_life_turns": Strength._rated,
    "roller_life_motions": Strength._rated,
    "roller_life_h": Strength._rated,
    "equivalent_force_N": Strength._bearing,
    "friction_work_J": Strength._friction,
    "pv_max_W_m2": Strength._pressure_speed,
    "slot_wear_mm_per_million": Strength._wear,
    "slot_wear_max_mm_per_million": Strength._wear,
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
