"""A drawing as a table, and which format is written where."""

import csv
import io
import json
import math

from drawing_witness import apart, drawn_shapes
from test_dxf import MANY, of

from geneva_cli.geometry.pieces import prepared
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Line
from geneva_cli.output import draw


def again(found):
    """The shapes that a table's rows say."""
    shapes = {}
    for r in found:
        start, end = (r["x_mm"], r["y_mm"]), (r["end_x_mm"], r["end_y_mm"])
        if r["kind"] == "circle":
            centre = r["center_x_mm"], r["center_y_mm"]
            shapes[r["contour"]] = Circle(r["layer"], centre, r["radius_mm"])
            continue
        if r["kind"] == "line":
            piece = Line(start, end)
        elif r["kind"] == "arc":
            piece = Arc(start, end, math.tan(math.radians(r["sweep_deg"]) / 4.0))
        else:
            first = r["control1_x_mm"], r["control1_y_mm"]
            piece = Cubic(start, first, (r["control2_x_mm"], r["control2_y_mm"]), end)
        before = shapes.get(r["contour"], Contour(r["layer"], ()))
        shapes[r["contour"]] = before._replace(segments=(*before.segments, piece))
    return of(*shapes.values())


def test_csv_and_json_hold_the_drawing(capsys):
    """In full digits: 1e-12 mm are some roundings of their radii and angles."""
    wanted = drawn_shapes(prepared(MANY))
    draw(MANY, format="json")
    found = json.loads(capsys.readouterr().out)["rows"]
    assert apart(drawn_shapes(again(found)), wanted) < 1e-12
    draw(MANY, format="csv")
    found = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    words = ("layer", "contour", "piece", "kind")
    values = [
        {k: v if k in words else float(v) if v else None for k, v in r.items()} for r in found
    ]
    assert apart(drawn_shapes(again(values)), wanted) < 1e-12
    assert apart(drawn_shapes(again(values[1:])), wanted) > 0.1  # it can fail
