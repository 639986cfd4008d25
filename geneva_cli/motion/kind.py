"""The record of a kind of machine: what the program knows of it, by name.

Functions and classes are written ``module:name``, and imported at their first use. The core asks a
kind for a thing, such as its parts; it never asks which kind it has.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

_NONE: Mapping[str, str] = MappingProxyType({})


class Kind(NamedTuple):
    """One kind: a wheel, a drive, or an addition to one of them.

    >>> Kind("leaning", wheel="kinds.leaning.motion:Leaning").adds_to
    ''
    """

    name: str  # as in the spec
    wheel: str = ""  # class, whose fields are keys of [wheel]
    drive: str = ""  # class, whose fields are keys of [drive]
    adds_to: str = ""  # name of the kind to which it adds, where it is neither wheel nor drive
    parts: str = ""  # class of the parts of wheel and crank
    front: str = ""  # class of links and gears in front of a crank that is not flat
    drawings: Mapping[str, str] = _NONE  # or sheets, by the names of the parts that they show
    tables: Mapping[str, str] = _NONE  # of points, by the names of the parts
    dimensions: str = ""  # in the list of parts, of these parts
    stressed: str = ""  # dimensions of stressed parts, where no layout of flat parts has them
    wheel_body: str = ""  # mass and inertia of the wheel, where it is no plate
    motion_checks: Mapping[str, str] = _NONE  # by their names
    parts_checks: Mapping[str, str] = _NONE  # of parts at rest, all or those that it adds
