"""Quantities of many designs at once: what holds, how long, what swings, what is struck.

Each is told by the name of its table in a design's report and its own. NaN is what must be asked of
the design alone; infinite what the design alone has no value of.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, cast

import numpy as np

from geneva_cli.analysis.blows import Blow, Blows, entry_blows, reversal_blows
from geneva_cli.analysis.change_of_sides import lasting_drag_Nm
from geneva_cli.analysis.loads.carried import inertia_kgm2
from geneva_cli.analysis.loads.forces import setting
from geneva_cli.analysis.loads.many import greatest_of_many
from geneva_cli.analysis.loads.quantities import PV
from geneva_cli.analysis.loads.sizing_many import NAMES as SIZING
from geneva_cli.analysis.loads.sizing_many import sizings_of_many
from geneva_cli.analysis.positive_drive import positive_drives
from geneva_cli.analysis.strength import pin as pins
from geneva_cli.analysis.strength import roller, shafts
from geneva_cli.analysis.strength.roller_many import passages_of_many
from geneva_cli.analysis.tolerance.many import entry_jumps_worst, motion_plays, used
from geneva_cli.analysis.vibration.many import Vibrations, vibrations_of_many
from geneva_cli.machine.mechanism import Mechanism

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.numerics.jet import Array

Columns: TypeAlias = "Mapping[str, Number | None]"  # (m,) each, or one number for all


class QuantityGroup(NamedTuple):
    """Quantities of one table that are had together, and what gives those that are asked for."""

    names: tuple[str, ...]
    of: Callable[[Mechanism, Collection[str]], Columns]


def _loaded(machine: Mechanism) -> Array:
    """1 where something resists the wheel, NaN where the design must be asked why nothing does."""
    given = setting(machine)
    return np.ravel(np.where(given.inertia_Nm + given.resists_Nm > 0.0, 1.0, np.nan))


def _force(machine: Mechanism) -> Array:
    return greatest_of_many(machine, ["pin_force_N"])["pin_force_N"].max * _loaded(machine)


def _margin(stress: Number, allowed: Number) -> Array:
    """As ``verdict.life.margin``: none of a stress of 0."""
    stress = np.asarray(stress)
    with np.errstate(all="ignore"):
        return np.where(stress > 0.0, np.ravel(allowed) / stress - 1.0, stress + np.inf)


def _pin(machine: Mechanism, asked: Collection[str]) -> Columns:
    """Under the greatest force, where a face width is known."""
    pin = pins.pin(machine)
    if pin is None:
        return {}
    force = _force(machine)[:, None]
    under, allowed = pin.under(force), machine.spec.material_roller.stress_max_MPa
    stress = np.ravel(under.equivalent)
    out: dict[str, Number | None] = {
        "diameter_mm": pin.diameter_mm,
        "bending_MPa": under.bending,
        "shear_MPa": under.shear,
        "stress_MPa": stress,
    }
    if allowed is not None:
        out["least_diameter_mm"] = pins.least_diameter_mm(pin, force, allowed)
        out["margin"] = _margin(stress, allowed)
    return out


def _wheel_shaft(machine: Mechanism, asked: Collection[str]) -> Columns:
    return _shaft(machine, shafts.wheel_shaft(machine.spec.shaft), shafts.on_wheel)


def _crank_shaft(machine: Mechanism, asked: Collection[str]) -> Columns:
    spec = machine.spec
    on = shafts.on_driven_crank if spec.drive.CRANKED else shafts.on_crank
    return _shaft(machine, shafts.crank_shaft(spec.shaft), on)


def _shaft(machine: Mechanism, ends: shafts.GivenShaft, on: shafts.On) -> Columns:
    """Of shafts that are parallel, as ``verdict.strength`` has it."""
    if not machine.spec.wheel.FLAT:
        return {}
    found = shafts.shaft_of_many(machine, ends, on)
    if found is None:
        return {}
    moment = cast("Array", found.moment_Nm) * _loaded(machine)
    rows = {k: v for k, v in found._asdict().items() if v is not None}
    allowed = machine.spec.shaft.shear_stress_max_MPa
    if found.stress_MPa is not None and allowed is not None:
        rows["margin"] = _margin(found.stress_MPa, allowed)
    return {k: np.where(np.isfinite(moment), v, moment) for k, v in rows.items()}


def _life(machine: Mechanism, asked: Collection[str]) -> Columns:
    """Of the roller and its slot."""
    spec, given, loaded = machine.spec, setting(machine), _loaded(machine)
    out: dict[str, Number | None] = {}
    if {"pv_max_W_m2"} & set(asked) and spec.size.face_width_mm is not None:
        out["pv_max_W_m2"] = greatest_of_many(machine, [PV])[PV].max * loaded
    if "pin_stress_MPa" in asked:
        out["pin_stress_MPa"] = _pin(machine, asked).get("stress_MPa")
    if not set(asked) - set(out):
        return out
    ways = passages_of_many(machine)
    lasts, worn = roller.lives(machine, ways), roller.wears_mm(machine, ways)
    force = cast("Array", lasts.equivalent_force_N)
    work = np.ravel(given.friction) * sum(way.work for way in ways) / len(ways)
    out["slot_travel_m"] = sum(way.travel_m for way in ways) / len(ways)
    under: dict[str, Number | None] = {
        "roller_turns_per_motion": lasts.turns_per_motion,
        "equivalent_force_N": force,
        "friction_work_J": np.where(np.ravel(spec.load.friction) > 0.0, work, np.inf),
        "roller_life_turns": lasts.turns,
        "roller_life_motions": lasts.motions,
        "roller_life_h": lasts.hours,
        # a roller that turns on its pin does not rub in the slot
        "slot_wear_mm_per_million": worn if spec.load.rubs_in_slot else np.inf,
    }
    bound = np.where(np.isfinite(force), loaded, np.inf * loaded)
    for name, value in under.items():
        if value is not None:
            out[name] = np.where(np.isfinite(bound), value, bound)
    return out


def _vibration(machine: Mechanism, asked: Collection[str]) -> Columns:
    found = vibrations_of_many(machine, asked)
    if found is None:
        return {}
    # without damping there is no steady state; without a period ratio the design says why
    steady = np.where(np.isnan(found.steady_share), found.period_ratio + np.inf, found.steady_share)
    return found._replace(steady_share=steady)._asdict()


def _blows(machine: Mechanism, found: Blows) -> dict[str, Number | None]:
    return {name: np.where(np.isnan(row), np.inf, row) for name, row in found._asdict().items()}


def _entry(machine: Mechanism, asked: Collection[str]) -> Columns:
    return _blows(machine, entry_blows(machine))


def _reversal(machine: Mechanism, asked: Collection[str]) -> Columns:
    coasts = np.ravel(inertia_kgm2(machine.spec)) > 0.0
    drag = np.where(coasts, np.ravel(lasting_drag_Nm(machine)), np.inf)
    return {**_blows(machine, reversal_blows(machine)), "drag_Nm": drag}


def _sizing(machine: Mechanism, asked: Collection[str]) -> Columns:
    """NaN where nothing resists the wheel: its design says which values it has."""
    loaded = _loaded(machine)
    found = sizings_of_many(machine, asked)
    return {name: np.where(np.isnan(row), np.inf, row) * loaded for name, row in found.items()}


def _slot(machine: Mechanism, asked: Collection[str]) -> Columns:
    found = positive_drives(machine)
    if found is None:
        return {}
    return dict(zip(SLOT, (found.share, found.gap_mm, found.gap_at_deg), strict=True))


def _play(machine: Mechanism, asked: Collection[str]) -> Columns:
    found = motion_plays(machine)
    return {} if found is None else found._asdict()


def _jump(machine: Mechanism, asked: Collection[str]) -> Columns:
    """Of designs with tolerances that are none too wide: others say so themselves."""
    found, plays = entry_jumps_worst(machine, used(machine)), motion_plays(machine)
    if found is None or plays is None:
        return {}
    return {"worst": np.where(np.isnan(plays.worst_deg), np.nan, found)}


PIN = ("diameter_mm", "bending_MPa", "shear_MPa", "stress_MPa", "least_diameter_mm", "margin")
SHAFT = ("moment_Nm", "at_deg", "stress_MPa", "least_diameter_mm", "twist_deg", "margin")
LIFE = (
    *("slot_travel_m", "roller_turns_per_motion", "equivalent_force_N", "friction_work_J"),
    *("pv_max_W_m2", "pin_stress_MPa", "roller_life_turns", "roller_life_motions"),
    *("roller_life_h", "slot_wear_mm_per_million"),
)
SLOT = ("not_driven_share", "branch_gap_mm", "branch_gap_at_deg")
GROUPS = {
    "strength.pin": QuantityGroup(PIN, _pin),
    "strength.wheel_shaft": QuantityGroup(SHAFT, _wheel_shaft),
    "strength.crank_shaft": QuantityGroup(SHAFT, _crank_shaft),
    "life": QuantityGroup(LIFE, _life),
    "vibration": QuantityGroup(Vibrations._fields, _vibration),
    "shock.entry": QuantityGroup(Blow._fields, _entry),
    "shock.reversal": QuantityGroup((*Blow._fields, "drag_Nm"), _reversal),
    "sizing": QuantityGroup(SIZING, _sizing),
    "slot": QuantityGroup(SLOT, _slot),
    # what the random machines of a study tell is told of each design alone
    "tolerance.motion_play": QuantityGroup(("worst_deg", "rss_deg"), _play),
    "tolerance.entry_jump": QuantityGroup(("worst",), _jump),
}


def is_known(name: str) -> bool:
    """Whether a quantity is one of these."""
    table, _, own = name.rpartition(".")
    return table in GROUPS and own in GROUPS[table].names


def part_columns(machine: Mechanism, names: Collection[str]) -> dict[str, Number | None]:
    """Those of the quantities that are among these."""
    asked: dict[str, list[str]] = {}
    for name in filter(is_known, names):
        table, _, own = name.rpartition(".")
        asked.setdefault(table, []).append(own)
    out: dict[str, Number | None] = {}
    for table, some in asked.items():
        found = GROUPS[table].of(machine, some)
        for name in some:
            value = found.get(name)
            out[f"{table}.{name}"] = np.inf if value is None else value
    return out
