"""The example spec that each kind of drive and wheel brings, for ``geneva new``."""

from __future__ import annotations

from typing import NamedTuple


class Example(NamedTuple):
    """An example: its title, and the keys that it sets, table by table."""

    about: str
    tables: dict[str, dict[str, object]]
