"""The formats of output, and which of them a file's extension or ``--format`` means."""

from __future__ import annotations

import os
from collections.abc import Iterable

from geneva_cli.errors import GenevaError, cut

# what is written, by format: the module for tables, the function for others
FORMATS = {"table": "text", "csv": "delimited", "json": "jsonfile", "md": "markdown"}
MESHES = {"stl": "mesh_files:stl", "3mf": "mesh_files:threemf"}  # of solids, in bytes
DRAWN = {"dxf": "dxf:chunks", "svg": "svg:chunks", "step": "step:chunks", **MESHES}
SHEETS = {name: f"{name}:sheet_chunks" for name in ("dxf", "svg", "pdf")}  # drawing sheets
PLOTTED = {  # figures
    "svg": "plot.plot_svg:chunks",
    "png": "plot.plot_svg:png_chunks",
    "pdf": "plot.plot_pdf:chunks",
}
# the other formats of tables get a document's values
DOCUMENTS = {
    "html": "document.html:chunks",
    "pdf": "document.document_pdf:chunks",
    "md": "document.document_markdown:chunks",
}
PAGES = {"html": "page:chunks"}  # of moving scenes
CAMS = ("cam",)  # for motions only: a file for a controller
CONTROLLERS = ("polynomial", "codesys")  # what reads a cam
EXTENSIONS = {"txt": "table", "stp": "step", "htm": "html"}  # others are the format's name
# versions that ezdxf writes; R2000 is the first with LWPOLYLINE, SPLINE and a unit, and all read it
DXF_VERSIONS = ("R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018")


def chosen(output: str, format: str, formats: Iterable[str] = FORMATS) -> str:
    """The format that is given, or that of a file's extension; on standard output, a table.

    Raises GenevaError if it is none of ``formats``.
    """
    name = format or ("table" if output == "-" else named(output, ""))
    known = list(formats)
    if name in known:
        return name
    if format:
        raise GenevaError(f"--format {cut(name)}: it must be one of {', '.join(known)}")
    if output == "-":
        raise GenevaError(
            f"this is no table: give -o FILE.{known[0]}, or a --format: {', '.join(known)}"
        )
    known = [".txt" if name == "table" else f".{name}" for name in known]
    raise GenevaError(f'-o "{cut(output)}": it must end in {", ".join(known)}, or give a --format')


def named(output: str, format: str) -> str:
    """The format that is given, or that of a file's extension."""
    extension = os.path.splitext(output)[1].lower().lstrip(".")
    return format or EXTENSIONS.get(extension, extension)


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
