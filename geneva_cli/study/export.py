"""All files of a design that a shop needs, and its spec with every size that was chosen.

The files are drawings, solids, a sheet, the list of parts, the report and that spec.
"""

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from functools import partial
from typing import NamedTuple, TypeAlias

from geneva_cli.answer import Answer, Summary
from geneva_cli.design import CURVES, Design
from geneva_cli.drawings.catalogue import without_sheet
from geneva_cli.drawings.parts_list import single_parts
from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.machine_spec import BEFORE, Spec
from geneva_cli.output import animate, draw, draw_sheet, show, show_document, show_text, usual
from geneva_cli.parts.chosen import Chosen
from geneva_cli.parts.projection import Missing
from geneva_cli.spec.schema import Points
from geneva_cli.specfile.writer import inserted, quoted, spec_lines
from geneva_cli.study.summary.load_lines import title_of
from geneva_cli.table import record_table, rows_table
from geneva_cli.verdict.warnings import gears_without_teeth


class ExportFile(NamedTuple):
    """A file: its name, what it holds, and the function that writes it to a path."""

    name: str
    content: str
    write: Callable[[str], None]


# The files that a trade needs besides the list of parts and the spec: formats of each part, with
# outlines only of parts that are cut, and names of the other files.
Trade: TypeAlias = tuple[tuple[str, ...], tuple[str, ...]]
TRADES: dict[str, Trade] = {
    "laser": (("dxf",), ("sheet.pdf",)),
    "mill": (("dxf", "step"), ("sheet.pdf", "assembly.step")),
    "print": (("stl",), ("plate.3mf",)),
}
CONTENTS = {
    "sheet.pdf": "drawing sheet with dimensions",
    "assembly.step": "machine at input angle 0, for CAD",
    "assembly.3mf": "machine at input angle 0, as a mesh",
    "plate.3mf": "all parts flat on one bed",
    "report.html": "checks, loads, sizes",
    "machine.html": "the machine in motion",
}
NOT_KEPT = "its comments and its order are not kept"
SINGLE = {"dxf": "outline to cut", "step": "solid", "stl": "mesh to print"}


def trade_of(name: str | None) -> Trade:
    """The files of a trade; of all trades for None. Raises GenevaError for an unknown one."""
    if name is None:
        return ("dxf", "step", "stl"), tuple(CONTENTS)
    if name not in TRADES:
        raise GenevaError(f"--for {cut(name)}: it must be one of {', '.join(TRADES)}")
    return TRADES[name]


def export_files(design: Design, trade: Trade) -> tuple[list[ExportFile], list[Missing]]:
    """The files of a design for a trade, and parts that cannot be built.

    A spherical machine has no bed of parts, and outlines of wheel and crank laid flat. Neither it
    nor a rack has a sheet.
    """
    design.refuse_drawn("the files for a shop are those")
    files, missing = list[ExportFile](), list[Missing]()
    single, whole = trade
    bent = design.parts.LAID_FLAT
    for format in single:
        curves, fine = usual("", format)
        parts, missing = single_parts(design.parts, fine, CURVES[curves])
        for part in bent if format == "dxf" else ():
            with suppress(GenevaError):  # no arm: the list of parts has the reason
                drawing = design.drawing(part, fine)
                content = f"{part} laid flat: {SINGLE['dxf']}"
                files.append(ExportFile(f"{part}-flat.dxf", content, partial(draw, drawing)))
        seen: Counter[str] = Counter()  # parts of one name and size are numbered
        for one in parts:
            if one.is_cut or format != "dxf":
                name = re.sub("[^a-z0-9]+", "-", one.name.lower().replace("'", "")).strip("-")
                stem = f"{name}-{one.copies}x-{one.thickness_mm:.6g}mm"
                seen[stem] += 1
                more = f"-{seen[stem]}" if seen[stem] > 1 else ""
                content, work = f"{one.name}: {SINGLE[format]}", partial(draw, one.drawing)
                files.append(ExportFile(f"{stem}{more}.{format}", content, work))
    lacks = {"sheet.pdf"} if without_sheet(design.mechanism) else set()
    lacks |= {"plate.3mf"} if bent else set()  # shells do not lie on a bed
    for name in (name for name in whole if name not in lacks):
        files.append(ExportFile(name, CONTENTS[name], partial(_write, design, name)))
    parts_list = partial(show, design.part_table("parts"))
    files.append(ExportFile("parts.csv", "list of parts", parts_list))
    return [*files, *_spec_files(design)], missing


def shop_warnings(design: Design) -> list[str]:
    """The warnings about a design whose files go to a shop, with or without a process."""
    # with a process the design's own warnings have it already
    toothless = design.spec.accept.applied(gears_without_teeth(design.spec))
    return list(dict.fromkeys((*design.warnings, *toothless)))


def _write(design: Design, name: str, path: str) -> None:
    stem, _, format = name.partition(".")
    if stem == "report":
        from geneva_cli.study.document import document

        show_document(document(design), path)
    elif stem == "machine":
        from geneva_cli.study.animation.turning_scene import scene

        animate(scene(design), path)
    elif stem == "sheet":
        draw_sheet(design.sheet(), path)
    else:
        curves, fine = usual("", format)
        draw(design.drawing(stem, fine, curves), path)


def _spec_files(design: Design) -> Iterator[ExportFile]:
    """Yield the spec with all settings and sizes, and the points that it names, in one folder."""
    spec, points = design.sized.spec, dict[str, Points]()
    for table in ("drive", BEFORE, "motion"):
        for key, value in spec.table(table).items():
            if isinstance(value, Points):
                name = f"points-{len(points) + 1}.csv"
                points[f"{table}.{key}"] = Points(value.pairs, name)
                text = "".join(f"{x!r},{y!r}\n" for x, y in value.pairs)
                yield ExportFile(name, "points that the spec names", partial(show_text, text))
    text = written(spec.with_keys(points), design.chosen)
    content = "the design, with all its settings and sizes"
    yield ExportFile("spec.toml", content, partial(show_text, text))


def of_sizes(design: Design, as_json: bool) -> Answer:
    """The answer of ``geneva size``: a row for each size that a rule or the load chose."""
    spec, sizes = design.spec, design.chosen
    rows = rows_table(("key", "value", "why"), [(key, *one) for key, one in sizes.items()])
    data = record_table({"spec": spec.path, "title": spec.title, "rows": rows}) if as_json else rows
    count, loaded = len(sizes), len(design.chosen_by_load.sizes)
    text = f"{count} sizes chosen, {loaded} of them by the load" if count else "no size to choose"
    return Answer((Summary(f"{title_of(design)}: {text}"),), rows if count else None, data)


def sized_text(design: Design) -> tuple[str, str]:
    """The text of a design's spec with all its chosen sizes, and a note on what it does not keep.

    Comments and order are those of the file. Where a text has no line for a table or a value, all
    its tables are written anew; then the note says so.
    """
    text = design.text.text if design.text else None
    keys = {one.path: (one.value, "") for one in design.text.set_keys} if design.text else {}
    keys |= {tuple(key.split(".")): size for key, size in design.chosen.items()}
    for table in dict.fromkeys(path[:-1] for path in keys):
        own = {str(path[-1]): one for path, one in keys.items() if path[:-1] == table}
        is_plain = table and all(isinstance(name, str) for name in table)
        if text is not None:
            text = inserted(text, ".".join(map(str, table)), own) if is_plain else None
    return (written(design.sized.spec, design.chosen), NOT_KEPT) if text is None else (text, "")


def written(spec: Spec, sizes: Mapping[str, Chosen]) -> str:
    """The text of a spec, with the reasons of the sizes in it that were chosen."""
    lines = [f"title = {quoted(spec.title)}"] if spec.title else []
    lines += spec_lines(spec, {key: one.why for key, one in sizes.items()})
    return "\n".join(lines).lstrip("\n") + "\n"
