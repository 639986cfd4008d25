"""Run mypy without a search for garbage, which takes a fifth of its time.

A run's syntax trees and types stay to its end, so the search finds next to nothing. A plugin is the
one place from which its threshold can be set: mypy sets it first, and then loads the plugins.
"""

import gc

from mypy.plugin import Plugin


def plugin(version: str) -> type[Plugin]:
    """Return mypy's plugin without a hook, and look for garbage no more."""
    gc.set_threshold(0)
    return Plugin
