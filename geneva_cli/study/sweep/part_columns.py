"""Quantities of many designs at once: how long they last, what swings, what is struck.

Each is told by the name of its table in a design's report and its own. NaN is what must be asked of
the design alone; infinite what the design alone has no value of.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, cast

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
from geneva_cli.analysis.strength import roller
from geneva_cli.analysis.tolerance.many import entry_jumps_worst, used
from geneva_cli.analysis.vibration.vibration import Vibrations, vibrations_of_many
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.study.sweep import strength_columns as strength
from geneva_cli.study.sweep.quantity_group import Columns, Designs, QuantityGroup

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.numerics.jet import Array


def _life(of: Designs, asked: Collection[str]) -> Columns:
    """Of the roller and its slot."""
    machine, loaded = of.machine, of.loaded
    spec, given = machine.spec, setting(machine)
    out: dict[str, Number | None] = {}
    if {"pv_max_W_m2"} & set(asked) and spec.size.face_width_mm is not None:
        out["pv_max_W_m2"] = greatest_of_many(machine, [PV])[PV].max * loaded
    if "pin_stress_MPa" in asked:
        out["pin_stress_MPa"] = strength.pin(of, asked).get("stress_MPa")
    if "horn_stress_MPa" in asked:
        out["horn_stress_MPa"] = strength.horn(of, asked).get("stress_MPa")
    if not set(asked) - set(out):
        return out
    ways = roller.passages(machine)
    paired = any(one.paired for one in machine.engagements)
    lasts = roller.lives(machine, roller.by_roller(machine) if paired else ways)
    worn = roller.wears_mm(machine, ways)
    force = cast("Array", lasts.equivalent_force_N)
    with np.errstate(invalid="ignore"):  # without friction, of a force without a bound
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


def _vibration(of: Designs, asked: Collection[str]) -> Columns:
    found = vibrations_of_many(of.machine, asked)
    if found is None:
        return {}
    # without damping there is no steady state; without a period ratio the design says why
    steady = np.where(np.isnan(found.steady_share), found.period_ratio + np.inf, found.steady_share)
    return found._replace(steady_share=steady)._asdict()


def _blows(found: Blows) -> dict[str, Number | None]:
    return {name: np.where(np.isnan(row), np.inf, row) for name, row in found._asdict().items()}


def _entry(of: Designs, asked: Collection[str]) -> Columns:
    return _blows(entry_blows(of.machine))


def _reversal(of: Designs, asked: Collection[str]) -> Columns:
    machine = of.machine
    coasts = np.ravel(inertia_kgm2(machine.spec)) > 0.0
    drag = np.where(coasts, np.ravel(lasting_drag_Nm(machine)), np.inf)
    return {**_blows(reversal_blows(machine)), "drag_Nm": drag}


def _sizing(of: Designs, asked: Collection[str]) -> Columns:
    """NaN where nothing resists the wheel: its design says which values it has."""
    found = sizings_of_many(of.machine, asked)
    return {name: np.where(np.isnan(row), np.inf, row) * of.loaded for name, row in found.items()}


def _slot(of: Designs, asked: Collection[str]) -> Columns:
    found = positive_drives(of.machine)
    if found is None:
        return {}
    return dict(zip(SLOT, (found.share, found.gap_mm, found.gap_at_deg), strict=True))


def _play(of: Designs, asked: Collection[str]) -> Columns:
    return {} if of.plays is None else of.plays._asdict()


def _jump(of: Designs, asked: Collection[str]) -> Columns:
    """Of designs with tolerances that are none too wide: others say so themselves."""
    found = entry_jumps_worst(of.machine, used(of.machine))
    if found is None or of.plays is None:
        return {}
    return {"worst": np.where(np.isnan(of.plays.worst_deg), np.nan, found)}


LIFE = (
    *("slot_travel_m", "roller_turns_per_motion", "equivalent_force_N", "friction_work_J"),
    *("pv_max_W_m2", "pin_stress_MPa", "horn_stress_MPa", "roller_life_turns"),
    *("roller_life_motions", "roller_life_h", "slot_wear_mm_per_million"),
)
SLOT = ("not_driven_share", "branch_gap_mm", "branch_gap_at_deg")
GROUPS = {
    **strength.GROUPS,
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
    designs = Designs(machine)
    out: dict[str, Number | None] = {}
    for table, some in asked.items():
        found = GROUPS[table].of(designs, some)
        for name in some:
            value = found.get(name)
            out[f"{table}.{name}"] = np.inf if value is None else value
    return out
