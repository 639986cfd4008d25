"""Every place is an input angle from one zero, and an event has the same one in every command."""

from pathlib import Path
from typing import Any

import pytest
import repo
from load_states import greatest

from geneva_cli import Design, design
from geneva_cli.loads.load_case import sources
from geneva_cli.table import Table

pytestmark = pytest.mark.usefixtures("made_once", "read_once")
DESIGNS = sorted((repo.DESIGNS).glob("*.toml"))
LIMITED = ("pin_force_N", "input_torque_Nm", "contact_stress_MPa")


def angles(name: str, value: Any) -> list[tuple[str, float]]:
    """Every ``*at_deg`` in a table, and in the tables in it."""
    if isinstance(value, Table):
        return [
            pair
            for row in value.rows()
            for key, each in zip(value.names, row, strict=True)
            for pair in angles(f"{name}.{key}", each)
        ]
    return [(name, value)] if name.endswith("at_deg") and value is not None else []


def one_zero(found: Design) -> None:
    mechanism = found.mechanism
    first = mechanism.engagements[0]
    whole = 360.0 * mechanism.spec.drive.turns
    low = -180.0 if whole == 360.0 else first.mid_deg + first.entry_deg
    page, summary, rows = found.report.table, found.peaks_table, found.checks
    places = [*angles("report", page), *angles("peaks", summary)]
    places += [(c.name, c.at_deg) for c in rows if c.at_deg is not None]
    most = {q: greatest(mechanism, q) for q in LIMITED if q in sources(mechanism)}
    places += [(q, each.at_deg) for q, each in most.items()]
    assert len(places) > 8
    for name, at_deg in places:
        assert low <= at_deg <= low + whole, name
    told = dict(zip(page.names, next(page.rows()), strict=True))
    for name, value in zip(summary.names, next(summary.rows()), strict=True):
        if name.endswith(".at_deg"):
            assert told[name] == value, name
    each = {c.name: c.at_deg for c in rows}
    for q in most:
        shown = told[f"loads.{q}.at_deg"]
        assert shown in (None, pytest.approx(most[q].at_deg, abs=1e-12))
        limit = f"{q.rpartition('_')[0]}_max_{q.rpartition('_')[2]}"
        # a check searches sizes, loads both signs: their places differ by rounding, 1e-14 degrees
        assert each.get(limit) in (None, pytest.approx(most[q].at_deg, abs=1e-12))
    if told["parts.smallest_gap_at_deg"] is not None:
        gaps = [each[n] for n in ("gap_mm", "idle_roller_mm") if n in each]
        assert told["parts.smallest_gap_at_deg"] in gaps


@pytest.mark.sampled(48)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_designs_have_one_zero(path: Path) -> None:
    one_zero(design.load(str(path)))
