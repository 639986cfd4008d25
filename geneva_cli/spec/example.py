"""The example spec of each kind of drive and wheel, for ``geneva new``."""

from __future__ import annotations

from typing import NamedTuple


class Example(NamedTuple):
    """An example spec: its title, and its keys by table."""

    about: str
    tables: dict[str, dict[str, object]]
