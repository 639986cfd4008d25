"""Quantities of many specs at once: those that one machine can be are computed as one array."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from geneva_cli.machine.many import many, may_vary
from geneva_cli.machine.spec import Spec
from geneva_cli.study.sweep.columns import columns

TABLES = ("wheel", "drive", "motion")  # in which the machines of a wish differ


def numbers(specs: Sequence[Spec], names: Sequence[str]) -> list[list[float] | None]:
    """The quantities ``names``, as ``columns`` knows them, of each spec.

    None for one that cannot be built, or whose engagements have not one number for all.
    """
    out: list[list[float] | None] = [None] * len(specs)
    apart: dict[Any, list[int]] = {}
    wide: list[dict[str, float]] = []
    may: dict[Any, bool] = {}
    for i, spec in enumerate(specs):
        shape, own = _split(spec, may)
        wide.append(own)
        apart.setdefault(shape, []).append(i)
    for members in apart.values():
        keys = wide[members[0]]
        varied = {k: np.array([wide[i][k] for i in members]) for k in keys}
        differing = {k: v for k, v in varied.items() if (v != v[0]).any()}
        found = many(specs[members[0]], differing or dict([*varied.items()][:1]))
        if found.machine is None:
            continue
        which = found.which
        values = columns(found.machine, names, len(which))
        if values is None:
            continue
        for i, row in zip(which.tolist(), np.column_stack(values).tolist(), strict=True):
            out[members[i]] = row
    return out


def _split(spec: Spec, may: dict[Any, bool]) -> tuple[Any, dict[str, float]]:
    """What a machine must share with others to be one array with them, and its own numbers.

    ``may`` is filled with which keys of a kind may be arrays.
    """
    kinds = (type(spec.wheel), type(spec.drive), spec.motion and spec.motion.law)
    shape: list[Any] = [kinds]
    own = {}
    for table in TABLES:
        for name, value in spec.table(table).items():
            key = f"{table}.{name}"
            number = isinstance(value, (int, float)) and not isinstance(value, bool)
            if number and (kinds, key) not in may:
                may[kinds, key] = may_vary(spec, key)
            if number and may[kinds, key]:
                own[key] = value
            else:
                shape.append((key, value))
    return tuple(shape), own
