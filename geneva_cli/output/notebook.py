"""A design in a notebook: pictures, and the report in a fold."""

from __future__ import annotations

import base64
from collections.abc import Iterable
from html import escape

from geneva_cli.errors import clean
from geneva_cli.figure import Figure
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output.plot import plot_svg
from geneva_cli.output.svg import drawing_svg as svg
from geneva_cli.table import Table


def design_html(report: Table, verdict: str, drawing: Drawing | None, figure: Figure) -> str:
    """HTML of a design: title, verdict, the machine if it is flat, curves, and the report."""
    pictures = [plot_svg.chunks(figure)]
    if drawing is not None:
        pictures.insert(0, svg.chunks(drawing, "mm"))
    return (
        f"<h3>{escape(clean(report.title))}</h3><p>{escape(report.prose)}</p>"
        + f"<p><b>{escape(verdict)}</b></p>"
        + "".join(_picture(chunks) for chunks in pictures)
        + f"<details><summary>Report</summary>{report._repr_html_()}</details>"
    )


def _picture(chunks: Iterable[str]) -> str:
    """A picture as data, since its styles would affect the whole page otherwise."""
    data = base64.b64encode("".join(chunks).encode()).decode()
    return (
        f'<img src="data:image/svg+xml;base64,{data}" alt=""'
        ' style="max-width: 48%; max-height: 480px; vertical-align: top">'
    )
