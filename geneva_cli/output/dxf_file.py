"""The text of a DXF file, with fixed dates and numbers, in plain ASCII."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator

from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.output.ezdxf_alone import Document, Modelspace, options
from geneva_cli.output.formats import DXF_VERSIONS

USUAL = "R2000"
FLOAT_CODES = {
    code
    for codes in (
        range(10, 60),
        range(110, 150),
        range(210, 240),
        range(460, 470),
        range(1010, 1060),
    )
    for code in codes
}


def dxf_text(
    title: str, units: str, version: str, fill: Callable[[Document, Modelspace], None]
) -> Iterator[str]:
    """The text of a file whose document ``fill`` fills; R12 has no unit.

    Raises GenevaError for a version that is not known.
    """
    lines = _document(units, version, fill).split("\n")
    title = clean(title)[:200].strip()  # a line may have 255 characters
    if title:
        yield _ascii(f"999\n{title}\n")  # a comment: a text entity would be cut by machines
    block = 1024  # values at a time
    for start in range(0, len(lines) - 1, 2 * block):
        part = lines[start : start + 2 * block]
        pairs = zip(part[::2], part[1::2], strict=False)
        yield _ascii("".join(f"{code}\n{_fixed(int(code), value)}\n" for code, value in pairs))


def _document(units: str, version: str, fill: Callable[[Document, Modelspace], None]) -> str:
    """The text as ezdxf writes it."""
    if version not in DXF_VERSIONS:
        raise GenevaError(
            f"--dxf-version {cut(version)}: it must be one of {', '.join(DXF_VERSIONS)}"
        )
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        document = Document.new(version)
        if version != "R12":
            document.units = {"mm": 4, "inch": 1}[units]
            document.header["$MEASUREMENT"] = 1 if units == "mm" else 0
        fill(document, document.modelspace())
        stream = io.StringIO()
        document.write(stream)
    finally:
        options.write_fixed_meta_data_for_testing = before
    return stream.getvalue()


def extents(document: Document, space: Modelspace, box: tuple[float, float, float, float]) -> None:
    """Set the extent that a reader shows first: x0, y0, x1, y1."""
    x0, y0, x1, y1 = box
    low, high = (x0, y0, 0.0), (x1, y1, 0.0)
    space.reset_extents(low, high)
    space.reset_limits(low[:2], high[:2])
    # ezdxf treats a corner at the origin as missing when it copies them here
    document.header["$EXTMIN"], document.header["$EXTMAX"] = low, high
    middle = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
    document.set_modelspace_vport(1.1 * max(x1 - x0, y1 - y0), middle)


def linetype(document: Document, name: str, dashes: tuple[float, ...]) -> None:
    """Define a pattern of dashes and gaps, once."""
    if name not in document.linetypes:
        pattern = [d * (1 if i % 2 == 0 else -1) for i, d in enumerate(dashes)]
        shown = "____ _ ____ _ ____" if len(dashes) > 2 else "__ __ __ __"
        document.linetypes.add(name, [sum(dashes), *pattern], description=shown)


def _fixed(code: int, value: str) -> str:
    """A value with fixed decimals if it is a float: no exponent, no negative zero."""
    if code not in FLOAT_CODES:
        return value
    # Bulges and angles (codes 42, 50 and 51) act through a radius, so they have more decimals. The
    # decimals of a length are more than a float has with large coordinates.
    text = f"{float(value):.{15 if code in {42, 50, 51} else 12}f}"
    return text if text.strip("-0.") else text.lstrip("-")


def _ascii(text: str) -> str:
    """Letters beyond ASCII as DXF escapes, or a question mark beyond four digits."""
    return "".join(
        c if c < "\x80" else f"\\U+{ord(c):04X}" if c < "\U00010000" else "?" for c in text
    )
