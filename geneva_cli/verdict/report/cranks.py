"""Several cranks about one wheel: where each stands, when it moves the wheel, by which slot."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.table import rows_table

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def cranks(model: PartsModel) -> Values:
    """A row for each of several cranks; None for a single one.

    Input angles are from the middle of the first crank's motion. Slots count counterclockwise from
    that which the first crank then enters. In step n a crank enters slot k - n from place k.
    """
    mechanism = model.mechanism
    places = mechanism.crank_places
    if len(places) < 2:
        return {"cranks": None}
    spec = mechanism.spec
    each = mechanism.engagements  # one of each crank, if they differ
    every = math.gcd(len(places), spec.wheel.z)
    names = ("crank", "place_deg", "behind_deg", "entry_deg", "exit_deg", "entry_s", "slot")
    rows = []
    for k, (place, step) in enumerate(zip(places, spec.drive.cranks, strict=True)):
        number, i = divmod(k, len(each))
        one = each[i]
        behind = number * mechanism.period_deg + one.mid_deg - each[0].mid_deg
        ends = behind + one.entry_deg, behind + one.exit_deg
        # n rpm is 6 n degrees a second
        after_s = (ends[0] - each[0].entry_deg) / (6.0 * spec.drive.n_rpm)
        slot = (int(step) - place.number + 1) % every
        place_deg = 360.0 * step / spec.wheel.z
        rows.append((place.number, place_deg, behind, *ends, after_s, slot, every))
    return {"cranks": rows_table((*names, "slot_every"), rows)}
