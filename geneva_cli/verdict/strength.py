"""Strength of a whole design: what parts and loads give together, and what is missing."""

from __future__ import annotations

from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

from geneva_cli.analysis.loads.summary import PARALLEL
from geneva_cli.analysis.strength import lock, shafts
from geneva_cli.verdict.life import Life
from geneva_cli.verdict.lock_sizes import lock_of

if TYPE_CHECKING:
    from geneva_cli.analysis.strength.lock import LockUnderTorque
    from geneva_cli.machine.mechanism import Mechanism

LOCK = ("lock_stress_max_MPa", "lock_deflection_max_deg", "lock_horn_stress_MPa")


class Strength(Life):
    """The values of ``Life``, and those of the lock and of both shafts."""

    @cached_property
    def lock(self) -> lock.LockUnderTorque | None:
        """The lock under the torque that it holds in the dwell."""
        for name in LOCK:
            self._cut(name)
        if self._sized is None or not self._sized[1].lock:
            return None
        held = bool(lock.held_torque_Nm(self.mechanism))
        lacks = [self._lacks(n, self._wide, (held, "dwell_torque_Nm in [load]")) for n in LOCK]
        if any(lacks):
            return None
        return lock.lock(self.mechanism, self._sized[1].half_width, lock_of(*self._sized))

    @cached_property
    def lock_stress_max_MPa(self) -> float | None:
        """The greatest stress between disc and recess: on the recess's end, or as the arcs lie."""
        found = self.lock
        if found is None or self._sharp("lock_stress_max_MPa", found):
            return None
        return max(found.contact_stress_MPa or 0.0, found.pressure_MPa)

    @cached_property
    def lock_deflection_deg(self) -> float | None:
        """How far the wheel gives in its lock, its play included."""
        found = self.lock
        if found is None or self._sharp("lock_deflection_max_deg", found):
            return None
        return found.deflection_deg

    def _sharp(self, name: str, found: LockUnderTorque) -> bool:
        """Whether the lock bears on a sharp edge, whose stress has no bound."""
        rounds = (
            "lock_edge_mm in [size]"
            if found.on == "corner"
            else "lock_clearance_mm = 0 in [size]: the end of a short locking disc is sharp"
        )
        return self._lacks(name, (found.approach_deg is not None, rounds))

    @cached_property
    def wheel_shaft(self) -> shafts.Turned | None:
        """The wheel's shaft, where it is parallel to the crank's; None of others."""
        return self._shaft("wheel", shafts.wheel_shaft(self.spec.shaft), shafts.on_wheel)

    @cached_property
    def crank_shaft(self) -> shafts.Turned | None:
        """The shaft of the crank, likewise."""
        on = shafts.on_driven_crank if self.spec.drive.CRANKED else shafts.on_crank
        return self._shaft("crank", shafts.crank_shaft(self.spec.shaft), on)

    def _shaft(
        self, which: str, ends: shafts.GivenShaft, loaded: shafts.On
    ) -> shafts.Turned | None:
        """On a sphere the force's moment does not follow from an overhang."""
        name = f"{which}_shaft_stress_MPa"
        if self._lacks(name, (self.spec.wheel.FLAT, PARALLEL)):
            return None
        placed = (ends.overhang_mm is not None, f"{which}_overhang_mm in [shaft]")
        thick = (ends.diameter_mm is not None, f"{which}_diameter_mm in [shaft]")
        self._lacks(name, placed, thick, self._loaded)
        if not self.spec.is_loaded or not self._bounded(name):
            return None
        return shafts.shaft(self.mechanism, ends, loaded)


def margin(value: float | None, allowed: float | None) -> float | None:
    """How far a value may still grow, as a share of it: 0 where it is what is allowed.

    >>> margin(80.0, 120.0)
    0.5
    """
    return None if not value or allowed is None else allowed / value - 1.0


@lru_cache(maxsize=16)
def strength(mechanism: Mechanism) -> Strength:
    """The strength of a machine, kept while it is checked, advised on and reported."""
    return Strength(mechanism)
