"""Life of designs: the roller as a bearing, the slot's walls, and the stresses that wear them."""

from __future__ import annotations

import numpy as np

from geneva_cli.loads.strength import roller
from geneva_cli.loads.strength.roller import wears_mm
from geneva_cli.numerics.arrays import Number
from geneva_cli.verdict.quantities.batch_designs import Columns, Designs
from geneva_cli.verdict.quantities.part_strength import horn, pin
from geneva_cli.verdict.quantities.under_load import under_load


def pressure_speed(of: Designs) -> Columns:
    """The greatest contact pressure times sliding speed; it needs a face width."""
    return {} if of.spec.size.face_width_mm is None else {"pv_max_W_m2": under_load(of).pv_W_m2}


def bending(of: Designs) -> Columns:
    """The stresses of pin and horn."""
    parts = {"pin_stress_MPa": pin, "horn_stress_MPa": horn}
    return {name: of.once(part).get("stress_MPa") for name, part in parts.items()}


def wear(of: Designs) -> Columns:
    """The roller as a bearing, the work of friction, and the slot's walls."""
    friction = np.ravel(of.load_case.friction)
    passages = roller.passages(of.machine)
    paired = any(one.paired for one in of.machine.engagements)
    # an engagement has two of its own if one roller starts and one stops it
    by_roller = roller.by_roller(of.machine) if paired else passages
    lasts = roller.lives(of.machine, by_roller)
    force = np.ravel(lasts.equivalent_force_N)
    with np.errstate(invalid="ignore"):  # without friction, of a force without a bound
        work = friction * sum(passage.work for passage in passages) / len(passages)
    under: dict[str, Number | None] = {
        "roller_turns_per_motion": lasts.turns_per_motion,
        "equivalent_force_N": force,
        "friction_work_J": np.where(friction > 0.0, work, np.inf),
        "roller_life_turns": lasts.turns,
        "roller_life_motions": lasts.motions,
        "roller_life_h": lasts.hours,
        # a roller that turns on its pin does not rub in the slot
        "slot_wear_mm_per_million": (
            wears_mm(of.machine, [passage.rubbing_N for passage in passages])
            if of.spec.load.rubs_in_slot
            else None
        ),
    }
    bound = np.where(np.isfinite(force), of.loaded, np.inf * of.loaded)
    out: dict[str, Number | None] = {
        name: np.where(np.isfinite(bound), value, bound)
        for name, value in under.items()
        if value is not None
    }
    return out | {"slot_travel_m": sum(passage.travel_m for passage in passages) / len(passages)}
