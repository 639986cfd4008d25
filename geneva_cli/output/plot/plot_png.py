"""A figure as PNG: the SVG, drawn by resvg with a font of its own, which are an extra."""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.figure import Figure
from geneva_cli.output.plot import plot_svg
from geneva_cli.output.plot.plot_layout import PAGE

WIDE = 1500  # pixels of the page: ten inches at 150 dots an inch


def png_bytes(figure: Figure) -> bytes:
    """Return the file's bytes, equal for equal figures on every machine.

    Raises GenevaError if resvg or the font is not installed.
    """
    try:
        from font_source_sans_pro import font_files_ttf as fonts
        from resvg_py import svg_to_bytes
    except ImportError:
        raise GenevaError(
            "png needs resvg-py and a font, which are not installed: pip install "
            "'geneva-cli[plot]', or write an .svg or a .pdf"
        ) from None
    return svg_to_bytes(
        "".join(plot_svg.chunks(figure)),
        zoom=WIDE / PAGE,
        skip_system_fonts=True,  # a picture does not depend on the machine
        font_files=[fonts["SourceSansPro"], fonts["SourceSansProBold"]],
        sans_serif_family="Source Sans Pro",
    )
