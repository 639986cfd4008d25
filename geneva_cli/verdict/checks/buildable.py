"""The checks that every part of a machine can be built."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check, refused

if TYPE_CHECKING:
    from geneva_cli.parts.counter_parts import CounterParts
    from geneva_cli.parts.rack_parts import RackParts
    from geneva_cli.parts.sphere.sphere_parts import SphereParts


def plates(name: str, parts: FlatParts | RackParts | CounterParts) -> Check | None:
    """The check that fails if a plate of a machine cannot be built; else None."""
    return _refusal(name, parts.require)


def solids(name: str, parts: SphereParts) -> Check | None:
    """The check that fails if a solid of a spherical machine cannot be built; else None."""
    return _refusal(name, lambda: parts.members)


def _refusal(name: str, build: Callable[[], object]) -> Check | None:
    try:
        build()
    except GenevaError as error:
        return refused(name, error)
    return None
