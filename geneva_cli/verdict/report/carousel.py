"""Wheels on a carrier: the space that they take, and when each of them moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError
from geneva_cli.table import rows_table
from geneva_cli.verdict.checks.carrier import reach_mm

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def envelope(model: PartsModel) -> Values:
    """Radius about the fixed axis that the wheels sweep; None without a carrier or parts."""
    values: Values = {"carousel.envelope_mm": None}
    spec = model.mechanism.spec
    if not (spec.drive.wheels_on_carrier and spec.is_flat):
        return values
    try:
        outlines = model.outlines
    except GenevaError:  # ``parts.none`` gives the reason
        return values
    return {"carousel.envelope_mm": model.mechanism.center_distance_mm + reach_mm(outlines)}


def wheels(model: PartsModel) -> Values:
    """A row for each of several wheels: where it stands, and when it moves.

    Angles are those of the carrier from the middle of the first wheel's motion.
    """
    mechanism = model.mechanism
    places = mechanism.wheel_places
    if len(places) < 2:
        return {"wheels": None}
    (one,) = mechanism.engagements  # one finger, which all wheels meet alike
    names = ("wheel", "behind_deg", "entry_deg", "exit_deg", "entry_s")
    rows = []
    for place in places:
        behind = place.behind_deg
        after_s = behind / (6.0 * mechanism.spec.drive.n_rpm)  # n rpm is 6 n degrees a second
        rows.append((place.number, behind, behind + one.entry_deg, behind + one.exit_deg, after_s))
    return {"wheels": rows_table(names, rows)}
