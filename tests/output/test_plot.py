"""Figures as they are written: what stands in the SVG, and in a picture."""

import io
import itertools
import math
import re
import xml.etree.ElementTree as ET
from typing import NamedTuple

import pytest
import repo
from matplotlib.image import imread

from geneva_cli import load
from geneva_cli.errors import GenevaError
from geneva_cli.figure import JOINED, POINTS, Axis, Curve, Figure, Mark, Panel
from geneva_cli.output import show_figure
from geneva_cli.output.plot import plot_svg
from geneva_cli.output.text import LETTER, width_of

DESIGNS = sorted(repo.DESIGNS.glob("*.toml"))
SVG = "{http://www.w3.org/2000/svg}"
HALF_PIXEL = 0.0051  # coordinates are written with two decimals
PAIR = ["projector", "unequal-steps", "geneva-pair", "press-curved", "turret", "offset-slots"]


def svg_of(figure):
    return "".join(plot_svg.chunks(figure))


def of_design(name):
    return load(str(repo.DESIGNS / f"{name}.toml")).figure()


@pytest.fixture(scope="module")
def pressed():
    return of_design("press-straight")


class Drawn(NamedTuple):
    """A panel of an SVG: its curves as points of data, by number, and the size of a pixel."""

    curves: dict
    jumps: dict
    dots: dict
    pixel: tuple


def numbers(text):
    return [float(x) for x in re.findall(r"-?[\d.]+", text)]


def read(text):
    """The panels of an SVG by name, in the units of their axes."""
    out = {}
    for group in ET.fromstring(text).iter(f"{SVG}g"):
        (x0, x1), (y0, y1) = numbers_of(group, "data-x"), numbers_of(group, "data-y")
        left, top, wide, high = numbers_of(group, "data-frame")
        pixel = (x1 - x0) / wide, (y1 - y0) / high

        def at(x, y, a=(x0, y1), corner=(left, top), pixel=pixel):
            return a[0] + (x - corner[0]) * pixel[0], a[1] - (y - corner[1]) * pixel[1]

        found = Drawn({}, {}, {}, pixel)
        for path in group.iter(f"{SVG}path"):
            kind = path.get("class").split()
            moves = [numbers(part) for part in path.get("d").split("M")[1:]]
            lines = [[at(*p) for p in zip(m[::2], m[1::2], strict=True)] for m in moves]
            if kind[0] in ("curve", "jump"):
                (found.curves if kind[0] == "curve" else found.jumps)[kind[1]] = lines
            if kind[0] == "dot":
                found.dots.setdefault(kind[1], []).extend(line[0] for line in lines)
        out[group.get("id")] = found
    return out


def numbers_of(group, name):
    return [float(x) for x in group.get(name).split()]


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", PAIR)
def test_a_drawn_curve_is_the_core_s(name):
    """Between the points that are drawn, too: each chord's middle is on the curve to 0.1 px."""
    design = load(str(repo.DESIGNS / f"{name}.toml"))
    panels = read(svg_of(design.figure(["velocity", "acceleration", "jerk"])))
    engagements = design.mechanism.engagements
    seen = 0
    for order, quantity in enumerate(("velocity", "acceleration", "jerk"), 1):
        panel = panels[quantity]
        for line in panel.curves["c0"]:
            for (x0, y0), (x1, y1) in itertools.pairwise(line):
                x, y = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
                ends = [(e, x0 - e.mid_deg, x1 - e.mid_deg) for e in engagements]
                inside = [(e, a) for e, a, b in ends if e.entry_deg < a and b < e.exit_deg]
                for e, first in inside:
                    local = x - e.mid_deg
                    want = [e.motion(v, 3).derivatives()[order] for v in (local, first)]
                    slope = abs(e.motion(local, 4).derivatives()[order + 1]) * math.radians(1.0)
                    # along the curve's normal: a steep one moves far for a hundredth of a pixel
                    steep = slope * panel.pixel[0] / panel.pixel[1]
                    near = 1.5 * HALF_PIXEL * math.hypot(1.0, steep) * panel.pixel[1]
                    breaks = any(first <= b <= x1 - e.mid_deg for b in e.motion.breaks_deg)
                    assert breaks or abs(y0 - want[1]) < 2.0 * near, (quantity, x0)
                    assert breaks or abs(y - want[0]) < 10.0 * near, (quantity, x)
                    seen += 1
    assert seen > 60


def test_entry_and_exit_jump_upright(pressed):
    """z = 6: the acceleration jumps by tan(30 deg) at both ends, the jerk by 1."""
    panels = read(svg_of(pressed))
    for name, size, way in (("acceleration", 3**-0.5, -1.0), ("jerk", 1.0, 1.0)):
        panel = panels[name]
        jumps = panel.jumps["c0"]
        near = 2.0 * HALF_PIXEL * panel.pixel[1]
        assert [round(a[0], 1) for a, _ in jumps] == [-60.0, 60.0, 300.0]
        entry, leave, again = ((a[1], b[1]) for a, b in jumps)
        assert entry == pytest.approx((0.0, size), abs=near)
        assert leave == pytest.approx((way * size, 0.0), abs=near)
        assert again == pytest.approx((0.0, size), abs=near)
    assert "c0" not in panels["velocity"].jumps and "c0" not in panels["wheel_deg"].jumps


def test_peaks_are_the_analysis_s(pressed):
    text = svg_of(pressed)
    panel = read(text)["acceleration"]
    ((x, y),) = panel.dots["c0"]
    assert (x, y) == pytest.approx((-22.903061866, 1.349637275902), abs=HALF_PIXEL)
    assert "peak 1.34964 at -22.90°" in text
    assert "max 3434.16 at -17.07°" in text


def boxes(text):
    """Where the texts of an SVG are: left, top, right, bottom, of letters rather too wide."""
    root = ET.fromstring(text)
    out = []
    for one in root.iter(f"{SVG}text"):
        size = float(one.get("font-size", root.get("font-size")))
        wide = LETTER * width_of(one.text) * size
        share = {"end": 1.0, "middle": 0.5}.get(one.get("text-anchor"), 0.0)
        left, base = float(one.get("x")) - share * wide, float(one.get("y"))
        out.append((left, base - 0.75 * size, left + wide, base + 0.22 * size, one.text))
    return root, out


def overlapping(found):
    for a, b in itertools.combinations(found, 2):
        if a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]:
            yield a[4], b[4]


@pytest.mark.sampled(30)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_texts_keep_clear_of_each_other_and_of_the_edge(path):
    text = svg_of(load(str(path)).figure())
    root, found = boxes(text)
    assert list(overlapping(found)) == []
    wide, tall = float(root.get("width")), float(root.get("height"))
    assert all(a >= 0.0 and b >= 0.0 and c <= wide and d <= tall for a, b, c, d, _ in found)
    assert len(text) < 100_000
    assert "nan" not in text.lower() and "inf" not in text.lower()


def test_a_hostile_title():
    panel = Panel(Axis("velocity", "Velocity"), (Curve(0, "<b>&", (([0.0, 1.0], [0.0, 1.0]),)),))
    figure = Figure("</title><script>\x1b[31m" * 40, Axis("x", "x"), (panel,), (0.0, 1.0))
    root, found = boxes(svg_of(figure))
    assert not list(root.iter(f"{SVG}script"))
    assert max(box[2] for box in found) <= float(root.get("width"))


# Files


def test_letters_of_a_png_are_drawn():
    """By the font of the extra, whatever fonts the machine has: a wider text has more ink."""
    panel = Panel(Axis("velocity", "Velocity"), (Curve(1, "one", (([0.0], [0.0]),)),))
    figures = [Figure(t, Axis("x", "x"), (panel,), (0.0, 1.0), ()) for t in ("", "W", "WWWW")]
    drawn = [imread(io.BytesIO(b"".join(plot_svg.png_chunks(one)))) for one in figures]
    none, one, four = ((1.0 - pixels[:, :, :3]).sum() for pixels in drawn)
    assert four - none == pytest.approx(4.0 * (one - none), rel=0.02) and one > none + 100.0


@pytest.mark.long
@pytest.mark.parametrize(("format", "start"), [("png", b"\x89PNG"), ("pdf", b"%PDF")])
def test_pictures(format, start, tmp_path):
    curves = [
        Curve(0, "one $ two", (([0.0, 1.0], [0.0, 1.0]),), (Mark("max", 1.0, 1.0),)),
        Curve(1, "points", (([0.5], [0.5]),), style=POINTS),
        Curve(2, "joined", (([0.2, 0.5], [0.1, 0.5]),), style=JOINED),
    ]
    panel = Panel(Axis("velocity", "Velocity"), tuple(curves))
    figure = Figure("a $ title", Axis("x", "x"), (panel,), (0.0, 1.0), ((0.5, 0.8),))
    written = []
    for name in "ab":
        show_figure(figure, str(tmp_path / f"{name}.{format}"))
        written.append((tmp_path / f"{name}.{format}").read_bytes())
    assert written[0] == written[1] and written[0].startswith(start)
    if format == "png":
        with pytest.raises(GenevaError, match="not for standard output"):
            show_figure(figure, "-", format)
