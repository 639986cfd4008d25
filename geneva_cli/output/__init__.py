"""Output of tables, drawings, figures and documents to standard output or files, by format.

Each format is a module that is imported when it is asked for. Its ``chunks`` yield a file's text in
pieces; a mesh's ``data`` yield bytes.
"""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output.formats import (
    DOCUMENTS,
    DRAWN,
    FORMATS,
    MESHES,
    PLOTTED,
    document_as,
    drawn_as,
    plotted_as,
    require_own,
    sheet_as,
    table_as,
)
from geneva_cli.streams import use_utf8
from geneva_cli.table import Table

if TYPE_CHECKING:
    from geneva_cli.answer import Answer
    from geneva_cli.figure import Figure
    from geneva_cli.geometry.sheet import Drawing, Sheet
    from geneva_cli.output.document.blocks import Document
    from geneva_cli.output.scene import Scene


class Choice(NamedTuple):
    """The columns that a run shows in its tables: some by name, or all whatever their width.

    ``units`` is mm, or inch for numbers in inches and pounds.
    """

    columns: tuple[str, ...] = ()
    wide: bool = False
    units: str = "mm"


choice = Choice()  # the options --columns, --wide and --units of this run


@contextmanager
def choosing(columns: Choice) -> Iterator[None]:
    """Show tables by this choice of columns and units within the block.

    Raises GenevaError for units that are neither mm nor inch.
    """
    global choice
    if columns.units not in ("mm", "inch"):
        raise GenevaError(f"--units {cut(columns.units)}: it must be mm or inch")
    before, choice = choice, columns
    try:
        yield
    finally:
        choice = before


def in_units(units: str) -> AbstractContextManager[None]:
    """Show numbers in mm or inch within the block."""
    return choosing(choice._replace(units=units))


def refuse_columns() -> None:
    """Raise GenevaError if columns were chosen by name and no table is shown."""
    if choice.columns:
        raise GenevaError("--columns is for tables, and this run prints none; leave it out")


def refuse_inches(why: str) -> None:
    """Raise GenevaError if inches were chosen, where they cannot be."""
    if choice.units != "mm":
        raise GenevaError(f"--units {choice.units}: {why}; leave it out")


def shown(value: Any, unit: str) -> tuple[Any, str]:
    """A value and its unit as this run shows them.

    >>> shown(25.4, "mm")
    (25.4, 'mm')
    """
    inches = _inches()
    return inches.value_in_inches(value, unit) if inches else (value, unit)


def shown_text(text: str) -> str:
    """A sentence with its numbers in the units that this run shows."""
    inches = _inches()
    return inches.text_in_inches(text) if inches else text


def _inches() -> Any:
    """The module that converts, None where numbers stay in mm."""
    return None if choice.units == "mm" else _module("inches")


def _module(name: str) -> Any:
    return importlib.import_module(f"geneva_cli.output.{name}")


def show(table: Table, output: str = "-", format: str = "", inputs: Iterable[str] = ()) -> None:
    """Print the table, or write it to the file ``output``; ``inputs`` are never overwritten.

    Raises GenevaError if the format is not for tables, or if the file cannot be written.
    """
    name = table_as(output, format)
    _put(_chunks(table, output, name), output, inputs, name)


def _chunks(table: Table, output: str, name: str) -> Iterator[str]:
    from geneva_cli.output.finite import checked, only

    table = checked(table, is_seen(output))
    if choice.columns:
        table = only(table, choice.columns)
    if name not in ("table", "md"):
        refuse_inches(f"{name} is for programs, and in SI units")
    if inches := _inches():
        table = inches.table_in_inches(table)
    if name == "table" and is_seen(output):
        from geneva_cli.output.terminal.layout import window
        from geneva_cli.output.terminal.terminal_tables import chunks

        return chunks(table, window(bool(choice.columns), choice.wide))
    return _module(FORMATS[name]).chunks(table)


def is_seen(output: str) -> bool:
    """Return True if output goes to a terminal."""
    return output == "-" and sys.stdout.isatty()


def show_answer(
    answer: Answer, output: str = "-", format: str = "", inputs: Iterable[str] = ()
) -> None:
    """Print an answer, or write it to the file ``output``; ``inputs`` are never overwritten.

    Raises GenevaError as ``show`` does.
    """
    name = table_as(output, format)
    if name not in ("table", "md"):  # formats for people have a summary above the table
        show(answer.data, output, format, inputs)
        return
    if choice.columns:  # with --columns, only those columns are wanted
        show(answer.page or answer.data, output, format, inputs)
        return
    from geneva_cli.output.terminal import summary

    if name == "md":
        first = summary.markdown(answer.summaries)
    else:
        first = summary.chunks(answer.summaries, summary.style_of(output, is_seen(output)))
    page = answer.page
    rest = chain(["\n"] if name == "table" else (), _chunks(page, output, name)) if page else ()
    _put(chain(first, rest), output, inputs, name)


def is_watched(output: str, format: str) -> bool:
    """Return True if a table goes to a terminal, where a person reads it."""
    return format in ("", "table") and is_seen(output)


def draw(
    drawing: Drawing,
    output: str = "-",
    format: str = "",
    units: str = "mm",
    inputs: Iterable[str] = (),
    **own: Any,
) -> None:
    """Print the drawing, or write it to the file ``output``; ``inputs`` are never overwritten.

    Formats of tables get the drawing's pieces. ``units`` is mm or inch; ``own`` are options of one
    format, from OPTIONS. Raises GenevaError for an unknown format or unit, for an option of another
    format, if nothing is drawn, and if the file cannot be written.
    """
    name = drawn_as(output, format)
    require_own(own, name)
    if name in FORMATS:
        from geneva_cli.geometry.pieces import pieces_table

        show(pieces_table(drawing, units), output, name, inputs)
        return
    refuse_columns()
    module = _module(DRAWN[name])
    chunks = module.data(drawing, units) if name in MESHES else module.chunks(drawing, units, **own)
    _put(chunks, output, inputs, name)


def draw_sheet(
    sheet: Sheet, output: str = "-", format: str = "", inputs: Iterable[str] = (), **own: Any
) -> None:
    """Print the drawing sheet, or write it to the file ``output``.

    ``inputs`` are never overwritten; ``own`` are options of one format, from OPTIONS. Raises
    GenevaError if the format is not one of SHEETS, for an option of another format, and if the file
    cannot be written.
    """
    name = sheet_as(output, format)
    require_own(own, name)
    refuse_columns()
    _put(_module(f"sheets.sheet_{name}").chunks(sheet, **own), output, inputs)


def show_figure(
    figure: Figure, output: str = "-", format: str = "", inputs: Iterable[str] = ()
) -> None:
    """Print the figure, or write it to the file ``output``; ``inputs`` are never overwritten.

    ``table`` is a chart in text, as wide as the terminal; csv, json and md get the curves' points.
    Raises GenevaError for an unknown format, for one that needs a missing package, and if the file
    cannot be written.
    """
    name = plotted_as(output, format)
    if name not in PLOTTED:
        show(figure.table(), output, name, inputs)
        return
    refuse_columns()
    if inches := _inches():
        figure = inches.figure_in_inches(figure)
    module = _module("plot.plot_text" if name == "table" else f"plot.plot_{name}")
    if name == "table":
        chunks = module.chunks(figure, *_terminal(output))
    elif name == "png":
        chunks = (module.png_bytes(figure) for _ in range(1))
    else:
        chunks = module.chunks(figure)
    _put(chunks, output, inputs, name)


def animate(scene: Scene, output: str, inputs: Iterable[str] = ()) -> None:
    """Write the scene as a page of HTML (``-`` prints it), or as a still .svg.

    Raises GenevaError for another extension, and if the file cannot be written.
    """
    if is_seen(output):
        raise GenevaError("a page is not for a terminal: give -o FILE.html, or --open to show it")
    extension = os.path.splitext(output)[1].lower()
    if output != "-" and extension not in (".html", ".htm", ".svg"):
        raise GenevaError(f'-o "{cut(output)}": it must end in .html or .htm or .svg')
    module = _module("svg.still_svg" if extension == ".svg" else "page")
    _put(module.chunks(scene), output, inputs)


def show_document(
    document: Document, output: str = "-", format: str = "", inputs: Iterable[str] = ()
) -> None:
    """Print the document, or write it to the file ``output``; ``inputs`` are never overwritten.

    Raises GenevaError if the format is not one of DOCUMENTS, or if the file cannot be written.
    """
    name = document_as(output, format)
    refuse_columns()
    if inches := _inches():
        document = inches.document_in_inches(document)
    _put(_module(f"document.{DOCUMENTS[name]}").chunks(document), output, inputs)


def _terminal(output: str) -> tuple[int, bool]:
    if not is_seen(output):
        return 80, False
    import shutil

    return shutil.get_terminal_size().columns, "utf" in (sys.stdout.encoding or "").lower()


def show_text(text: str, output: str = "-", inputs: Iterable[str] = ()) -> None:
    """Print a text as it is, or write it to the file ``output``; ``inputs`` are not overwritten."""
    refuse_columns()
    _put([text], output, inputs)


def refuse_existing(output: str) -> None:
    """Raise GenevaError if ``output`` is an existing file, which may be a person's work."""
    if os.path.isfile(output):
        raise GenevaError(
            f"{cut(output, 300)}: this file exists; give another name, or --force to replace it"
        )


def show_markdown(text: str) -> None:
    """Print a text in Markdown, laid out on a terminal and unchanged elsewhere."""
    refuse_columns()
    if not is_seen("-"):
        _put([text], "-")
        return
    from geneva_cli.output.terminal.layout import window
    from geneva_cli.output.terminal.page_reader import chunks

    _put(chunks(text, window(False, choice.wide)), "-", (), "table")


def _put(
    chunks: Iterable[str] | Iterable[bytes],
    output: str,
    inputs: Iterable[str] = (),
    name: str = "",
) -> None:
    """Write chunks of the format ``name``; a table on standard output is for people."""
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
