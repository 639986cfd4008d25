"""Strength and life of a single design: its values, and the keys that missing ones need."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache

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
# Values of ``life``, in the order in which `geneva loads` lists their needs.
OF_LIFE = (
    *("roller_life_turns", "roller_life_motions", "roller_life_h", "equivalent_force_N"),
    *("horn_stress_MPa", "friction_work_J", "pv_max_W_m2", "pin_stress_MPa"),
)
# All values whose needs a report lists, by their names in checks and in ``life``.
NEEDY = (
    *("pin_stress_MPa", "horn_stress_MPa", "lock_stress_max_MPa", "lock_deflection_max_deg"),
    *("lock_horn_stress_MPa", "wheel_shaft_stress_MPa", "crank_shaft_stress_MPa"),
    *("arm_stress_MPa", "wheel_key_pressure_MPa", "crank_key_pressure_MPa"),
    *("roller_life_min_h", "roller_life_turns", "roller_life_motions", "roller_life_h"),
    *("equivalent_force_N", "friction_work_J", "pv_max_W_m2"),
)
BOUND = "a force with a bound: see the warnings"
_FLAT = "a wheel that is drawn as a flat outline"
_CUT = "parts that can be cut: see `geneva check`"
_WIDTH = "face_width_mm in [size]"
_EDGE = "lock_edge_mm in [size]"
_SHORT = "lock_clearance_mm = 0 in [size]: the end of a short locking disc is sharp"


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
        """A value by its whole name as its group has it: infinite if it is unbounded."""
        table, _, own = name.rpartition(".")
        return (REPORT_GROUPS.get(name) or REPORT_GROUPS[table]).columns(self.design).get(own)

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
        """The keys that a value of ``NEEDY`` needs, in words.

        None for a known value, or for one that the machine lacks, such as a horn's without a lock.
        """
        load = self.spec.load_keys
        for step in self._needs(name):
            if words := [words for is_met, words in step if not is_met]:
                # without a load nothing else helps
                return load if load in words else " and ".join(words) or None
        return None

    def _needs(self, name: str) -> Iterator[list[tuple[bool, str]]]:
        """Steps of needs: whether each is met, and its keys in words.

        Those of a step are given together, if the earlier ones are met. The machine lacks a part
        without words.
        """
        spec, load = self.spec, self.load
        loaded = spec.is_loaded, spec.load_keys
        face = spec.size.face_width_mm is not None, _WIDTH
        part = name.removesuffix("_stress_MPa").removesuffix("_pressure_MPa")
        if name == "friction_work_J":
            yield [(bool(spec.load.friction), "friction in [load]"), loaded]
        elif name == "pv_max_W_m2":
            yield [face, loaded]
            pv = self._column("life.pv_max_W_m2")
            bounded = pv is not None and bool(np.all(np.isfinite(pv)))
            yield [(bounded, "a stress with a bound: see the warnings")]
        elif name.startswith("roller_life"):
            yield [self._bound]
            rated = spec.material_roller.dynamic_capacity_N is not None
            yield [(rated, "dynamic_capacity_N in [material.roller]"), loaded]
        elif name.startswith("lock_"):
            yield from self._lock_needs(name)
        elif part.endswith("_shaft"):
            yield from self._shaft_needs(part.removesuffix("_shaft"))
        else:
            if name == "horn_stress_MPa":
                drawn = bool(load.horn_sizes)
                yield [(spec.is_flat or drawn, _FLAT)]
                yield [(drawn or bool(sized(self.mechanism)), _CUT)]
                yield [(load.has_horns, "")]
            elif part in ("arm", "wheel_key", "crank_key"):
                yield [(self._has_part(part), "")]
            if part in ("pin", "horn"):
                yield [(load.contact_mm is not None, _WIDTH), loaded]
            yield [loaded]
            yield [self._bound]

    def _lock_needs(self, name: str) -> Iterator[list[tuple[bool, str]]]:
        load = self.load
        yield [(self.spec.is_flat, _FLAT)]
        yield [(bool(load.lock_sizes or sized(self.mechanism)), _CUT)]
        yield [(load.lock_sizes is not None, "")]
        held = bool(held_torque_Nm(self.mechanism)), "dwell_torque_Nm in [load]"
        yield [(load.contact_mm is not None, _WIDTH), held]
        if name != "lock_horn_stress_MPa":  # on a sharp edge a contact stress has no bound
            sharp = bool(load.lock and np.isnan(load.lock.approach_deg))
            corner = load.lock is not None and load.lock.on == "corner"
            yield [(not sharp, _EDGE if corner else _SHORT)]

    def _shaft_needs(self, shaft: str) -> Iterator[list[tuple[bool, str]]]:
        spec, load = self.spec, self.load
        if shaft == "wheel":
            yield [(spec.output.turns, "a wheel that turns on a shaft")]
        yield [self._bound]
        drawn = load.parts is not None
        known = {"overhang": drawn, "diameter": drawn and self._has_part(f"{shaft}_shaft")}
        step = [(spec.is_loaded, spec.load_keys)]
        for key in ("diameter", "overhang"):
            own = vars(spec.shaft)[f"{shaft}_{key}_mm"] is not None
            step.insert(0, (own or known[key], f"{shaft}_{key}_mm in [shaft]"))
        yield step

    def missing(self, among: Sequence[str]) -> list[str]:
        """The keys that the unknown values of ``among`` need, in words."""
        by_key: dict[str, list[str]] = {}
        for name in among:
            if keys := self.reason(name):
                by_key.setdefault(keys, []).append(name)
        if self.spec.load_keys in by_key:  # nearly all
            by_key[self.spec.load_keys] = ["forces", "stresses", "life"]
        return [
            f"{', '.join(names)}: need{'s' * (len(names) == 1)} {keys}"
            for keys, names in by_key.items()
        ]

    @property
    def _bound(self) -> tuple[bool, str]:
        """Whether the roller's force has a bound, if there is a load."""
        return not self.spec.is_loaded or math.isfinite(self.load.force_N[0]), BOUND

    def _has_part(self, part: str) -> bool:
        """Return True unless the machine lacks an arm, a key or a shaft; unknown ones count."""
        parts = self.load.parts
        return parts is None or not np.isnan(getattr(parts, part)[0][0])


@lru_cache(maxsize=16)
def strength(mechanism: Mechanism) -> Strength:
    """The strength of a machine, cached for its checks, advice and report."""
    return Strength(mechanism)
