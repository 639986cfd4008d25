"""The parts that ``geneva profile`` writes: as tables of points, and as drawings to cut.

A new part is one function, one name here, and a line in the records of the kinds that have it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.kept import load_named
from geneva_cli.motion.compatible import is_geared
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import check_samples
from geneva_cli.motion.registry import of_wheel
from geneva_cli.spec.rules import Range, require_mm
from geneva_cli.table import Table

if TYPE_CHECKING:
    from geneva_cli.geometry.sheet import Drawing, Sheet
    from geneva_cli.parts.parts import Parts


PARTS = (
    *("slot", "wheel", "crank", "arm", "links", "first-wheel", "first-crank", "frame", "guide"),
    *("parts", "assembly", "gears", "groove", "groove-plate", "plate", "sheet"),
)
SHEET = "sheet"  # a drawing sheet with dimensions
TABLES = {"parts": "drawings.parts_list:parts_table"}  # of every machine, and no drawings
DRAWINGS = tuple(name for name in PARTS if name != SHEET and name not in TABLES)
# what is cut out of a plate
CUT = tuple(n for n in DRAWINGS if n not in ("slot", "assembly", "gears", "groove", "plate"))


def is_sheet(part: str) -> bool:
    """Return True if a part is drawn as a sheet. Raises GenevaError for an unknown part."""
    if part not in PARTS:
        raise GenevaError(
            f"--part {cut(part)}: it must be one of {few(part, PARTS)}{nearest(part, PARTS)}"
        )
    return part == SHEET


def table_of(mechanism: Mechanism, part: str, drawn: bool = False) -> str:
    """The function of a part's table, "" for a drawing; ``drawn`` is True for a drawing's format.

    Raises GenevaError for a part that is unknown, has no drawing, or that no machine with such a
    wheel has.
    """
    is_sheet(part)
    tables, drawings = dict(TABLES), dict[str, str]()
    for kind in of_wheel(mechanism.spec.wheel.NAME):
        tables |= kind.tables
        drawings |= kind.drawings
    known = [name for name in PARTS if name in tables or name in drawings]
    if part not in known:
        raise GenevaError(
            f"--part {part}: a machine of this kind has none; it may have {', '.join(known)}",
            ("wheel", "gearing"),
        )
    if drawn and part not in DRAWINGS:
        what = "a drawing sheet" if part == SHEET else "a table of points, for .csv or .json"
        raise GenevaError(f"--part {part} is {what}; these are drawings: {', '.join(DRAWINGS)}")
    return "" if drawn else tables.get(part, "")


def part_table(mechanism: Mechanism, part: str, tolerance_mm: float, samples: int | None) -> Table:
    """Return a part's points: for a chord tolerance, or at ``samples`` even input angles."""
    if samples is not None:
        check_samples(samples)
    function = table_of(mechanism, part)
    if not function:
        raise GenevaError(f"--part {part} is a drawing: write it as .dxf or .svg")
    require_tolerance(mechanism, tolerance_mm)
    table: Table = load_named(function)(mechanism, tolerance_mm, samples)
    return table


def require_tolerance(mechanism: Mechanism, tolerance_mm: float) -> None:
    """Raise GenevaError for a tolerance that is not above 0, or wider than half a slot."""
    allowed = Range(0.0, mechanism.roller_radius_mm, "(]")
    require_mm("--tolerance", tolerance_mm, allowed, "the roller's radius")


def parts_having(parts: Parts, part: str) -> Parts:
    """Return the parts of the machine that has a part: these, or those of the first wheel."""
    return parts.front if part.startswith("first-") else parts


def part_drawing(parts: Parts, part: str, tolerance_mm: float, curves: str) -> Drawing:
    """Return a part's drawing: lines and arcs, or with ``curves`` = "cubics" also cubics."""
    parts = parts_having(parts, part)
    table_of(parts.mechanism, part, drawn=True)
    drawing = cast("Drawing", _drawn(parts, part, tolerance_mm, curves))
    return drawing._replace(tolerance=tolerance_mm)


def part_sheet(parts: Parts, tolerance_mm: float, curves: str) -> Sheet:
    """Return all parts as a drawing sheet. Raises GenevaError for a machine without one."""
    if of := without_sheet(parts.mechanism):
        raise GenevaError(
            f"--part {SHEET}: no sheet for {of}: use -o FILE.step or a dxf of each part"
        )
    return cast("Sheet", _drawn(parts, SHEET, tolerance_mm, curves))


def without_sheet(mechanism: Mechanism) -> str:
    """What machines of this kind are called, if none has a drawing sheet; "" if they have."""
    wheel = mechanism.spec.wheel.NAME
    if not any(SHEET in kind.drawings for kind in of_wheel(wheel)):
        return f"{wheel} machines"
    if is_geared(mechanism.spec):
        return "machines with gears"
    return "machines with a groove" if mechanism.engagements[0].groove else ""


def _drawn(parts: Parts, part: str, tolerance_mm: float, curves: str) -> object:
    """Return what the record of the machine's kind draws of a part."""
    require_tolerance(parts.mechanism, tolerance_mm)
    kinds = of_wheel(parts.mechanism.spec.wheel.NAME)
    kind = next(kind for kind in reversed(kinds) if part in kind.drawings)
    name = part.removeprefix("first-").replace("-", "_")
    built = parts.built if kind.parts else parts.flat
    return load_named(f"{kind.drawings[part]}:{name}")(built.within(tolerance_mm, curves))


def require_cut(part: str, option: str = "--kerf") -> None:
    """Raise GenevaError, naming an option, for a part that is not cut out of a plate."""
    if part not in CUT:
        raise GenevaError(
            f"{option} applies only to parts that are cut out of a plate ({', '.join(CUT)}), not "
            f"to {cut(part)}"
        )
