"""The check of a rack's horns, which needs no parts: every machine's list of checks names it."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from geneva_cli.motion.mechanism import Mechanism
    from geneva_cli.verdict.checks import Check


def rack_horn(names: Collection[str], mechanism: Mechanism) -> Iterator[Check]:
    """The wall between slot and recess of a rack that is locked."""
    if mechanism.output.turns:
        return
    from geneva_cli.kinds.linear.rack import rack_sizes
    from geneva_cli.spec.defaults import wall_min
    from geneva_cli.verdict.checks import compared

    try:
        sizes = rack_sizes(mechanism)
    except GenevaError:
        return  # the check of the parts reports the error
    if sizes.lock:
        least = wall_min(mechanism.spec.size, mechanism.center_distance_mm)
        yield compared("rack_horn_mm", sizes.horn, "at least", least)
