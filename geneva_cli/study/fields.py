"""The quantities of a design by their names, as ``acceleration.max``: those of its report.

A section of the report is worked out only where one of its quantities is asked for.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple, TypeAlias

from geneva_cli.analysis.loads.cycle import cycle_of
from geneva_cli.analysis.loads.sizing import WHEEL, sizing
from geneva_cli.analysis.loads.summary import summaries
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.proof import Proof
from geneva_cli.study.quantity_names import section_of, whole_name
from geneva_cli.table import Table
from geneva_cli.verdict.checks import checks
from geneva_cli.verdict.checks.registry import every_check
from geneva_cli.verdict.report.sections import SECTIONS, Section
from geneva_cli.verdict.report.values import Values

Cell: TypeAlias = float | int | str | bool | None


def machine(proof: Proof) -> Values:
    """The kind of machine."""
    spec = proof.mechanism.spec
    return {
        "wheel.z": spec.wheel.z,
        "wheel.gearing": spec.wheel.NAME,
        "drive.kind": spec.drive.NAME,
        "drive.rollers": spec.drive.rollers,
        "motion.law": spec.motion.law.NAME if spec.motion else None,
    }


def judged(proof: Proof) -> Values:
    """The value of each check, None of those that do not apply, and whether all pass."""
    rows = checks(proof.mechanism, proof)
    values: Values = {f"checks.{name}": None for name in every_check()}
    values |= {f"checks.{c.name}": c.value for c in rows}
    failed = [c.name for c in rows if c.passes is False]
    return values | {"checks.passes": not failed, "checks.failed": " ".join(failed) or None}


def cycle(proof: Proof) -> Values:
    """Least values, means and root mean squares of the loads, which the report leaves out."""
    names = ("min", "min_at_deg", "mean", "rms")
    found = {load: one._asdict() for load, one in summaries(cycle_of(proof.mechanism)).items()}
    return {f"loads.{load}.{n}": one[n] for load, one in found.items() for n in names}


def bought(proof: Proof) -> Values:
    """Motor, flywheel and the makers' form; the wheel's own inertia is that of its parts."""
    found, _ = sizing(cycle_of(proof.mechanism))
    return {f"sizing.{name}": value for name, value in found.items() if name != WHEEL}


# The report's sections and those above. Those that make parts come last.
ALL = (
    Section("study.fields:machine"),
    *(s for s in SECTIONS if not s.makes_parts),
    Section("study.fields:cycle"),
    Section("study.fields:bought"),
    *(s for s in SECTIONS if s.makes_parts),
    Section("study.fields:judged", makes_parts=True),
)
SHOWN = (ALL[0], *(s for s in SECTIONS if not s.makes_parts))  # where nothing is picked


def values(proof: Proof, sections: Iterable[Section] = SHOWN) -> dict[str, Cell]:
    """The quantities of some sections, without tables and texts of several lines.

    What nothing bounds is None, as in the report's json.
    """
    out: dict[str, Cell] = {}
    for section in sections:
        for name, value in section.values(proof).items():
            if not isinstance(value, (tuple, Table)):
                endless = isinstance(value, float) and math.isinf(value)
                out[name] = None if endless else value
    return out


class Pick(NamedTuple):
    """Quantities to show, and the sections that contain them."""

    names: tuple[str, ...]
    sections: tuple[Section, ...]
    # the whole names in the order of the request, in which one may stand twice
    asked: tuple[str, ...] = ()

    def of(self, mechanism: Mechanism) -> list[Cell]:
        """The quantities' values for a machine; None where one does not apply."""
        found = values(Proof(mechanism), self.sections)
        return [found.get(name) for name in self.names]


def pick(
    asked: Sequence[str], option: str = "--pick", options: Mapping[str, str] | None = None
) -> Pick:
    """The quantities of these names, as ``whole_name`` resolves them.

    ``options`` says which option asked for a name, where it was not ``option``. Raises GenevaError,
    naming the option, for a name that is no quantity, or may be several.
    """
    by = dict.fromkeys(asked, option) | dict(options or {})
    names = {a: whole_name(a, by[a]) for a in asked}
    sections = {section.by: section for section in ALL}
    of = dict.fromkeys(sections[section_of()[name]] for name in names.values())
    return Pick(tuple(dict.fromkeys(names.values())), tuple(of), tuple(names[a] for a in asked))
