"""Many designs of one engagement in groups that are worked out together."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geneva_cli.analysis.loads.loaded_many import Machine, count
from geneva_cli.machine.many import taken

if TYPE_CHECKING:
    from geneva_cli.machine.spec import Spec

GROUP = 4096  # designs whose stretches are found together


def is_analytic(spec: Spec) -> bool:
    """Whether loads are analytic within their stretches: points have knots."""
    return spec.drive.ANALYTIC and (spec.motion is None or spec.motion.law.ANALYTIC)


def groups(every: Machine) -> Iterator[tuple[Machine, int]]:
    """The designs in groups, and how many each has."""
    m = count(every)
    for i in range(0, m, GROUP):
        yield taken(every, slice(i, i + GROUP)), min(GROUP, m - i)
