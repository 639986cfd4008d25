"""The formats of output, and which of them a file's extension or ``--format`` means."""

from __future__ import annotations

import os
from collections.abc import Collection

from geneva_cli.errors import GenevaError, cut

# module by --format; the extension of a file is a format's name too
FORMATS = {"table": "text", "csv": "delimited", "json": "jsonfile", "md": "markdown"}
# for drawings only
MESHES = {"stl": "mesh_files:stl", "3mf": "mesh_files:threemf"}  # of solids, in bytes
DRAWN = {"dxf": "dxf:chunks", "svg": "svg:chunks", "step": "step:chunks", **MESHES}
SHEETS = ("dxf", "svg", "pdf")  # for drawing sheets
CAMS = ("cam",)  # for motions only: a file for a controller
CONTROLLERS = ("polynomial", "codesys")  # what reads a cam
PICTURES = ("png", "pdf")  # for figures only
# for documents; the other formats of tables get their values
DOCUMENTS = {"html": "html", "pdf": "document_pdf", "md": "document_markdown"}
# for figures; the others get their points
PLOTTED = {"svg": "plot_svg:chunks", "png": "plot_svg:png_chunks", "pdf": "plot_pdf:chunks"}
_OWN = (*FORMATS, *DRAWN, *PICTURES)
EXTENSIONS = {"txt": "table", **dict(zip(_OWN, _OWN, strict=True))}
del EXTENSIONS["table"]  # its extension is .txt
EXTENSIONS |= {"stp": "step", "html": "html", "htm": "html"}
# versions that ezdxf writes; R2000 is the first with LWPOLYLINE, SPLINE and a unit, and all read it
DXF_VERSIONS = ("R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018")


def drawn_as(output: str, format: str) -> str:
    """The format of a drawing. Raises GenevaError for another one."""
    if not is_drawn(output, format):
        raise GenevaError(
            "this part is a drawing, no table of points: write it with -o FILE.dxf (or "
            f"{', '.join(f'.{name}' for name in DRAWN if name != 'dxf')}), or take --part slot"
        )
    return named(output, format)


def is_drawn(output: str, format: str) -> bool:
    """Return True for lines and arcs, False for a table. Raises GenevaError for another format."""
    if named(output, format) == "pdf":
        option = f"--format {format}" if format else f'-o "{cut(output)}"'
        raise GenevaError(
            f"{option}: a pdf holds a drawing sheet: take --part sheet, or write .dxf or .svg"
        )
    return chosen(output, format, {**DRAWN, **FORMATS}) in DRAWN


def sheet_as(output: str, format: str) -> str:
    """The format of a drawing sheet. Raises GenevaError for an unknown one."""
    if not format and output == "-":
        raise GenevaError(
            f"a drawing sheet is written as {', '.join(SHEETS)}: give -o FILE.pdf, or --format pdf"
        )
    return chosen(output, format, SHEETS, "of a drawing sheet ")


def document_as(output: str, format: str) -> str:
    """The format of a document. Raises GenevaError for an unknown one."""
    return chosen(output, format, DOCUMENTS)


def is_document(output: str, format: str) -> bool:
    """Return True for a document, False for a table. Raises GenevaError for another format."""
    formats = dict.fromkeys((*FORMATS, *DOCUMENTS))
    return chosen(output, format, formats, "of a report ") in DOCUMENTS


def plotted_as(output: str, format: str) -> str:
    """The format of a figure. Raises GenevaError for an unknown one."""
    return chosen(output, format, (*PLOTTED, *FORMATS))


def usual_curves(output: str, format: str) -> str:
    """The default form of curved walls: ``spline`` in STEP, ``arcs`` elsewhere.

    >>> usual_curves("wheel.stp", ""), usual_curves("-", "dxf")
    ('spline', 'arcs')
    """
    # In a solid, a wall is one face as a spline, and a hundred faces as arcs.
    return "spline" if named(output, format) == "step" else "arcs"


def curve_tolerance(tolerance_mm: float | None, output: str, format: str) -> float:
    """The tolerance of a drawing's curves for one of the file, mm, or for None the usual one.

    That is 0.001, and in meshes a printer's, 0.01. In a mesh curves have one half of it, as its
    chords have the other.

    >>> curve_tolerance(None, "wheel.stl", ""), curve_tolerance(None, "wheel.dxf", "")
    (0.005, 0.001)
    """
    is_mesh = named(output, format) in MESHES
    if tolerance_mm is None:
        tolerance_mm = 0.01 if is_mesh else 0.001
    return 0.5 * tolerance_mm if is_mesh else tolerance_mm


def chosen(output: str, format: str, formats: Collection[str], remark: str = "") -> str:
    """The format that is given, or that of a file's extension; on standard output, a table."""
    name = format or ("table" if output == "-" else named(output, ""))
    if name in formats:
        return name
    if formats is FORMATS and name in (*DRAWN, *PICTURES):
        remark = f"{name} holds a drawing, and this is a table; "
    if format or output == "-":
        raise GenevaError(f"--format {cut(name)}: {remark}it must be one of {', '.join(formats)}")
    known = ", ".join(f".{e}" for e, name in EXTENSIONS.items() if name in formats)
    if name:
        wrong = remark if formats is FORMATS else ""
        raise GenevaError(f'-o "{cut(output)}": {wrong}it must end in {known}')
    raise GenevaError(
        f'-o "{cut(output)}": the extension names no format ({known}); add one, or --format'
    )


def named(output: str, format: str) -> str:
    """The format that is given, or that of a file's extension."""
    return format or EXTENSIONS.get(os.path.splitext(output)[1].lower().lstrip("."), "")
