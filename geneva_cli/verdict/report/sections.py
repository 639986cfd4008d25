"""The sections of a report, each loaded when it is asked for, in the order shown.

A new section is one file, or a function in a file, and one line here, which says too whether it
makes the parts of the machine, or turns them, which may take seconds: whoever wants only what is
quick leaves it out.
"""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.parts.proof import Proof
from geneva_cli.spec.named import named
from geneva_cli.verdict.report.values import Values


class Section(NamedTuple):
    """A part of the report: who gives it, as module:function, and whether that makes parts."""

    by: str
    makes_parts: bool = False

    def values(self, proof: Proof) -> Values:
        """Its values by their names."""
        found: Values = named(self.by)(proof)
        return found


SECTIONS = (
    Section("verdict.report.inputs:inputs"),
    Section("verdict.report.stations:stations"),
    Section("verdict.report.loads:greatest"),
    Section("verdict.report.cycle:cycle"),
    Section("verdict.report.shocks:shocks"),
    Section("verdict.report.slot:driven"),
    Section("verdict.report.vibration:vibration"),
    Section("verdict.report.sizes:sizes"),
    Section("verdict.report.parts:parts", makes_parts=True),
    Section("verdict.report.parts_list:listed", makes_parts=True),
    Section("verdict.report.tolerances:tolerances", makes_parts=True),
    Section("verdict.report.strength:strong"),
)
