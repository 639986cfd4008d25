"""Links in a whole turn against what passes through their planes: with shapely's polygons."""

import math

import numpy as np
import pytest
import repo
from drawing_witness import polygon
from shapely import affinity
from shapely.geometry import Point

from geneva_cli import load
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.links.link_plates import drawn_links
from geneva_cli.parts.links.link_shafts import planes


def of(name, *given):
    return load(str(repo.DESIGNS / f"{name}.toml"), given)


def least_gap(design, name, where, radius, turn):
    """The least distance of a circle from a link's polygon as it moves, negative inside."""
    links = drawn_links(design.mechanism, design.parts.outlines)
    outline = polygon(next(p for p in links.plates if p.name == name).outline)
    link = next(one for one in links_at(design.mechanism, turn) if one.name == name)
    (x, y), (u, v) = link.joints[:2]
    gaps = []
    for i, deg in enumerate(np.degrees(np.arctan2(v - y, u - x))):
        x0, y0 = (float(np.broadcast_to(c, turn.shape)[i]) for c in (x, y))
        moved = affinity.translate(affinity.rotate(outline, deg, (0.0, 0.0)), x0, y0)
        centre = Point(*where(i))
        inside = moved.contains(centre)
        away = moved.exterior.distance(centre)
        gaps.append((-away if inside else away) - radius)
    return min(gaps)


@pytest.mark.long
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("hub", [2.0, 4.0])
def test_a_coupler_over_the_wheels_hub(hub):
    design = of("four-bar-z4", f"size.wheel_hub_mm={hub}")
    found = planes(design.parts.outlines, design.parts.flat.links)[0]
    turn = np.linspace(-180.0, 180.0, 721)
    least = least_gap(design, "coupler", lambda _: (0.0, 0.0), 0.5 * hub, turn)
    # 721 angles and chords of arcs, against twice as many angles and the arcs themselves
    assert found.gap == pytest.approx(least, abs=0.02)
    assert (found.link, found.passing) == ("coupler", "the wheel's hub")
    (row,) = [c for c in design.checks if c.name == "link_gap_mm"]
    assert row.value == found.gap < 0.0 and row.passes is False
    fixed = design.with_("size.wheel_hub_mm", 0.0)
    assert all(c.passes for c in fixed.checks if c.name == "link_gap_mm")


def test_a_crank_past_the_guides_pin():
    """From the crank's own place to its pin, in the plane between rod and guide."""
    design = of("slider-crank", "size.wheel_hub_mm=0")
    turn = np.linspace(-180.0, 180.0, 721)
    guide = next(one for one in links_at(design.mechanism, turn) if one.name == "guide")
    x, y = guide.joints[2]
    sizes = drawn_links(design.mechanism, design.parts.outlines).sizes
    least = least_gap(design, "crank", lambda i: (x[i], y[i]), sizes.ring, turn)
    found = planes(design.parts.outlines, design.parts.flat.links)[0]
    assert found.gap == pytest.approx(least, abs=0.02)
    assert found.passing == "the pin of rod and guide"
    # a long slider crank comes no nearer than rod less crank, less the eyes
    assert found.gap >= 100.0 - 40.0 - sizes.ring - 1.7 * sizes.bore(math.inf, 211.918)


def test_links_with_walls_too_thin_are_told():
    design = of("slider-crank", "size.link_pin_mm=12", "size.link_width_mm=13")
    (row,) = [c for c in design.checks if c.name == "link_wall_mm"]
    assert row.value == pytest.approx(0.5) and row.passes is False
    table, value = row.nearest.split(" = ") if " = " in row.nearest else (row.nearest, "")
    assert "link_width_mm" in table or "link_pin_mm" in table, value
