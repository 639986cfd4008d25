"""A machine from synthesis as a spec file: the requirement, the machine and its costs."""

from __future__ import annotations

from geneva_cli.errors import GenevaError, cut
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.synth.built import built
from geneva_cli.study.synth.rows import MachineRow
from geneva_cli.study.synth.search import TURNED, Ranking
from geneva_cli.study.synth.table import fixed, other, with_result
from geneva_cli.study.target import Target


def chosen(
    ranking: Ranking, number: int, buildable: bool = False, count: int = TURNED
) -> tuple[MachineRow, str]:
    """Row ``number``, and the text of its spec with comments, as ``turned`` shows it.

    The parts are turned through a whole turn, unless they are known to be impossible. A row that
    ``turned`` shows without turning it keeps its numbers, even if its parts fail. Raises
    GenevaError if there is no such row.
    """
    if not 1 <= number <= len(ranking.rows):
        raise GenevaError(f"--write {cut(number)}: the table has rows 1 to {len(ranking.rows)}")
    row = ranking.rows[number - 1]
    if not row.is_impossible:
        row = with_result(row, built(row.spec, fixed(ranking.target)))
    if row.is_impossible and (buildable or (row.is_replacement and number <= count)):
        row = other(ranking, row) or row
    return row, commented(ranking.target, number, row)


def commented(target: Target, number: int, machine: MachineRow) -> str:
    """The text of a spec from synthesis, with comments."""
    return "\n".join([*_heading(target, number, machine), *spec_lines(machine.spec)]) + "\n"


def _heading(target: Target, number: int, machine: MachineRow) -> list[str]:
    row = machine.candidate
    z = f"{row.z} slots, {row.gearing}"
    slots = f"{row.drive}, {row.law}" if row.law else row.drive
    names = ("velocity_max", "acceleration_max", "acceleration_entry", "jerk_max", "power_max")
    costs = [f"{name} {getattr(row, name):.7g}" for name in names]
    lines = [
        f"title = {quoted(f'{target.words}: {z}, {slots}')}",
        "",
        f"# Row {number} of `geneva synth`. It moves for {row.motion_deg:.7g} deg of the input and",
        f"# rests for {row.dwell_deg:.7g}: tau = {row.tau:.7g}, k = {row.k:.7g}.",
        f"# Invariants: {', '.join(costs[:3])},",
        f"# {', '.join(costs[3:])}.",
    ]
    if machine.trouble:
        lines.append(f"# Warning: its parts cannot be built: {machine.trouble}.")
    return lines
