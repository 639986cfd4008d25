"""What a first wheel before the crank refuses."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.drives.refuses import of_transmission, several_rollers
from geneva_cli.motion.compatible import Conflict
from geneva_cli.motion.machine_spec import Spec


def refuses(spec: Spec) -> Iterator[Conflict]:
    """Rules of a second crank, which has one roller."""
    yield from several_rollers(spec)
    yield from of_transmission(spec)
