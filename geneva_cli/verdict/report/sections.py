"""The list of a report's sections, in the order shown; each is imported when it is made.

A new section is one file, or a function in a file, and one line here. The line also says whether
the section makes the machine's parts or turns them, which may take seconds.
"""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.parts.proof import Proof
from geneva_cli.spec.load_named import load_named
from geneva_cli.verdict.report.values import Values


class Section(NamedTuple):
    """A section: the function that gives it, as module:function, and whether that makes parts."""

    by: str
    makes_parts: bool = False

    def values(self, proof: Proof) -> Values:
        """Its values by their names."""
        found: Values = load_named(self.by)(proof)
        return found


SECTIONS = (
    Section("verdict.report.inputs:inputs"),
    Section("verdict.report.stations:stations"),
    Section("verdict.report.loads:greatest_loads"),
    Section("verdict.report.cycle:cycle"),
    Section("verdict.report.shocks:shocks"),
    Section("verdict.report.slot:slot"),
    Section("verdict.report.vibration:vibration"),
    Section("verdict.report.sizes:sizes"),
    Section("verdict.report.parts:parts", makes_parts=True),
    Section("verdict.report.parts_list:parts_list_tables", makes_parts=True),
    Section("verdict.report.tolerances:tolerances", makes_parts=True),
    Section("verdict.report.strength:strength_values"),
)
