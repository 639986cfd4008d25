"""Importing by name, so that a list of names can stand without importing what it lists."""

from __future__ import annotations

import importlib
from typing import Any


def load_named(path: str) -> Any:
    """The class or function that ``module:name`` means in this package.

    >>> load_named("machine.drives.cam:Cam").NAME
    'cam'
    """
    module, _, name = path.partition(":")
    return vars(importlib.import_module(f"geneva_cli.{module}"))[name]
