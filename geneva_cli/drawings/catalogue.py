"""The parts that ``geneva profile`` writes: as tables of points, and as drawings to cut.

A new part is one function, and one line here. A drawing has a line in the records of the kinds that
have the part.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import of_wheel
from geneva_cli.spec.load_named import load_named
from geneva_cli.spec.rules import Range, require_mm
from geneva_cli.table import Table

if TYPE_CHECKING:
    from geneva_cli.geometry.sheet import Drawing, Sheet
    from geneva_cli.parts.parts import Parts


class Part(NamedTuple):
    """How a part is written; the records of the kinds have the functions that draw it."""

    cut: bool = False  # True if it is cut out of a plate
    in_front: bool = False  # True if it belongs to a first wheel, in front of the crank
    sheet: bool = False  # True if it is a drawing sheet with dimensions
    table: str = ""  # function of a table that every machine has and no drawing


PARTS = {
    "slot": Part(),
    "wheel": Part(cut=True),
    "crank": Part(cut=True),
    "arm": Part(cut=True),
    "links": Part(cut=True),
    "first-wheel": Part(cut=True, in_front=True),
    "first-crank": Part(cut=True, in_front=True),
    "frame": Part(cut=True),
    "guide": Part(cut=True),
    "parts": Part(table="drawings.parts_list:parts_table"),
    "assembly": Part(),
    "gears": Part(),
    "groove": Part(),
    "groove-plate": Part(cut=True),
    "coupon": Part(cut=True),
    "plate": Part(),
    "sheet": Part(sheet=True),
}
DRAWINGS = tuple(name for name, part in PARTS.items() if not (part.sheet or part.table))
CUT = tuple(name for name, part in PARTS.items() if part.cut)
SHEETS = tuple(name for name, part in PARTS.items() if part.sheet)
SAMPLES_MAX = 1_000_000


def is_sheet(part: str) -> bool:
    """Return True if a part is drawn as a sheet. Raises GenevaError for an unknown part."""
    _require_known(part)
    return part in SHEETS


def is_table(mechanism: Mechanism, part: str, drawn: bool) -> bool:
    """Return True if a part is written as a table; ``drawn`` is True for a drawing's format.

    Raises GenevaError for a part that is unknown, or has no drawing.
    """
    _require_known(part)
    require_drawn(mechanism, part)
    if drawn and part not in DRAWINGS:
        raise GenevaError(
            f"--part {part} is a table of points: write it as .csv or .json; these are drawings: "
            f"{', '.join(DRAWINGS)}"
        )
    return not drawn and bool(_table(mechanism, part))


def part_table(mechanism: Mechanism, part: str, tolerance_mm: float, samples: int | None) -> Table:
    """Return a part's points: for a chord tolerance, or at ``samples`` even input angles.

    Raises GenevaError for a part that the machine does not have.
    """
    if samples is not None and not 2 <= samples <= SAMPLES_MAX:
        raise GenevaError(f"--samples {cut(samples)}: must be at least 2, at most {SAMPLES_MAX}")
    if part in SHEETS or not is_table(mechanism, part, drawn=False):
        raise GenevaError(f"--part {part} is a drawing: write it as .dxf or .svg")
    require_tolerance(mechanism, tolerance_mm)
    table: Table = load_named(_table(mechanism, part))(mechanism, tolerance_mm, samples)
    return table


def require_drawn(mechanism: Mechanism, part: str) -> None:
    """Raise GenevaError for a part that no machine with such a wheel has."""
    kinds = of_wheel(mechanism.spec.wheel.NAME)
    drawn = {name for kind in kinds for name in (*kind.drawings, *kind.tables)}
    known = [name for name, one in PARTS.items() if one.table or name in drawn]
    if part not in known:
        raise GenevaError(
            f"--part {part}: a machine of this kind has none; it may have {', '.join(known)}",
            ("wheel", "gearing"),
        )


def require_tolerance(mechanism: Mechanism, tolerance_mm: float) -> None:
    """Raise GenevaError for a tolerance that is not above 0, or wider than half a slot.

    A slot may not miss its curve by its own half width.
    """
    allowed = Range(0.0, mechanism.roller_radius_mm, "(]")
    require_mm("--tolerance", tolerance_mm, allowed, "the roller's radius")


def parts_having(parts: Parts, part: str) -> Parts:
    """Return the parts of the machine that has a part: these, or those of the first of two wheels.

    Raises GenevaError for a part of a first wheel if there is none.
    """
    return parts.front if part in PARTS and PARTS[part].in_front else parts


def part_drawing(parts: Parts, part: str, tolerance_mm: float, curves: str) -> Drawing:
    """Return a part's drawing: lines and arcs, or with ``curves`` = "cubics" also cubics.

    Raises GenevaError for a part that is not drawn, or that the machine does not have.
    """
    _require_known(part)
    if part in SHEETS:
        raise GenevaError(f"--part {part} is a drawing sheet, not a drawing to cut")
    parts = parts_having(parts, part)
    require_tolerance(parts.mechanism, tolerance_mm)
    is_table(parts.mechanism, part, drawn=True)
    by, built = _maker(parts, part)
    drawing: Drawing = load_named(by)(built.within(tolerance_mm, curves))
    return drawing._replace(tolerance=tolerance_mm)


def part_sheet(parts: Parts, part: str, tolerance_mm: float, curves: str) -> Sheet:
    """Return a part, or all of them, as a drawing sheet with dimensions.

    Raises GenevaError for a part without a sheet, or that does not fit on one.
    """
    require_drawn(parts.mechanism, part)
    if not is_sheet(part):
        raise GenevaError(f"--part {part} is no drawing sheet; use {', '.join(SHEETS)}")
    require_tolerance(parts.mechanism, tolerance_mm)
    by, built = _maker(parts, part)
    sheet: Sheet = load_named(by)(built.within(tolerance_mm, curves))
    return sheet


def _maker(parts: Parts, part: str) -> tuple[str, Parts]:
    """Return the function that draws a part, and the parts of the machine that it takes."""
    kinds = of_wheel(parts.mechanism.spec.wheel.NAME)
    kind = next(kind for kind in reversed(kinds) if part in kind.drawings)
    # links and gears in front of a sphere are flat
    return kind.drawings[part], parts.built if kind.parts else parts.flat


def require_cut(part: str, option: str = "--kerf") -> None:
    """Raise GenevaError, naming an option, for a part that is not cut out of a plate."""
    if part not in CUT:
        raise GenevaError(
            f"{option} applies only to parts that are cut out of a plate ({', '.join(CUT)}), not "
            f"to {cut(part)}"
        )


def _table(mechanism: Mechanism, part: str) -> str:
    """Return the function that tabulates a part; empty without one."""
    own = (kind.tables.get(part) for kind in reversed(of_wheel(mechanism.spec.wheel.NAME)))
    return next(filter(None, own), PARTS[part].table)


def _require_known(part: str) -> None:
    if part not in PARTS:
        raise GenevaError(
            f"--part {cut(part)}: it must be one of {few(part, PARTS)}{nearest(part, PARTS)}"
        )
