"""What may be added costs one class or function and one line in a registry: each is added here, as
its own file would, and every command that should know it then does.

Only a drive, a wheel or a law that a program imports from ``geneva_cli`` takes one line more, for
type checkers.
"""

import json
import sys
from collections.abc import Callable, Collection, Iterator
from pathlib import Path
from typing import Annotated, Any, ClassVar

import pytest
from strength_checks import judged
from typer.testing import CliRunner
from words import Spec, Wheel

from geneva_cli.cli.app import app
from geneva_cli.motion import registry
from geneva_cli.motion.laws.law import Law, from_velocity
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.spec.rules import Range
from geneva_cli.specfile import template
from geneva_cli.verdict import checks
from geneva_cli.verdict.advice import NONE
from geneva_cli.verdict.checks import Check, compared, single_check
from geneva_cli.verdict.quantities import groups
from geneva_cli.verdict.quantities.batch_designs import Columns, Designs

Add = Callable[..., None]


@pytest.fixture
def add(monkeypatch: pytest.MonkeyPatch) -> Add:
    """A function that adds a line to a registry; the line's module is this file."""

    def line(to: dict[str, Any], name: str, line: Any, room: str) -> None:
        monkeypatch.setitem(sys.modules, f"geneva_cli.{room}.added", sys.modules[__name__])
        monkeypatch.setitem(to, name, line)
        if to in (registry.DRIVES, registry.GEARINGS):  # as it is where the line was read first
            monkeypatch.setattr(template, "KINDS", (*template.KINDS, name))

    return line


@pytest.fixture
def run(tmp_path: Path) -> Callable[..., Any]:
    """A function that runs a command on the text of a spec, and gives what it prints, from json."""

    def ask(command: str, spec: str, *options: str) -> Any:
        file = tmp_path / "spec.toml"
        file.write_text(spec, encoding="utf-8")
        format = () if "--format" in options else ("--format", "json")
        shown = CliRunner().invoke(app, [command, str(file), *options, *format])
        assert shown.exit_code == 0, shown.stderr
        return shown.stdout if options else json.loads(shown.stdout)

    return ask


def new(kind: str) -> str:
    """What ``geneva new`` prints."""
    shown = CliRunner().invoke(app, ["new", kind, "--all"])
    assert shown.exit_code == 0, shown.stderr
    return shown.stdout


class Flattened(Law):
    """ds/du as (u (1 - u))^n, n a number of the user's."""

    NAME: ClassVar[str] = "flattened"
    ABOUT: ClassVar[str] = "a bell, as flat at its ends as is asked for"
    n: Annotated[int, Range(2, 3), "flattened: the power"]

    def first(self, u: Number, order: int) -> Jet:
        """The share: of n = 2 the polynomial 3-4-5, of 3 the polynomial 4-5-6-7."""
        n = self.n
        scale = 30.0 if n == 2 else 140.0

        def share(u: Number) -> Number:
            if n == 2:
                return u * u * u * (10.0 - 15.0 * u + 6.0 * u * u)
            return u**4 * (35.0 - 84.0 * u + 70.0 * u * u - 20.0 * u**3)

        def velocity(x: Jet) -> Jet:
            bell = x * (1.0 - x)
            return (bell * bell if n == 2 else bell * bell * bell) * scale

        return from_velocity(u, order, share, velocity)


def test_a_law_with_a_parameter(add: Add, run: Callable[..., Any]) -> None:
    add(registry.LAWS, "flattened", "motion.laws.added:Flattened", "motion.laws")
    wheel = "[wheel]\nz = 6\n[motion]\n"
    for n, same in ((2, "3-4-5"), (3, "4-5-6-7")):
        found = run("peaks", f'{wheel}law = "flattened"\nn = {n}\n')
        known = run("peaks", f'{wheel}law = "{same}"\n')
        for quantity in ("velocity", "acceleration"):
            assert found[quantity]["max"] == pytest.approx(known[quantity]["max"], rel=1e-12)
    assert "# n = ...  # flattened: the power" in new("curved")
    laws = json.loads(CliRunner().invoke(app, ["laws", "--format", "json"]).stdout)["rows"]
    assert "flattened" in {row["law"] for row in laws}


def slots(names: Collection[str], mechanism: Mechanism) -> Iterator[Check]:
    """A check."""
    yield compared("slots", float(mechanism.spec.wheel.z), "at least", 5.0)


def test_a_check(add: Add, run: Callable[..., Any]) -> None:
    """It is shown in its place, asked for by name, and advised on, for being in the list."""
    add(checks.MOTION, "slots", "verdict.checks.added:slots", "verdict.checks")
    rows = run("check", "[wheel]\nz = 6\n")["rows"]
    names = [row["check"] for row in rows]
    assert [row["limit"] for row in rows if row["check"] == "slots"] == [5.0]
    assert names.index("dwell_deg") < names.index("slots") < names.index("horn_mm")
    machine = build(Spec(Wheel(4)))
    assert single_check(machine, "slots") == compared("slots", 4.0, "at least", 5.0)
    (slotted,) = [c for c in judged(machine, parts=False) if c.name == "slots"]
    assert slotted.nearest == "" and slotted.why == NONE


def counted(of: Designs) -> Columns:
    """A group of quantities."""
    return {"count": of.spec.wheel.z}


def test_a_group_of_the_report(
    add: Add, run: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    add({}, "", "", "verdict.quantities")
    line = groups.QuantityGroup("slots", ("count",), batch="verdict.quantities.added:counted")
    monkeypatch.setattr("geneva_cli.verdict.report.REPORT", (line, *groups.REPORT))
    shown = run("report", "[wheel]\nz = 6\n")
    assert shown["slots"] == {"count": 6}
    assert list(shown).index("slots") < list(shown).index("inputs")
