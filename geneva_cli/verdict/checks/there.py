"""Whether every part of a machine can be built: what cannot be drawn, fails."""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.parts.built import built
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.sphere.built import built as built_ball
from geneva_cli.parts.sphere.shells import Shells
from geneva_cli.verdict.checks.check import Check, refused


def plates(name: str, found: Outlines) -> Check | None:
    """The check that fails where a plate of a flat machine cannot be built; else None."""
    try:
        built(found, fitted=False)
    except GenevaError as error:
        return refused(name, error)
    return None


def solids(name: str, found: Shells) -> Check | None:
    """The check that fails where a solid of a spherical machine cannot be built; else None."""
    try:
        built_ball(found)
    except GenevaError as error:
        return refused(name, error)
    return None
