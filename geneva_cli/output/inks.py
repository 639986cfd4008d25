"""Colours of layers, legible on white and on black."""

from __future__ import annotations

from typing import NamedTuple


class Ink(NamedTuple):
    """A colour twice: by its number in AutoCAD's palette, and as hexadecimal RGB."""

    number: int
    rgb: str


# All have a contrast above 3.9 to white and to black.
INKS = {
    "WHEEL": Ink(142, "#007ca5"),
    "CRANK": Ink(94, "#007f00"),
    "ARM": Ink(23, "#a56752"),
    "LINK": Ink(134, "#007f7f"),
    "FRAME": Ink(153, "#527ca5"),
    "HUB": Ink(213, "#a552a5"),
    "SHAFT": Ink(45, "#7f6f3f"),
    "ROLLER": Ink(200, "#bf00ff"),
    "BORE": Ink(1, "#ff0000"),
    "COUPON": Ink(124, "#007f5f"),
    "ENGRAVE": Ink(233, "#a5527c"),
    "PITCH": Ink(8, "#808080"),
    "CENTER": Ink(203, "#9152a5"),
    "GROOVE": Ink(54, "#7f7f00"),
}
OTHERS = (Ink(240, "#ff003f"), Ink(84, "#1f7f00"))
CENTRE_LINES = {"PITCH"}  # layers of lines that are not cut
DASHES = (8.0, 1.5, 1.5, 1.5)  # mm: dash, gap, dash, gap of a centre line


def mixed(rgb: str, fraction: float, page: str) -> str:
    """Return a fraction of a colour on a page's colour, all as hexadecimal RGB."""
    pairs = [(int(rgb[i : i + 2], 16), int(page[i : i + 2], 16)) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(on + fraction * (own - on)):02x}" for own, on in pairs)


def inks(layers: tuple[str, ...]) -> dict[str, Ink]:
    """The ink of each layer; layers without one of their own get the others in turn."""
    unknown = [layer for layer in layers if layer not in INKS]
    return {
        layer: INKS.get(layer) or OTHERS[unknown.index(layer) % len(OTHERS)] for layer in layers
    }
