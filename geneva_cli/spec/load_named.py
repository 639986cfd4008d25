"""Import by name, so that a list of names does not import what it lists."""

from __future__ import annotations

import importlib
from typing import Any


def load_named(path: str) -> Any:
    """Class or function that ``module:name`` names in this package.

    >>> load_named("drives.cam:Cam").NAME
    'cam'
    """
    module, _, name = path.partition(":")
    return vars(importlib.import_module(f"geneva_cli.{module}"))[name]
