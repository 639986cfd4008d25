"""Type of the values that a section of a report returns."""

from __future__ import annotations

from typing import TypeAlias

from geneva_cli.table import Table

Numbers: TypeAlias = dict[str, float | None]
# Named values; None is one that does not apply. The names are the same for every machine.
Values: TypeAlias = dict[str, float | str | tuple[str | float, ...] | Table | None]
