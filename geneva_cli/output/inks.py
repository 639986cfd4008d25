"""Colours of layers, legible on white and on black."""

from typing import NamedTuple


class Ink(NamedTuple):
    """A colour twice: by its number in AutoCAD's palette, and as hexadecimal RGB."""

    number: int
    rgb: str


# Of every layer that is drawn; all have a contrast above 3.9 to white and to black.
INKS: dict[str, Ink] = {
    "WHEEL": Ink(142, "#007ca5"),
    "CRANK": Ink(94, "#007f00"),
    "ARM": Ink(23, "#a56752"),
    "LINK": Ink(134, "#007f7f"),
    "FRAME": Ink(153, "#527ca5"),
    "HUB": Ink(213, "#a552a5"),
    "SHAFT": Ink(45, "#7f6f3f"),
    "ROLLER": Ink(200, "#bf00ff"),
    "BORE": Ink(1, "#ff0000"),
    "PITCH": Ink(8, "#808080"),
    "CENTER": Ink(203, "#9152a5"),
    "GROOVE": Ink(54, "#7f7f00"),
    "OUTLINE": Ink(240, "#ff003f"),  # drawn by somebody else, over ours
}
CENTRE_LINES = {"PITCH"}  # layers of lines that are not cut
DASHES = (8.0, 1.5, 1.5, 1.5)  # mm: dash, gap, dash, gap of a centre line


def mixed(rgb: str, fraction: float, page: str) -> str:
    """Return a fraction of a colour on a page's colour, all as hexadecimal RGB."""
    pairs = [(int(rgb[i : i + 2], 16), int(page[i : i + 2], 16)) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(on + fraction * (own - on)):02x}" for own, on in pairs)


class Paper(NamedTuple):
    """The colours of a page."""

    page: str
    text: str
    axis: str
    grid: str
    rest: str  # shade of stretches at rest
    curves: tuple[str, ...]


ON_LIGHT = ("#0072b2", "#d55e00", "#007a5e", "#c0589a", "#4d4d4d", "#9a7400")
ON_DARK = ("#56b4e9", "#ff8a3c", "#1fc79b", "#e79ac9", "#d0d0d0", "#f0d94a")
LIGHT = Paper("#ffffff", "#1a1a1a", "#707070", "#dddddd", "#f0f0f0", ON_LIGHT)
DARK = Paper("#15181c", "#e8e8e8", "#8c9197", "#343a41", "#22272d", ON_DARK)


def colour(number: int, paper: Paper) -> str:
    """The colour of a curve by its number; colours repeat, with other dashes."""
    return paper.curves[number % len(paper.curves)]


def dashes(number: int) -> tuple[float, ...]:
    """Dash and gap of a curve by its number, px; none for a solid line."""
    patterns = (), (7, 3), (2, 2.5), (10, 3, 2, 3), (14, 5), (7, 2.5, 2, 2.5, 2, 2.5)
    return patterns[(number + number // len(patterns)) % len(patterns)]
