"""Output of tables, drawings, figures and documents to standard output or files, by format.

Each format is a module that is imported when it is asked for. Its ``chunks`` yield a file's text in
pieces; those of a mesh are bytes. ``inputs`` are never overwritten. All functions raise GenevaError
for a format that they do not write, and for a file that cannot be written.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from itertools import chain
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, TypeAlias

from geneva_cli.errors import GenevaError, cut
from geneva_cli.kept import load_named
from geneva_cli.streams import use_utf8
from geneva_cli.table import Table

if TYPE_CHECKING:
    from geneva_cli.answer import Answer
    from geneva_cli.figure import Figure
    from geneva_cli.output.scene import Scene

Paths: TypeAlias = Iterable[str]
# what is written, by format: the module for tables, the function for others
FORMATS = {"table": "text", "csv": "delimited", "json": "jsonfile", "md": "markdown"}
MESHES = {"stl": "mesh_files:stl", "3mf": "mesh_files:threemf"}  # of solids, in bytes
DRAWN = {"dxf": "dxf:chunks", "svg": "svg:chunks", "step": "step:chunks", **MESHES}
SHEETS = {"dxf": "dxf:sheet_chunks", "svg": "svg:sheet_chunks", "pdf": "pdf:sheet_chunks"}
PLOTTED = {  # figures
    "svg": "plot.plot_svg:chunks",
    "png": "plot.plot_svg:png_chunks",
    "pdf": "plot.plot_pdf:chunks",
}
# the other formats of tables get a document's values
DOCUMENTS = {
    "html": "document.html:chunks",
    "pdf": "document.document_pdf:chunks",
    "md": "markdown:document_chunks",
}
PAGES = {"html": "page:chunks"}  # of moving scenes
CAMS = ("cam",)  # for motions only: a file for a controller
CONTROLLERS = ("polynomial", "codesys")  # what reads a cam
EXTENSIONS = {"txt": "table", "stp": "step", "htm": "html"}  # others are the format's name
# versions that ezdxf writes; R2000 is the first with LWPOLYLINE, SPLINE and a unit, and all read it
DXF_VERSIONS = ("R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018")
# The options --columns and --wide of this run: the columns that its tables show, some by name, or
# all whatever their width.
choice = SimpleNamespace(columns=(), wide=False)


def refuse_columns() -> None:
    """Raise GenevaError if columns were chosen by name and no table is shown."""
    if choice.columns:
        raise GenevaError("--columns is for tables, and this run prints none; leave it out")


def chosen(output: str, format: str, formats: Iterable[str] = FORMATS) -> str:
    """The format that is given, or that of a file's extension; on standard output, a table.

    Raises GenevaError if it is none of ``formats``.
    """
    name = format or ("table" if output == "-" else named(output, ""))
    known = list(formats)
    if name in known:
        return name
    given = f"--format {cut(name)}: it" if format else f'-o "{cut(output)}": -o FILE or --format'
    raise GenevaError(f"{given} must name one of: {', '.join(known)}")


def require_spec(output: str, format: str = "") -> None:
    """Raise GenevaError for a file or a format that is not that of a spec."""
    chosen(output, format or "toml" * (output == "-"), ("toml",))


def named(output: str, format: str) -> str:
    """The format that is given, or that of a file's extension."""
    extension = os.path.splitext(output)[1].lower().lstrip(".")
    return format or EXTENSIONS.get(extension, extension)


def usual(output: str, format: str, tolerance_mm: float | None = None) -> tuple[str, float]:
    """The default form of curved walls, and the tolerance of curves for one of the file, mm.

    In STEP a wall is one face as ``spline``, and a hundred as ``arcs``, which all others have. The
    default tolerance is 0.001, and in meshes a printer's, 0.01. In a mesh curves have one half of
    it, as its chords have the other.

    >>> usual("wheel.stp", ""), usual("wheel.stl", ""), usual("-", "dxf", 0.1)
    (('spline', 0.001), ('arcs', 0.005), ('arcs', 0.1))
    """
    name = named(output, format)
    if tolerance_mm is None:
        tolerance_mm = 0.01 if name in MESHES else 0.001
    curves = "spline" if name == "step" else "arcs"
    return curves, 0.5 * tolerance_mm if name in MESHES else tolerance_mm


def is_for_people(output: str, format: str) -> bool:
    """Return True for a table that people read, False for one for programs."""
    return chosen(output, format) in ("table", "md")


def is_seen(output: str) -> bool:
    """Return True if output goes to a terminal."""
    return output == "-" and sys.stdout.isatty()


def show(table: Table, output: str = "-", format: str = "", inputs: Paths = ()) -> None:
    """Print the table, or write it to the file ``output``."""
    name = chosen(output, format)
    _put(_chunks(table, output, name), output, inputs, name)


def _chunks(table: Table, output: str, name: str) -> Iterator[str]:
    from geneva_cli.output.text import checked, only

    seen = is_seen(output)
    table = checked(table, seen)
    if choice.columns:
        table = only(table, choice.columns)
    if name == "table" and seen:
        from geneva_cli.output.terminal.layout import window
        from geneva_cli.output.terminal.terminal_tables import chunks

        return chunks(table, window(bool(choice.columns), choice.wide))
    return load_named(f"output.{FORMATS[name]}:chunks")(table)


def show_answer(answer: Answer, output: str = "-", format: str = "", inputs: Paths = ()) -> None:
    """Print an answer, or write it to the file ``output``: for people a summary above a table."""
    name = chosen(output, format)
    people = name in ("table", "md")
    page = answer.page if people else None
    if not people or choice.columns:  # only those columns are wanted
        show(page or answer.data, output, format, inputs)
        return
    from geneva_cli.output.terminal import summary

    if name == "md":
        first = summary.markdown(answer.summaries)
    else:
        first = summary.chunks(answer.summaries, output, is_seen(output))
    rest = chain(["\n"] if name == "table" else (), _chunks(page, output, name)) if page else ()
    _put(chain(first, rest), output, inputs, name)


def _write(
    formats: Mapping[str, str],
    shown: Any,
    output: str = "-",
    format: str = "",
    inputs: Paths = (),
    version: str = "",
) -> None:
    """Print or write what is shown, in one of these formats; ``version`` is that of a DXF file."""
    name = chosen(output, format, formats)
    if version and name != "dxf":
        raise GenevaError(f"--dxf-version is for .dxf, and this is {name}; leave it out")
    more = (version,) if version else ()
    _put(load_named(f"output.{formats[name]}")(shown, *more), output, inputs, name)


draw = partial(_write, DRAWN)  # a drawing
draw_sheet = partial(_write, SHEETS)
show_document = partial(_write, DOCUMENTS)


def show_figure(figure: Figure, output: str = "-", format: str = "", inputs: Paths = ()) -> None:
    """Print the figure, or write it to the file ``output``; formats of tables get its points."""
    if chosen(output, format, (*PLOTTED, *FORMATS)) in PLOTTED:
        _write(PLOTTED, figure, output, format, inputs)
    else:
        show(figure.table(), output, format, inputs)


def animate(scene: Scene, output: str, inputs: Paths = ()) -> None:
    """Write the scene as a page of HTML; ``-`` prints it."""
    if is_seen(output):
        raise GenevaError("a page is not for a terminal: give -o FILE.html, or --open to show it")
    _write(PAGES, scene, output, "html" if output == "-" else "", inputs)


def show_text(text: str, output: str = "-", inputs: Paths = ()) -> None:
    """Print a text as it is, or write it to the file ``output``."""
    _put([text], output, inputs)


def show_markdown(text: str, output: str = "-") -> None:
    """Print or write a text in Markdown, laid out on a terminal and unchanged elsewhere."""
    if not is_seen(output):
        _put([text], output)
        return
    from geneva_cli.output.terminal.layout import window
    from geneva_cli.output.terminal.page_reader import chunks

    _put(chunks(text, window(False, choice.wide)), "-", (), "table")


def refuse_existing(output: str) -> None:
    """Raise GenevaError if ``output`` is an existing file, which may be a person's work."""
    if os.path.isfile(output):
        raise GenevaError(
            f"{cut(output, 300)}: this file exists; give another name, or --force to replace it"
        )


def _put(
    chunks: Iterable[str] | Iterable[bytes], output: str, inputs: Paths = (), name: str = ""
) -> None:
    """Write chunks of the format ``name``; a table on standard output is for people."""
    if name not in FORMATS:
        refuse_columns()
    if output != "-":
        from geneva_cli.output.files import write

        write(output, chunks, inputs)
        return
    if name in ("png", *MESHES):
        raise GenevaError(f"--format {name}: not for standard output; give -o FILE.{name}")
    if name != "table":
        use_utf8()
    text = map(str, chunks)
    if is_seen(output):
        from geneva_cli.output.terminal import pager

        pager.write(text)
    else:
        sys.stdout.writelines(text)
