"""The parts of ezdxf that are needed, imported without reading settings or writing caches.

On import it reads ``ezdxf.ini`` from the current folder and the user's, whatever they hold, and
searches the system's fonts to write a cache of them into the user's home. Drawings here need no
settings and no widths of texts, so an empty cache lies in the folder of this file.

It also imports pyparsing, for queries of a document. That takes as long as the rest of ezdxf, and
no drawing here is queried. So the parser is imported when it is used.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from configparser import ConfigParser
from contextlib import contextmanager
from types import ModuleType
from typing import Any

__all__ = ["BaseLayout", "Document", "Modelspace", "earcut", "options"]


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


@contextmanager
def _without_parser() -> Iterator[None]:
    """Context in which ezdxf imports no parser, unless one is there already."""
    parser, errors = ModuleType("ezdxf.queryparser"), ModuleType("pyparsing")
    vars(parser)["EntityQueryParser"] = _LateParser()
    vars(errors)["ParseException"] = Exception
    late = [] if {"ezdxf", "pyparsing"} & sys.modules.keys() else [parser, errors]
    sys.modules.update({module.__name__: module for module in late})
    try:
        yield
    finally:
        for module in late:
            del sys.modules[module.__name__]


def _read_nothing(self: ConfigParser, *arguments: Any, **settings: Any) -> list[str]:
    return []


with _alone(), _without_parser():
    from ezdxf._options import options
    from ezdxf.document import Drawing as Document
    from ezdxf.layouts.base import BaseLayout
    from ezdxf.layouts.layout import Modelspace

    # in Python: the compiled one may round differently on another processor
    from ezdxf.math._mapbox_earcut import earcut
