"""The parts that ``geneva profile`` writes: as tables of points, and as drawings to cut.

A new part is one function, and one line here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from geneva_cli.drawings.model import PartsKind, PartsModel, kind_of
from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.spec.load_named import load_named
from geneva_cli.spec.rules import Range, require_mm
from geneva_cli.table import Table

if TYPE_CHECKING:
    from geneva_cli.geometry.drawing import Drawing
    from geneva_cli.geometry.sheet import Sheet
    from geneva_cli.parts.parts_of_machine import PartsOfMachine


class Part(NamedTuple):
    """The functions that make a part, each as ``module:function``."""

    table: str | None = None  # its points, if no drawing is requested
    drawing: str | None = None
    sheet: str | None = None  # as a drawing sheet with dimensions
    cut: bool = False  # True if it is cut out of a plate
    in_front: bool = False  # True if it belongs to a first wheel, in front of the crank
    every: bool = False  # True if every machine has it


PARTS = {
    "slot": Part(
        "parts.slots.slot_sampling:profile_table",
        "drawings.part_drawings:slot",
    ),
    "wheel": Part(drawing="drawings.part_drawings:wheel", cut=True),
    "crank": Part(drawing="drawings.part_drawings:crank", cut=True),
    "arm": Part(drawing="drawings.part_drawings:arm", cut=True),
    "links": Part(drawing="drawings.part_drawings:links", cut=True),
    "first-wheel": Part(drawing="drawings.part_drawings:wheel", cut=True, in_front=True),
    "first-crank": Part(drawing="drawings.part_drawings:crank", cut=True, in_front=True),
    "frame": Part(drawing="drawings.part_drawings:frame", cut=True),
    "guide": Part(cut=True),
    "parts": Part("drawings.parts_list:parts_table", every=True),
    "assembly": Part(drawing="drawings.machine_drawing:machine"),
    "gears": Part("parts.gears.gear_curves:gears_table", "drawings.part_drawings:gears"),
    "groove": Part("parts.slots.groove:groove_table", "drawings.part_drawings:groove"),
    "groove-plate": Part(drawing="drawings.part_drawings:groove_plate", cut=True),
    "coupon": Part(drawing="drawings.coupon:coupon", cut=True),
    "plate": Part(drawing="drawings.print_plate:plate"),
    "sheet": Part(sheet="drawings.sheet.sheet:sheet"),
}
DRAWINGS = tuple(name for name, part in PARTS.items() if part.drawing or part.cut)
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
    return not drawn and _table(mechanism, part) is not None


def part_table(mechanism: Mechanism, part: str, tolerance_mm: float, samples: int | None) -> Table:
    """Return a part's points: for a chord tolerance, or at ``samples`` even input angles.

    Raises GenevaError for a part that the machine does not have.
    """
    if samples is not None and not 2 <= samples <= SAMPLES_MAX:
        raise GenevaError(f"--samples {cut(samples)}: must be at least 2, at most {SAMPLES_MAX}")
    if part in SHEETS or not is_table(mechanism, part, drawn=False):
        raise GenevaError(f"--part {part} is a drawing: write it as .dxf or .svg")
    require_tolerance(mechanism, tolerance_mm)
    return _loaded(_table(mechanism, part))(mechanism, tolerance_mm, samples)


def require_drawn(mechanism: Mechanism, part: str) -> None:
    """Raise GenevaError for a part that no machine with such a wheel has."""
    kind = kind_of(mechanism)
    known = [name for name in PARTS if _is_of(kind, name)]
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


def model_of(model: PartsModel, part: str) -> PartsModel:
    """Return the model of the machine that a part belongs to: itself, or the first of two wheels.

    Raises GenevaError for a part of a first wheel if there is none.
    """
    return model.front if part in PARTS and PARTS[part].in_front else model


def part_drawing(model: PartsModel, part: str, tolerance_mm: float, curves: str) -> Drawing:
    """Return a part's drawing: lines and arcs, or with ``curves`` = "cubics" also cubics.

    Raises GenevaError for a part that is not drawn, or that the machine does not have.
    """
    _require_known(part)
    if part in SHEETS:
        raise GenevaError(f"--part {part} is a drawing sheet, not a drawing to cut")
    model = model_of(model, part)
    require_tolerance(model.mechanism, tolerance_mm)
    is_table(model.mechanism, part, drawn=True)
    by, built = _maker(model, part)
    drawing: Drawing = _loaded(by)(built.within(tolerance_mm, curves))
    return drawing._replace(tolerance=tolerance_mm)


def part_sheet(model: PartsModel, part: str, tolerance_mm: float, curves: str) -> Sheet:
    """Return a part, or all of them, as a drawing sheet with dimensions.

    Raises GenevaError for a part without a sheet, or that does not fit on one.
    """
    require_drawn(model.mechanism, part)
    if not is_sheet(part):
        raise GenevaError(f"--part {part} is no drawing sheet; use {', '.join(SHEETS)}")
    require_tolerance(model.mechanism, tolerance_mm)
    by, built = _maker(model, part)
    return _loaded(by)(built.within(tolerance_mm, curves))


def _maker(model: PartsModel, part: str) -> tuple[str | None, PartsOfMachine]:
    """Return the function that draws a part, and the parts of the machine that it takes."""
    by = model.kind.DRAWN.get(part)
    # the links and gears in front of a sphere are those of a flat machine
    return (by, model.built) if by else (PARTS[part].drawing or PARTS[part].sheet, model.flat)


def _is_of(kind: PartsKind, name: str) -> bool:
    """Return True if machines with parts of a kind have it: a sphere may have flat links."""
    one = PARTS[name]
    flat = kind.HAS_FLAT_PARTS and (one.drawing or one.sheet or one.table)
    return bool(one.every or name in kind.DRAWN or flat)


def require_cut(part: str, option: str = "--kerf") -> None:
    """Raise GenevaError, naming an option, for a part that is not cut out of a plate."""
    if part not in CUT:
        raise GenevaError(
            f"{option} applies only to parts that are cut out of a plate ({', '.join(CUT)}), not "
            f"to {cut(part)}"
        )


def _table(mechanism: Mechanism, part: str) -> str | None:
    return kind_of(mechanism).TABLES.get(part) or PARTS[part].table


def _require_known(part: str) -> None:
    if part not in PARTS:
        raise GenevaError(
            f"--part {cut(part)}: it must be one of {few(part, PARTS)}{nearest(part, PARTS)}"
        )


def _loaded(by: str | None) -> Any:
    assert by is not None  # is_table tells tables and drawings apart
    return load_named(by)
