"""A scene as a moving GIF that repeats one turn, drawn by Pillow (extra ``plot``).

A machine with stops goes back and forth over that turn.
"""

from __future__ import annotations

import io
import math
from functools import lru_cache
from typing import Any

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import at
from geneva_cli.geometry.shapes import Circle, Line, Point, Shape
from geneva_cli.output.placed_shapes import PAGE, placed_shapes
from geneva_cli.output.scene import Scene, value_at
from geneva_cli.progress import tracked

WIDE = 400  # px
FRAMES = 60  # pictures of a turn
FINER = 3  # times: lines become smooth when they are drawn larger and reduced


def gif_bytes(scene: Scene) -> bytes:
    """The file. Raises GenevaError if Pillow is not installed.

    The same scene gives the same bytes, with the same Pillow.
    """
    try:
        from PIL import Image, ImageDraw
    except ImportError:
        raise GenevaError("a .gif needs Pillow: pip install 'geneva-cli[plot]'") from None
    x0, y0, x1, y1 = scene.box
    margin = 0.03 * max(x1 - x0, y1 - y0)
    scale = FINER * WIDE / (x1 - x0 + 2.0 * margin)
    high = round((y1 - y0 + 2.0 * margin) * scale / FINER)
    octree = Image.Quantize.FASTOCTREE
    frames: list[Image.Image] = []
    for i in tracked(range(FRAMES), "pictures", FRAMES):
        image = Image.new("RGB", (FINER * WIDE, FINER * high), PAGE)
        _draw(ImageDraw.Draw(image, "RGBA"), scene, scene.turn_deg * i / FRAMES, margin, scale)
        small = image.resize((WIDE, high), Image.Resampling.LANCZOS)
        # one palette for all frames; by the median cut it has no colour of a few pixels, as rollers
        colours = {"palette": frames[0]} if frames else {"colors": 48, "method": octree}
        frames.append(small.quantize(**colours, dither=Image.Dither.NONE))
    if scene.stops:  # a wheel with stops turns back
        frames += frames[-2:0:-1]
    out = io.BytesIO()
    each = round(1000.0 * 6.0 / FRAMES)  # ms: a turn takes six seconds on the screen
    frames[0].save(
        out, "GIF", save_all=True, append_images=frames[1:], duration=each, loop=0, optimize=False
    )
    return out.getvalue()


def _draw(pen: Any, scene: Scene, t: float, margin: float, scale: float) -> None:
    """Draw the scene at an input angle; ``margin`` is in mm, ``scale`` in pixels per mm."""
    x0, _, _, y1 = scene.box
    frame = scene.frame
    turned_by = value_at(frame.angle, t) if frame else 0.0

    def on_paper(p: Point) -> Point:
        if frame:
            x, y = frame.centre
            (p,) = _placed([(p[0] - x, p[1] - y)], x, y, turned_by)
        return (p[0] - x0 + margin) * scale, (y1 + margin - p[1]) * scale

    for shape, pose, ink, fill, wide in placed_shapes(scene, t):
        points = [on_paper(p) for p in _placed(_points(shape), *pose)]
        if fill:
            pen.polygon(points, fill=fill)
        pen.line(points, fill=ink, width=(4 if wide else 2) * FINER)


@lru_cache(maxsize=256)  # an outline is needed in every frame
def _points(shape: Shape) -> list[Point]:
    """A shape as a chain of points."""
    if isinstance(shape, Circle):
        chords = 96
        (x, y), r = shape.centre, shape.radius
        angles = (math.tau * i / chords for i in range(chords + 1))
        return [(x + r * math.cos(a), y + r * math.sin(a)) for a in angles]
    points = [shape.segments[0].start]
    for segment in shape.segments:
        n = 1 if isinstance(segment, Line) else 24  # chords
        points += [at(segment, (i + 1) / n) for i in range(n)]
    return points


def _placed(points: list[Point], x: float, y: float, angle: float) -> list[Point]:
    c, s = math.cos(angle), math.sin(angle)
    return [(x + c * u - s * v, y + s * u + c * v) for u, v in points]
