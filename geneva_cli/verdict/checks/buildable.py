"""The checks that every part of a machine can be built."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError
from geneva_cli.outlines.outlines import Outlines
from geneva_cli.parts.flat_parts import flat_parts
from geneva_cli.verdict.checks.check import Check, refused

if TYPE_CHECKING:
    from geneva_cli.parts.sphere.shells import Shells


def plates(name: str, outlines: Outlines) -> Check | None:
    """The check that fails if a plate of a flat machine cannot be built; else None."""
    return _refusal(name, lambda: flat_parts(outlines).require())


def solids(name: str, shells: Shells) -> Check | None:
    """The check that fails if a solid of a spherical machine cannot be built; else None."""
    from geneva_cli.parts.sphere.sphere_parts import SphereParts  # only on a sphere

    return _refusal(name, lambda: SphereParts(shells).members)


def _refusal(name: str, build: Callable[[], object]) -> Check | None:
    try:
        build()
    except GenevaError as error:
        return refused(name, error)
    return None
