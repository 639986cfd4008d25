"""The module behind a kind of drive, loaded when it is asked for."""

from __future__ import annotations

import importlib
from typing import Any

from geneva_cli.drives import KINDS


def module(kind: str) -> Any:
    """The module of a kind of drive."""
    return importlib.import_module(f"geneva_cli.drives.{KINDS[kind]}")


def own_path(kind: str) -> bool:
    """Whether the roller has a path of its own, and is not carried on the crank's circle."""
    return not hasattr(module(kind), "front")
