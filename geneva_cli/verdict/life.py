"""What `geneva loads` says of pin, horn, roller and slots, and what is missing for it."""

from __future__ import annotations

import math
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

from geneva_cli.analysis.loads.cycle import cycle_of
from geneva_cli.analysis.loads.quantities import PV, ends_of
from geneva_cli.analysis.strength import horn, pin, roller
from geneva_cli.parts.sizes import sized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geneva_cli.analysis.loads.cycle import Cycle
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.parts.assembly import Assembly
    from geneva_cli.parts.sizes import Sizes

WIDTH = "face_width_mm in [size]"
LOAD = "inertia_kgm2 or torque_Nm in [load], or a [[mass]]"
LIFE = (
    "slot_travel_m",
    "roller_turns_per_motion",
    "equivalent_force_N",
    "friction_work_J",
    "pv_max_W_m2",
    "pin_stress_MPa",
    "horn_stress_MPa",
    "roller_life_turns",
    "roller_life_motions",
    "roller_life_h",
    "slot_wear_mm_per_million",
)
WEAR = ("slot_wear_mm_per_million", "slot_wear_max_mm_per_million")  # and its limit
ROLLER = ("roller_life_min_h", "roller_life_turns", "roller_life_motions", "roller_life_h")


class Life:
    """The strength of one machine, each value worked out when it is first used; None if not known.

    ``needs`` says by the value's name which keys would give it; a value that does not apply to a
    machine, as the horn's of one without a lock, needs none.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.spec = mechanism.spec
        self.needs: dict[str, str] = {}

    def _lacks(self, name: str, *keys: tuple[bool, str]) -> bool:
        """Whether something is missing; ``keys`` are what must be there, and how to say it."""
        missing = [key for there, key in keys if not there]
        if missing:  # without a load nothing else helps
            self.needs[name] = LOAD if LOAD in missing else " and ".join(missing)
        return bool(missing)

    @cached_property
    def _wide(self) -> tuple[bool, str]:
        return self.spec.size.face_width_mm is not None, WIDTH

    @cached_property
    def _loaded(self) -> tuple[bool, str]:
        return self.spec.is_loaded, LOAD

    @cached_property
    def cycle(self) -> Cycle:
        """The cycle under load."""
        return cycle_of(self.mechanism)

    @cached_property
    def _sized(self) -> tuple[Assembly, Sizes] | None:
        return sized(self.mechanism)

    @property
    def sizes(self) -> Sizes | None:
        """The parts' sizes; None where there are no flat parts, or none can be cut."""
        return self._sized and self._sized[1]

    def _cut(self, name: str) -> None:
        """What a value lacks that is worked out of the parts, where there are none."""
        flat = (self.spec.is_flat, "a wheel that is drawn as a flat outline")
        there = (self.sizes is not None or not flat[0], "parts that can be cut: see `geneva check`")
        self._lacks(name, flat, there)

    @cached_property
    def _tops(self) -> list[float]:
        """The greatest pin force and, with a face width, the square of pressure times speed."""
        asked = ("pin_force_N", PV) if self._wide[0] else ("pin_force_N",)
        force, *rest = ends_of(self.cycle, *asked)
        return [max(force.max, -force.min), *[one.max for one in rest]]

    @cached_property
    def force_N(self) -> float | None:
        """The greatest force on the roller; None without a load, or where nothing bounds it."""
        if not self.spec.is_loaded:
            return None
        return self._tops[0] if math.isfinite(self._tops[0]) else None

    def _bounded(self, name: str) -> bool:
        if self.force_N is None:
            self.needs[name] = "a force with a bound: see the warnings"
        return self.force_N is not None

    @cached_property
    def pin(self) -> pin.Pin | None:
        """The pin's stresses under one newton."""
        return pin.pin(self.mechanism)

    @cached_property
    def pin_stress_MPa(self) -> float | None:
        """The pin's greatest equivalent stress."""
        name = "pin_stress_MPa"
        if self._lacks(name, self._wide, self._loaded) or not self._bounded(name):
            return None
        assert self.pin is not None and self.force_N is not None
        return float(self.pin.equivalent * self.force_N)

    @cached_property
    def horn(self) -> horn.HornStress | None:
        """The horn where the roller bends it most."""
        name, found = "horn_stress_MPa", self.sizes
        self._cut(name)
        if found is None or not found.recess:
            return None
        if self._lacks(name, self._wide, self._loaded) or not self._bounded(name):
            return None
        width = self.spec.size.face_width_mm
        assert width is not None
        return horn.horn(self.mechanism, found.half_width, found.recess, width)

    def cautions(self) -> list[str]:
        """What a stress that is known leaves out."""
        found = self.sizes
        if self.horn is None or found is None:
            return []
        stout = float(horn.stoutness(self.mechanism, found.half_width, found.recess)[0])
        if stout <= horn.THICK:
            return []
        return [
            f"horn_stress_MPa is that of a slender beam, and this wheel's horns are {stout:.3g} "
            f"times as thick at the mouth as their recess's radius ({found.recess:.4g} mm): it is "
            "7 % too small at half of that radius, and more beyond"
        ]

    @cached_property
    def roller(self) -> roller.Life | None:
        """The most loaded roller as a bearing."""
        rated = self.spec.material_roller.dynamic_capacity_N is not None
        rating = (rated, "dynamic_capacity_N in [material.roller]")
        for name in ROLLER:
            self._lacks(name, rating, self._loaded)
        if self._lacks("equivalent_force_N", self._loaded):
            return None
        for name in ("equivalent_force_N", *ROLLER):
            self._bounded(name)
        if self.force_N is None:
            return None
        return roller.life(self.mechanism)

    @cached_property
    def pv_max_W_m2(self) -> float | None:
        """The greatest contact stress times the speed at which the roller would slide there."""
        if self._lacks("pv_max_W_m2", self._wide, self._loaded):
            return None
        most = self._tops[1]
        if math.isinf(most):
            self.needs["pv_max_W_m2"] = "a stress with a bound: see the warnings"
            return None
        return math.sqrt(most)

    @cached_property
    def friction_work_J(self) -> float | None:
        """The work of friction in the contact, a mean motion's."""
        rubs = (bool(self.spec.load.friction), "friction in [load]")
        if self._lacks("friction_work_J", rubs, self._loaded):
            return None
        every = roller.passages(self.mechanism)
        work = self.cycle.given.friction * math.fsum(way.work for way in every) / len(every)
        return work if math.isfinite(work) else None

    @cached_property
    def wear_mm(self) -> float | None:
        """The depth that a million passages wear off a slot's walls."""
        given = self.spec.material_wheel.wear_mm3_Nm is not None
        key = (given, "wear_mm3_Nm in [material.wheel]")
        # a roller that turns on its pin does not rub in the slot
        rubs = (self.spec.load.rubs_in_slot, 'friction_at = "slot" in [load]')
        keys = (key, rubs, self._wide, self._loaded)
        lacks = [self._lacks(name, *keys) or not self._bounded(name) for name in WEAR]
        return None if any(lacks) else roller.wear_mm(self.mechanism)

    @cached_property
    def values(self) -> dict[str, float | None]:
        """The values of ``LIFE`` by their names."""
        every = roller.passages(self.mechanism)
        lasts, bent = self.roller, self.horn
        values = (
            math.fsum(way.travel_m for way in every) / len(every),
            lasts and lasts.turns_per_motion,
            lasts and lasts.equivalent_force_N,
            self.friction_work_J,
            self.pv_max_W_m2,
            self.pin_stress_MPa,
            bent and bent.stress_MPa,
            lasts and lasts.turns,
            lasts and lasts.motions,
            lasts and lasts.hours,
            self.wear_mm,
        )
        return dict(zip(LIFE, values, strict=True))

    def missing(self, among: Sequence[str]) -> list[str]:
        """What keys would give those values of ``among`` that were looked for in vain, in words."""
        by_key: dict[str, list[str]] = {}
        for name, keys in self.needs.items():
            if name not in among:
                continue
            by_key.setdefault(keys, []).append(name)
        if LOAD in by_key:  # nearly all
            by_key[LOAD] = ["forces", "stresses", "life"]
        return [
            f"{', '.join(names)}: need{'s' * (len(names) == 1)} {keys}"
            for keys, names in by_key.items()
        ]


@lru_cache(maxsize=16)
def life(mechanism: Mechanism) -> Life:
    """The life of a machine, kept while it is asked about."""
    return Life(mechanism)
