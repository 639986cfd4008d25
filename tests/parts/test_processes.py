"""Clearances by the way in which parts are made."""

import math

import pytest
from repo import DESIGNS
from typer.testing import CliRunner

from geneva_cli import Design, External, Size
from geneva_cli.app import app
from geneva_cli.errors import GenevaError
from geneva_cli.layout.assembly import assembly
from geneva_cli.layout.sizes import sizes
from geneva_cli.machine.mechanism import build
from geneva_cli.spec.processes import PROCESSES
from geneva_cli.verdict.report.inputs import inputs
from geneva_cli.verdict.report.sizes import sizes as report_sizes


def iso_286(low: float, high: float) -> tuple[float, float, float, float]:
    """IT6, IT7, IT8 and the deviation f of a range of sizes, um, by the standard's formulas."""
    D = math.sqrt(low * high)
    i = 0.45 * D ** (1.0 / 3.0) + 0.001 * D
    return 10.0 * i, 16.0 * i, 25.0 * i, 5.5 * D**0.41


def test_fits_of_a_mill_are_the_middle_of_the_standards() -> None:
    """ISO 286-1, annex: i = 0.45 D^(1/3) + 0.001 D, f = 5.5 D^0.41, p = IT7 and up to 5 um."""
    mill = PROCESSES["mill"]
    _, it7, it8, f = iso_286(10.0, 18.0)
    middle = 0.5 * (f + 0.5 * (it7 + it8))  # a side
    assert 1e3 * mill.slot_clearance_mm == pytest.approx(middle, abs=2.5)  # given to 5 um
    _, it7, it8, f = iso_286(50.0, 80.0)
    middle = 0.5 * (f + 0.5 * (it7 + it8))
    assert 1e3 * mill.lock_clearance_mm == pytest.approx(middle, abs=2.5)
    it6, it7, _, _ = iso_286(6.0, 10.0)
    least = it7 - 0.5 * it7 + 0.5 * it6  # p at its least
    assert least - 0.5 <= 1e3 * mill.press_fit_mm <= least + 5.0


@pytest.mark.parametrize("process", PROCESSES)
def test_a_process_is_its_keys(process: str) -> None:
    keys = PROCESSES[process]._asdict()
    source = keys.pop("source")
    named, spelled = Design(External(6), size=Size(process=process)), Size(**keys)
    assert named.spec.size.allowances[:3] == spelled.allowances[:3]
    where = assembly(named.mechanism)
    assert sizes(where) == sizes(assembly(Design(External(6), size=spelled).mechanism))
    page = report_sizes(named.parts_model) | inputs(named.parts_model)
    assert page["sizes.clearances_from"] == source
    assert {key: page[f"inputs.size.{key}"] for key in keys} == keys


def test_a_key_that_is_given_wins() -> None:
    size = Size(process="print", slot_clearance_mm=0.0)
    assert size.allowances[:3] == (0.0, 0.25, 0.0)
    assert Size().allowances == (0.0, 0.0, 0.0, None)


def test_a_clearance_that_leaves_no_machine_says_whose_it_is() -> None:
    tiny = Size(process="laser", center_distance_mm=0.3)
    with pytest.raises(GenevaError, match=r"slot_clearance_mm = 0.2: .*; the value comes from"):
        build(Design(External(6), size=tiny).spec)


def test_the_option_sets_the_key() -> None:
    def written(*options: str) -> str:
        spec = str(DESIGNS / "turret.toml")
        run = CliRunner().invoke(app, ["profile", spec, "--samples", "9", *options])
        assert run.exit_code == 0, run.stderr
        return run.stdout

    keys = PROCESSES["laser"]
    spelled = written("--set", f"size.slot_clearance_mm={keys.slot_clearance_mm}")
    assert written("--set", "size.process=laser") == spelled != written()
    wrong = CliRunner().invoke(
        app, ["check", str(DESIGNS / "turret.toml"), "--set", "size.process=lasr"]
    )
    assert wrong.exit_code == 2
    assert '(did you mean "laser"?)' in wrong.stderr
