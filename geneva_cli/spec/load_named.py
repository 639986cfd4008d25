"""Import by name, so that a list of names does not import what it lists."""

from __future__ import annotations

import importlib
from typing import Any

from geneva_cli.errors import GenevaError
from geneva_cli.extras import FOLDERS


def load_named(path: str) -> Any:
    """Class or function that ``module:name`` names in this package.

    >>> load_named("drives.cam:Cam").NAME
    'cam'
    """
    module, _, name = path.partition(":")
    return vars(importlib.import_module(f"geneva_cli.{module}"))[name]


def load_extra(folder: str, answer: str) -> Any:
    """Function of a folder of ``extras`` for an answer. Raises GenevaError without the folder.

    >>> load_extra("servo", "cam").__name__
    'cam'
    >>> load_extra("laser", "cut")
    Traceback (most recent call last):
    geneva_cli.errors.GenevaError: not computed: needs extras/laser, which is not installed
    """
    if folder not in FOLDERS:
        raise GenevaError(f"not computed: needs extras/{folder}, which is not installed")
    return load_named(load_named(f"extras.{folder}:EXTRA").answers[answer])
