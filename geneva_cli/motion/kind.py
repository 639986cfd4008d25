"""The records of kinds of machines and of extras: things by name, as ``module:name``."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

_NONE: Mapping[str, str] = MappingProxyType({})


class Kind(NamedTuple):
    """One kind: a wheel, a drive, or an addition to one of them."""

    name: str  # as in the spec
    wheel: str = ""  # class, whose fields are keys of [wheel]
    drive: str = ""  # class, whose fields are keys of [drive]
    # other words for it, where the nearest name by its letters would be another one
    synonyms: tuple[str, ...] = ()
    adds_to: str = ""  # name of the kind to which it adds, where it is neither wheel nor drive
    gearings: tuple[str, ...] = ()  # kinds of wheels that a drive can drive; empty for any
    refuses: str = ""  # rules of what makes no machine with it
    # keys of other tables, as in "load.mass_kg", that it alone has: its rules apply if one is set
    keys: tuple[str, ...] = ()
    parts: str = ""  # class of the parts of wheel and crank
    no_parts: str = ""  # function that returns the reason why a spec has no parts, or ""
    front: str = ""  # class of links and gears in front of a crank that is not flat
    # modules that draw a part, or a sheet, by its name: the function is named as the part
    drawings: Mapping[str, str] = _NONE
    tables: Mapping[str, str] = _NONE  # of points, by the names of the parts
    dimensions: str = ""  # in the list of parts, of these parts
    # function that returns the ``KeySizes`` of a mechanism, where its parts are not flat
    sizes: str = ""
    details: str = ""  # function of a mechanism that returns sizes of its parts' details
    stressed: str = ""  # dimensions of stressed parts, where no layout of flat parts has them
    wheel_body: str = ""  # function that returns mass and inertia of a mechanism's wheel
    checks: str = ""  # that it has or adds, of the motion and of parts at rest: rows of ``verdict``
    load_case: str = ""  # function that completes the load case of a mechanism
    # of the report, by the tables behind which they are shown: rows of ``verdict.quantities``
    quantities: Mapping[str, str] = _NONE
    # sizes of a mechanism's horns: half the slot's width, the recess (0 without a lock), and more
    horn_sizes: str = ""
    horns: str = ""  # function of a mechanism and them that returns horns of another shape
    locks: str = ""  # function of parts and tolerances: the locks as cut, and what they need
    # functions that return families of synth, by where they are searched: those of a "wheel" alone,
    # beside "straight" slots of any wheel, "alone", or where wheels on a "carrier" are required
    families: Mapping[str, str] = _NONE
    roller: str = ""  # function that returns the roller that suits a mechanism, for synth
    scene: str = ""  # class of what a page shows of the wheels
