"""The parts of ezdxf that are needed, imported without reading settings or writing caches.

On import it reads ``ezdxf.ini`` from the current folder and the user's, whatever they hold, and
searches the system's fonts to write a cache of them into the user's home. Drawings here need no
settings and no widths of texts, so an empty cache lies in the folder of this file.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from configparser import ConfigParser
from contextlib import contextmanager

__all__ = ["BaseLayout", "Document", "Modelspace", "options", "readfile"]


@contextmanager
def _alone() -> Iterator[None]:
    cache = "XDG_CACHE_HOME"
    read, folder = ConfigParser.read, os.environ.get(cache)
    setattr(ConfigParser, "read", lambda *arguments, **settings: [])  # noqa: B010  # for mypy
    os.environ[cache] = os.path.join(os.path.dirname(os.path.abspath(__file__)), "no_fonts")
    try:
        yield
    finally:
        setattr(ConfigParser, "read", read)  # noqa: B010
        if folder is None:
            del os.environ[cache]
        else:
            os.environ[cache] = folder


with _alone():
    from ezdxf._options import options
    from ezdxf.document import Drawing as Document
    from ezdxf.filemanagement import readfile
    from ezdxf.layouts.base import BaseLayout
    from ezdxf.layouts.layout import Modelspace
