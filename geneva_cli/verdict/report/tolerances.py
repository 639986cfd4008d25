"""Effects of the deviations in ``[tolerance]`` on the wheel's place, play and entry."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.spec.tables import Tolerance
from geneva_cli.verdict.quantities.groups import own_names

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values

SAMPLES = 65536  # random machines


def tolerances(model: PartsModel) -> Values:
    """The first lines of ``geneva tolerance``, and its warnings; None without tolerances."""
    mechanism, names = model.mechanism, (*own_names("tolerance"), "tolerance.warnings")
    tolerance = mechanism.spec.tolerance
    if tolerance == Tolerance(distribution=tolerance.distribution):
        return dict.fromkeys(names)
    from geneva_cli.verdict.tolerance.tables import tolerance_table

    # micrometres need a radius
    L = mechanism.center_distance_mm
    answers = tolerance_table(mechanism, model, SAMPLES, 0, L).to_dict()
    return {name: answers[name.removeprefix("tolerance.")] for name in names}
