"""A machine to start from, which each kind of drive and wheel brings."""

from __future__ import annotations

from typing import NamedTuple


class Example(NamedTuple):
    """A machine to start from: what it is, and the keys that it sets, table by table."""

    about: str
    tables: dict[str, dict[str, object]]
