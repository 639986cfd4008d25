"""Short names of designs that are compared."""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence


def short_name(path: str, paths: Sequence[str], taken: Collection[str] = ()) -> str:
    """A file's name without folder and ending, if no other file shares it.

    >>> short_name("a/slow.toml", ["a/slow.toml", "b/quick.toml"])
    'slow'
    """
    stems = [os.path.splitext(os.path.basename(p))[0] for p in paths]
    stem = stems[list(paths).index(path)]
    return stem if stems.count(stem) == 1 and stem not in taken else path
