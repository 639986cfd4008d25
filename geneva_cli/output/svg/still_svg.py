"""A scene as a picture at one input angle, also for machines without drawings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from html import escape

from geneva_cli.errors import clean
from geneva_cli.output.placed_shapes import PAGE, PlacedShape, placed_shapes
from geneva_cli.output.plot.strokes import DARK
from geneva_cli.output.scene import Scene, value_at
from geneva_cli.output.svg.svg_paths import element


def chunks(scene: Scene) -> Iterator[str]:
    """The file's text, legible on light and on dark pages."""
    x0, y0, x1, y1 = scene.box
    size = max(x1 - x0, y1 - y0)
    # after 0.12 of the turn the first roller is in its slot
    margin, t = 0.02 * size, 0.12 * scene.turn_deg
    wide, high = x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin
    corner = f'x="{x0 - margin:.6g}" y="{-y1 - margin:.6g}"'
    view = " ".join(f"{v:.6g}" for v in (x0 - margin, -y1 - margin, wide, high))
    width_px, line = 640.0, 0.004 * size
    yield (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width_px:g}" '
        f'height="{width_px * high / wide:.6g}" viewBox="{view}" fill="none" '
        f'stroke-width="{line:.6g}" stroke-linejoin="round" stroke-linecap="round">\n'
        f"<title>{escape(clean(scene.title), quote=False)}</title>\n"
        "<style>@media screen and (prefers-color-scheme: dark) "
        f"{{ .page {{ fill: {DARK.page} }} }}</style>\n"
        f'<rect class="page" fill="{PAGE}" {corner} width="{wide:.6g}" height="{high:.6g}"/>\n'
    )
    if scene.frame:
        (x, y), turned = scene.frame.centre, -math.degrees(value_at(scene.frame.angle, t))
        yield f'<g transform="rotate({turned:.6g} {x:.6g} {0.0 - y:.6g})">\n'
    yield from (_group(one, line) for one in placed_shapes(scene, t))
    yield "</g>\n</svg>\n" if scene.frame else "</svg>\n"


def _group(placed: PlacedShape, line: float) -> str:
    """A shape in its place, with its colours; ``line`` is the width of its line."""
    x, y, angle = placed.pose
    down, turned = 0.0 - y, 0.0 - math.degrees(angle)  # y points down, and 0 has no sign
    paint = f' stroke="{placed.ink}"' + (f' fill="{placed.fill}"' if placed.fill else "")
    paint += ' class="page"' if placed.fill == PAGE else ""
    paint += f' stroke-width="{2.0 * line:.6g}"' if placed.wide else ""
    place = f'transform="translate({x:.6g} {down:.6g}) rotate({turned:.6g})"'
    return f"<g {place}{paint}>{element(placed.shape).strip()}</g>\n"
