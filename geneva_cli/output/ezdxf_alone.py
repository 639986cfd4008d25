"""The parts of ezdxf that are needed, imported without reading settings or writing caches.

On import it reads ``ezdxf.ini`` from the current folder and the user's, whatever they hold, and
searches the system's fonts to write a cache of them into the user's home. Drawings here need no
settings and no widths of texts, so an empty cache lies in the folder of this file.

It also imports pyparsing, for queries of a document, and fontTools, for widths of texts. They take
as long as the rest of ezdxf, and no drawing here needs them. So they are imported on first use.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from configparser import ConfigParser
from contextlib import contextmanager
from types import ModuleType
from typing import Any

__all__ = ["BaseLayout", "Document", "Modelspace", "options"]


@contextmanager
def _alone() -> Iterator[None]:
    cache = "XDG_CACHE_HOME"
    read, folder = ConfigParser.read, os.environ.get(cache)
    setattr(ConfigParser, "read", _read_nothing)  # noqa: B010  # mypy lets no method be assigned
    os.environ[cache] = os.path.join(os.path.dirname(os.path.abspath(__file__)), "no_fonts")
    try:
        yield
    finally:
        setattr(ConfigParser, "read", read)  # noqa: B010
        if folder is None:
            del os.environ[cache]
        else:
            os.environ[cache] = folder


class _LateParser:
    """The parser of ezdxf's queries, imported at its first use."""

    def parse_string(self, *arguments: Any, **settings: Any) -> Any:
        """Parse a query."""
        from ezdxf.queryparser import EntityQueryParser

        return EntityQueryParser.parse_string(*arguments, **settings)


def _late_font(*arguments: Any, **settings: Any) -> Any:
    """A font, whose reader is imported at its first use."""
    from fontTools.ttLib import TTFont

    return TTFont(*arguments, **settings)


@contextmanager
def _without_late() -> Iterator[None]:
    """Context in which ezdxf imports neither a parser nor fonts, unless they are there already."""
    late: dict[str, dict[str, object]] = {
        "pyparsing": {"ParseException": Exception},
        "ezdxf.queryparser": {"EntityQueryParser": _LateParser()},
        "fontTools": {},
        "fontTools.ttLib": {"TTFont": _late_font, "TTLibError": Exception},
    }
    if {"ezdxf", "pyparsing", "fontTools"} & sys.modules.keys():
        late = {}
    for name, values in late.items():
        sys.modules[name] = ModuleType(name)
        vars(sys.modules[name]).update(values)
    try:
        yield
    finally:
        for name in late:
            del sys.modules[name]


def _read_nothing(self: ConfigParser, *arguments: Any, **settings: Any) -> list[str]:
    return []


with _alone(), _without_late():
    from ezdxf._options import options
    from ezdxf.document import Drawing as Document
    from ezdxf.layouts.base import BaseLayout
    from ezdxf.layouts.layout import Modelspace
