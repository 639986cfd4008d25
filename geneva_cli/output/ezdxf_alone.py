"""The parts of ezdxf that are needed, imported without reading settings or writing caches.

On import it reads ``ezdxf.ini`` from the current folder and the user's, whatever they hold, and
searches the system's fonts to write a cache of them into the user's home. Drawings here need no
settings and no widths of texts, so an empty cache lies in the folder of this file.
"""

import os
from configparser import ConfigParser

__all__ = ["BaseLayout", "ConstructionEllipse", "Document", "Modelspace", "options", "readfile"]

CACHE = "XDG_CACHE_HOME"
read, environment = ConfigParser.read, dict(os.environ)
setattr(ConfigParser, "read", lambda *arguments, **settings: [])  # noqa: B010  # for mypy
os.environ[CACHE] = os.path.join(os.path.dirname(os.path.abspath(__file__)), "no_fonts")
try:
    from ezdxf._options import options
    from ezdxf.document import Drawing as Document
    from ezdxf.filemanagement import readfile
    from ezdxf.layouts.base import BaseLayout
    from ezdxf.layouts.layout import Modelspace
    from ezdxf.math import ConstructionEllipse
finally:
    setattr(ConfigParser, "read", read)  # noqa: B010
    del os.environ[CACHE]
    os.environ.update(environment)
