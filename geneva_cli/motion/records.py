"""The records of all kinds of wheels and drives, and what they name.

A new wheel or drive of the core is one file and one line here. A kind that only some users need is
a folder of ``kinds`` and a line there.
"""

from __future__ import annotations

from typing import Any

from geneva_cli.kinds import FOLDERS
from geneva_cli.motion.kind import Kind
from geneva_cli.spec.load_named import load_named

CRANK = "drives.crank:Crank"  # the drive of a spec without one
_CRANK, _PIN_PATH = "drives.refuses:of_transmission", "drives.refuses:of_pin_path"
# The kinds of the core; those in ``kinds`` follow.
_CORE = (
    Kind("external", wheel="motion.wheels.external:External", parts="drawings.model:Flat"),
    Kind("internal", wheel="motion.wheels.internal:Internal", parts="drawings.model:Flat"),
    Kind("spherical", wheel="motion.wheels.spherical:Spherical"),
    Kind("crank", drive=CRANK, refuses="drives.refuses:of_crank"),
    Kind("side-crank", drive="drives.side_crank:SideCrank", refuses=_CRANK),
    Kind("elliptical-gears", drive="drives.elliptical_gears:EllipticalGears", refuses=_CRANK),
    Kind(
        "noncircular-gears",
        drive="drives.noncircular_gears:NoncircularGears",
        refuses=_CRANK,
    ),
    Kind(
        "epicyclic",
        drive="drives.epicyclic:Epicyclic",
        gearings=("external",),
        refuses=_PIN_PATH,
    ),
    Kind(
        "cam",
        drive="drives.cam:Cam",
        gearings=("external", "internal"),
        refuses="drives.refuses:of_cam",
    ),
)
KINDS: tuple[Kind, ...] = (
    *_CORE,
    *(kind for folder in FOLDERS for kind in load_named(f"kinds.{folder}:KINDS")),
)
# function that puts a drive in front of another, which few machines need
IN_FRONT = "drives.retimed:retimed"


def of_wheel(name: str) -> list[Kind]:
    """The records of a kind of wheel: its own, then those that add to it.

    >>> [kind.name for kind in of_wheel("internal")]
    ['internal']
    """
    return [kind for kind in KINDS if name in (kind.adds_to, kind.name if kind.wheel else "")]


def thing(wheel: str, field: str) -> Any:
    """Function or class of a kind of wheel in a field of its record; None without one.

    That of a kind that adds to the wheel replaces the wheel's own.

    >>> thing("external", "load_case")
    """
    paths = [path for kind in of_wheel(wheel) if (path := kind._asdict()[field])]
    return load_named(paths[-1]) if paths else None


def families_of_kinds(where: str) -> list[Any]:
    """Functions that return families of synth, of the kinds that are searched there."""
    return [load_named(kind.families[where]) for kind in KINDS if where in kind.families]
