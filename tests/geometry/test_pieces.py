"""A drawing as a table, and which format is written where."""

import csv
import io
import json
import math

import pytest
from drawing_witness import apart, drawn_shapes
from test_dxf import MANY, bow, of, smooth

from geneva_cli.geometry.pieces import pieces_table, prepared
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Line
from geneva_cli.output import draw


def rows(drawing, units="mm"):
    table = pieces_table(drawing, units)
    return [dict(zip(table.names, row, strict=True)) for row in table.rows()]


def test_a_row_a_piece():
    found = rows(of(bow(), Circle("BORE", (1.0, 2.0), 3.0), smooth()))
    assert [(r["layer"], r["contour"], r["piece"], r["kind"]) for r in found] == [
        ("WHEEL", 1, 1, "arc"),
        ("WHEEL", 1, 2, "line"),
        ("BORE", 2, 1, "circle"),
        *[("CRANK", 3, i, "cubic") for i in (1, 2, 3)],
        ("CRANK", 3, 4, "arc"),
        ("CRANK", 3, 5, "line"),
    ]
    arc, line, bore, cubic = found[:4]
    assert [arc[k] for k in ("x_mm", "y_mm", "end_x_mm", "end_y_mm")] == [10.0, 0.0, -10.0, 0.0]
    assert [arc[k] for k in ("center_x_mm", "center_y_mm", "radius_mm", "sweep_deg")] == (
        pytest.approx([0.0, 0.0, 10.0, 180.0], abs=1e-14)
    )
    assert line["radius_mm"] is line["sweep_deg"] is line["control1_x_mm"] is None
    assert [bore[k] for k in ("x_mm", "center_x_mm", "center_y_mm", "radius_mm", "sweep_deg")] == [
        None,
        1.0,
        2.0,
        3.0,
        360.0,
    ]
    assert [cubic[k] for k in ("control1_x_mm", "control2_x_mm", "control2_y_mm")] == [5, 8, 2]


def again(found):
    """The shapes that a table's rows say."""
    shapes = {}
    for r in found:
        start, end = (r["x_in"], r["y_in"]), (r["end_x_in"], r["end_y_in"])
        if r["kind"] == "circle":
            centre = r["center_x_in"], r["center_y_in"]
            shapes[r["contour"]] = Circle(r["layer"], centre, r["radius_in"])
            continue
        if r["kind"] == "line":
            piece = Line(start, end)
        elif r["kind"] == "arc":
            piece = Arc(start, end, math.tan(math.radians(r["sweep_deg"]) / 4.0))
        else:
            first = r["control1_x_in"], r["control1_y_in"]
            piece = Cubic(start, first, (r["control2_x_in"], r["control2_y_in"]), end)
        before = shapes.get(r["contour"], Contour(r["layer"], ()))
        shapes[r["contour"]] = before._replace(segments=(*before.segments, piece))
    return of(*shapes.values())


def test_csv_and_json_hold_the_drawing(capsys):
    """In full digits: 1e-12 inch are some roundings of their radii and angles."""
    wanted = drawn_shapes(prepared(MANY, "inch"))
    draw(MANY, format="json", units="inch")
    found = json.loads(capsys.readouterr().out)["rows"]
    assert apart(drawn_shapes(again(found)), wanted) < 1e-12
    draw(MANY, format="csv", units="inch")
    found = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    words = ("layer", "contour", "piece", "kind")
    values = [
        {k: v if k in words else float(v) if v else None for k, v in r.items()} for r in found
    ]
    assert apart(drawn_shapes(again(values)), wanted) < 1e-12
    assert apart(drawn_shapes(again(values[1:])), wanted) > 0.1  # it can fail
