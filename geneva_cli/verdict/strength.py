"""Strength and life of a single design: its values, and the keys that missing ones need."""

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from geneva_cli.errors import Notice
from geneva_cli.loads.strength.horn import STOUT
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import value_or
from geneva_cli.parts.machine_sizes import sized
from geneva_cli.verdict.quantities.groups import GROUP_OF, only, single, value_of
from geneva_cli.verdict.quantities.under_load import UnderLoad

# Values of ``life``, in the order in which `geneva loads` lists their needs.
OF_LIFE = (
    *("roller_life_turns", "roller_life_motions", "roller_life_h", "equivalent_force_N"),
    *("horn_stress_MPa", "friction_work_J", "pv_max_W_m2", "pin_stress_MPa"),
)
BOUND = "a force with a bound: see the warnings"
_WIDTH = "face_width_mm in [size]"
_EDGE = "lock_edge_mm in [size]"
_SHORT = "lock_clearance_mm = 0 in [size]: the end of a short locking disc is sharp"


class Strength:
    """The strength and life of one design; a value is computed when it is first used."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.spec = mechanism.spec
        self.load = single(mechanism).once(UnderLoad)

    def __getitem__(self, name: str) -> float | None:
        """A value by its whole name, such as ``strength.pin.stress_MPa``; None if unknown."""
        value = value_of(self.mechanism, name)
        return value if math.isfinite(value) else None

    def table(self, name: str) -> dict[str, float | None]:
        """The values of a table, such as ``life`` or ``shock.reversal``, by their own names."""
        start = f"{name}."
        return {n.removeprefix(start): self[n] for n in GROUP_OF if n.startswith(start)}

    @property
    def lock_MPa(self) -> float | None:
        """The greatest stress between disc and recess; None if it is not known."""
        names = ("approach_deg", "contact_stress_MPa", "pressure_MPa")
        approach, *each = (self[f"strength.lock.{name}"] for name in names)
        return max((x for x in each if approach is not None and x is not None), default=None)

    @property
    def contact_mm(self) -> float | None:
        """Length of the contact line; None if it is not known."""
        return only(self.load.contact_mm)

    def warnings(self) -> Iterator[Notice]:
        """A note on the limits of a known stress."""
        known, stout, recess = self["strength.horn.stress_MPa"] is not None, 0.0, 0.0
        for horn in self.load.sides(self.mechanism, *self.load.horn_sizes or ()) if known else ():
            # thickness at the mouth over the recess's radius, and that
            thick, own = horn.points(horn.at.mouth_deg)[1].item(), float(horn.recess_mm)
            stout, recess = max((stout, recess), (thick / own, own))
        if stout > STOUT:
            yield Notice(
                "stout-horns",
                "horn_stress_MPa is that of a slender beam, but the horns are thick: "
                f"{stout:.3g} times their recess's radius ({recess:.4g} mm) at the mouth. The "
                "stress is 7 % too small for horns of half that radius, more for thicker ones",
            )

    def reason(self, name: str) -> str | None:
        """The keys that a value of ``OF_LIFE``, or a limited one, needs, in words.

        None for a known value, or for one that the machine lacks, such as a horn's without a lock.
        """
        spec, load, locked = self.spec, self.load, name.startswith("lock_")
        if not (spec.is_loaded or locked):
            return spec.output.load_keys  # nothing else helps
        if locked or name == "horn_stress_MPa":
            return self._horn_reason(name, locked)
        if name == "friction_work_J":
            return None if spec.load.friction else "friction in [load]"
        if name == "pv_max_W_m2":
            if spec.size.face_width_mm is None:
                return _WIDTH
            is_known = self["life.pv_max_W_m2"] is not None
            return None if is_known else "a stress with a bound: see the warnings"
        part = name.removesuffix("_stress_MPa").removesuffix("_pressure_MPa")
        drawn, is_shaft = load.parts, part.endswith("_shaft")
        lacks = drawn is None
        if drawn is not None and (is_shaft or part in ("arm", "wheel_key", "crank_key")):
            lacks = bool(np.isnan(getattr(drawn, part)[0][0]))
            if lacks and not is_shaft:
                return None
        if part == "wheel_shaft" and not spec.output.turns:
            return "a wheel that turns on a shaft"
        if not math.isfinite(load.force_N[0]):
            return BOUND
        needs = list[str]()
        for end, is_unknown in {"overhang": drawn is None, "diameter": lacks}.items():
            key = f"{part.removesuffix('_shaft')}_{end}_mm"
            if is_shaft and is_unknown and vars(spec.shaft)[key] is None:
                needs.append(f"{key} in [shaft]")
        if part == "pin" and load.contact_mm is None:
            needs.append(_WIDTH)
        if name.startswith("roller_life") and spec.material_roller.dynamic_capacity_N is None:
            needs.append("dynamic_capacity_N in [material.roller]")
        return " and ".join(needs) or None

    def _horn_reason(self, name: str, locked: bool) -> str | None:
        """The keys that a stress of horns or lock needs; None for a machine that has none."""
        load = self.load
        drawn = load.lock_sizes if locked else load.horn_sizes
        if not (self.spec.is_flat or (drawn and not locked)):
            return "a wheel that is drawn as a flat outline"
        if not (drawn or sized(self.mechanism)):
            return "parts that can be cut: see `geneva check`"
        if not (drawn if locked else load.has_horns):
            return None
        needs = [] if load.contact_mm is not None else [_WIDTH]
        if locked and not value_or(self.spec.load.dwell_torque_Nm, self.spec.load.torque_Nm):
            needs.append("dwell_torque_Nm in [load]")
        if not (locked or math.isfinite(load.force_N[0])):
            needs.append(BOUND)
        sharp = locked and not needs and name != "lock_horn_stress_MPa"  # a stress without a bound
        if sharp and load.lock_sizes and self["strength.lock.approach_deg"] is None:
            return _EDGE if load.lock_sizes[1].contact().on == "corner" else _SHORT
        return " and ".join(needs) or None

    def missing(self, among: Sequence[str]) -> list[str]:
        """The keys that the unknown values of ``among`` need, in words."""
        by_key: dict[str, list[str]] = {}
        for name in dict.fromkeys(among):
            if keys := self.reason(name):
                by_key.setdefault(keys, []).append(name)
        if self.spec.output.load_keys in by_key:  # nearly all
            by_key[self.spec.output.load_keys] = ["forces", "stresses", "life"]
        return [
            f"{', '.join(names)}: need{'s' * (len(names) == 1)} {keys}"
            for keys, names in by_key.items()
        ]


# The strength of a machine, cached for its checks, advice and report.
strength = lru_cache(maxsize=16)(Strength)
