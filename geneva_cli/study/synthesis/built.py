"""Sizes with which the parts of a chosen machine pass every check, by turning them."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.verdict.checks import checks

SHAFT = {"crank_shaft_mm", "crank_hub_mm"}  # what a crank without a shaft through the wheel passes


class Built(NamedTuple):
    """A spec, and what is the matter with its parts, empty where nothing is."""

    spec: Spec
    trouble: str


def built(spec: Spec) -> Built:
    """The spec turned through a whole turn; without the crank's bore where only that is in the way.

    Takes some seconds.
    """
    failing = _failing(spec)
    if failing and failing <= SHAFT:
        overhung = spec.with_("size.crank_bore_mm", 0.0)
        if not _failing(overhung):
            return Built(overhung, "")
    return Built(spec, f"`geneva check` fails: {', '.join(sorted(failing))}" if failing else "")


def _failing(spec: Spec) -> set[str]:
    return {check.name for check in checks(build(spec)) if check.passes is False}
