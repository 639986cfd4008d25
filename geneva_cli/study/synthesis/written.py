"""A machine from synthesis as a spec file: the requirement, the machine and its costs."""

from __future__ import annotations

from geneva_cli.errors import GenevaError, cut
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.synthesis.built import Built, built
from geneva_cli.study.synthesis.rows import Candidate
from geneva_cli.study.synthesis.search import FoundRows
from geneva_cli.study.synthesis.table import fixed, other, with_result
from geneva_cli.study.synthesis.target import Target

COSTS = ("velocity_max", "acceleration_max", "acceleration_entry", "jerk_max", "power_max")


def chosen(found: FoundRows, number: int, buildable: bool = False) -> tuple[Built, str]:
    """The spec of row ``number`` and its text with comments, as ``turned`` shows it.

    The parts are turned through a whole turn, unless they are known to be impossible. Raises
    GenevaError if there is no such row.
    """
    if not 1 <= number <= len(found.rows):
        raise GenevaError(f"--write {cut(number)}: the table has rows 1 to {len(found.rows)}")
    row = found.rows[number - 1]
    if not row.cannot_be:
        row = with_result(row, built(row.spec, fixed(found.target)))
    if row.cannot_be and (buildable or row.stands_in):
        row = other(found, row) or row
    made = Built(row.spec, row.trouble)
    return made, commented(found.target, number, row.candidate, made)


def commented(target: Target, number: int, row: Candidate, found: Built) -> str:
    """The text of a spec from synthesis, with comments."""
    return "\n".join([*_heading(target, number, row, found), *spec_lines(found.spec)]) + "\n"


def _heading(target: Target, number: int, row: Candidate, found: Built) -> list[str]:
    z = f"{row.z} slots, {row.gearing}"
    slots = f"{row.drive}, {row.law}" if row.law else row.drive
    lines = [
        f"title = {quoted(f'{target.words}: {z}, {slots}')}",
        "",
        f"# Row {number} of `geneva synth`. It moves for {row.motion_deg:.7g} deg of the input and",
        f"# rests for {row.dwell_deg:.7g}: tau = {row.tau:.7g}, k = {row.k:.7g}.",
        "# Invariants: " + ", ".join(f"{n} {getattr(row, n):.7g}" for n in COSTS[:3]) + ",",
        "# " + ", ".join(f"{n} {getattr(row, n):.7g}" for n in COSTS[3:]) + ".",
    ]
    if found.trouble:
        lines.append(f"# Warning: its parts cannot be built: {found.trouble}.")
    return lines
