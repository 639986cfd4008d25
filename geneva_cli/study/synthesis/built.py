"""Sizes with which the parts of a chosen machine pass every check, by turning them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.parts.proof import Proof
from geneva_cli.study.synthesis.parts import USUAL, exact, with_roller
from geneva_cli.verdict.checks import checks
from geneva_cli.verdict.checks.registry import LIMITS, MOTION

SHAFT = {"crank_shaft_mm", "crank_hub_mm", "crank_bore_wall_mm"}  # what a crank's bore asks for
UNSIZED = {*MOTION, *LIMITS} - {"undercut_mm"}  # what no other roller helps
SMALLER = 3  # usual rollers below the first that are tried


class Built(NamedTuple):
    """A spec, and what is the matter with its parts in a few words, empty where nothing is."""

    spec: Spec
    trouble: str


def built(spec: Spec, fixed: frozenset[str] = frozenset()) -> Built:
    """The spec turned through a whole turn, with the first of some sizes that pass every check.

    ``fixed`` are keys of its [size] that must stay as they are. Takes some seconds. Where nothing
    passes, the spec as it was.
    """
    trouble = _failing(spec)
    if not trouble:
        return Built(spec, "")
    for other in _others(spec, set(trouble), fixed):
        if not _failing(other):
            return Built(other, "")
    return Built(spec, ", ".join(trouble))


def _others(spec: Spec, trouble: set[str], fixed: frozenset[str]) -> Iterator[Spec]:
    """The same machine with other sizes, the nearest first."""
    overhung = "crank_bore_mm" not in fixed and trouble & SHAFT
    if overhung:
        spec = spec.with_("size.crank_bore_mm", 0.0)
        yield spec
    if trouble <= SHAFT or trouble & UNSIZED or "roller_radius_mm" in fixed:
        return
    L = build(spec).center_distance_mm
    r = 100.0 * spec.roller_radius_mm(L) / L
    for percent in [p for p in USUAL if p < r * (1.0 - 1e-9)][:SMALLER]:
        yield with_roller(spec, exact(0.01 * percent * L))


def _failing(spec: Spec) -> list[str]:
    """The names of the checks that fail; for parts that cannot be made the key in the way."""
    machine = build(spec)
    before = [check.name for check in checks(machine, parts=False) if check.passes is False]
    if set(before) & UNSIZED:  # no need to turn them
        return before
    proof = Proof(machine)
    rows = [check.name for check in checks(machine, proof) if check.passes is False]
    try:
        _ = proof.found
    except GenevaError as error:
        key = str(error.key[-1]) if error.key else "outline"
        rows = [key if name == "parts" else name for name in rows]
    return rows
