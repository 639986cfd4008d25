"""A drawing as a table, and which format is written where."""

import csv
import io
import json
import math

import pytest
from drawing_witness import apart, drawn_shapes
from test_dxf import MANY, bow, of, smooth

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.pieces import pieces_table, prepared
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Line
from geneva_cli.output import draw, dxf, show
from geneva_cli.output.formats import format_of
from geneva_cli.output.svg import drawing_svg as svg
from geneva_cli.table import rows_table


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


def test_formats_by_name_and_extension(tmp_path, capsys):
    for name, module in (("dxf", dxf), ("svg", svg)):
        wanted = "".join(module.chunks(MANY, "mm"))
        draw(MANY, str(tmp_path / f"a.{name.upper()}"))
        assert (tmp_path / f"a.{name.upper()}").read_text(encoding="utf-8") == wanted
        draw(MANY, format=name)
        assert capsys.readouterr().out == wanted
        draw(MANY, str(tmp_path / "a.csv"), format=name)
        assert (tmp_path / "a.csv").read_text(encoding="utf-8") == wanted
    draw(MANY, str(tmp_path / "a.csv"))
    assert (tmp_path / "a.csv").read_text().startswith("layer,contour,piece,kind,x_mm,")
    draw(MANY)
    assert "contour" in capsys.readouterr().out
    draw(MANY, str(tmp_path / "a.md"), units="inch")
    assert "| x_in |" in (tmp_path / "a.md").read_text(encoding="utf-8")


def test_an_input_is_not_overwritten(tmp_path):
    spec = tmp_path / "spec.dxf"
    spec.write_text("mine")
    with pytest.raises(GenevaError, match="this file is an input"):
        draw(MANY, str(spec), inputs=[str(spec)])
    assert spec.read_text() == "mine"


def test_a_refused_drawing_leaves_the_old_file(tmp_path):
    old = tmp_path / "old.svg"
    old.write_text("mine")
    with pytest.raises(GenevaError, match="nothing to draw"):
        draw(of(), str(old))
    assert [p.name for p in tmp_path.iterdir()] == ["old.svg"]
    assert old.read_text() == "mine"


TABLE = rows_table(("a",), [(1.0,)])


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (
            lambda: show(TABLE, format="dxf"),
            "--format dxf: dxf holds a drawing, and this is a table; "
            "it must be one of table, csv, json, md",
        ),
        (
            lambda: show(TABLE, "a.svg"),
            '-o "a.svg": svg holds a drawing, and this is a table; '
            "it must end in .txt, .csv, .json, .md",
        ),
        (
            lambda: show(TABLE, "a.dwg"),
            '-o "a.dwg": the extension names no format (.txt, .csv, .json, .md); '
            "add one, or --format",
        ),
        (
            lambda: draw(MANY, "a.dwg"),
            '-o "a.dwg": the extension names no format (.txt, .csv, .json, .md, .dxf, .svg, .step, '
            ".stl, .3mf, .obj, .stp); add one, or --format",
        ),
        (
            lambda: draw(MANY, format="dwg"),
            "--format dwg: it must be one of dxf, svg, step, stl, 3mf, obj, table, csv, json, md",
        ),
        (lambda: draw(MANY, units="cm"), "--units cm: it must be one of mm, inch"),
    ],
)
def test_refusals(call, said):
    with pytest.raises(GenevaError) as refusal:
        call()
    assert str(refusal.value) == said


def test_a_table_s_formats_are_as_before():
    assert format_of("-") == "table"
    assert format_of("A.JSON") == "json"
