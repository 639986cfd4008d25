"""Quantities of a single design that its report leaves out."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from geneva_cli.verdict.both_directions import passes_both_ways, worst_checks
from geneva_cli.verdict.checks import Check, proofs
from geneva_cli.verdict.checks.all_checks import BEFORE_TURN, OF_TURN

if TYPE_CHECKING:
    from geneva_cli.parts.parts import Parts
    from geneva_cli.verdict.quantities.batch_designs import Values


def machine(parts: Parts) -> Values:
    """The kind of machine."""
    spec = parts.mechanism.spec
    return {
        "wheel.z": spec.wheel.z,
        "wheel.gearing": spec.wheel.NAME,
        "drive.kind": spec.drive.NAME,
        "drive.rollers": spec.drive.rollers,
        "drive.before.kind": spec.drive_before.NAME if spec.drive_before else None,
        "motion.law": spec.motion.law.NAME if spec.motion else None,
    }


def values_before_turn(parts: Parts) -> Values:
    """The value of each check but those of the turn."""
    return _values(BEFORE_TURN, worst_checks(parts.mechanism, parts, turned=False))


def check_values(parts: Parts) -> Values:
    """The value of each check of the turn, and whether all checks pass."""
    rows = worst_checks(parts.mechanism, parts)
    values = _values(OF_TURN, rows)
    failed = [c.name for c in rows if c.passes is False]
    return values | {"passes": not failed, "failed": " ".join(failed) or None}


def passes(parts: Parts) -> Values:
    """Whether all checks pass, computed until the first that fails."""
    return {"passes": passes_both_ways(parts)}


def _values(names: Sequence[str], rows: Sequence[Check]) -> Values:
    return {c.name: c.value for c in rows if c.name in names}


def proved(parts: Parts) -> Values:
    """The gap that is proved."""
    return {c.name: c.value for c in proofs(parts)}
