"""What a list names as ``module:name``, loaded when it is asked for: so a list imports nothing."""

from __future__ import annotations

import importlib
from typing import Any


def named(path: str) -> Any:
    """A class or function of this package.

    >>> named("machine.drives.cam:Cam").NAME
    'cam'
    """
    module, _, name = path.partition(":")
    return vars(importlib.import_module(f"geneva_cli.{module}"))[name]
