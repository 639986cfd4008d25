"""What is handed over: nothing of the report is missing, and it never disagrees with `check`."""

import functools
import json
import math
import re
import unicodedata
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
import repo
from sampling import some
from test_sheets import objects
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.design import Design, load
from geneva_cli.geometry.shapes import Line, closed
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output import jsonfile
from geneva_cli.output.document import document_markdown, document_pdf, html, pdf_table
from geneva_cli.output.document.blocks import (
    Document,
    Fact,
    Facts,
    Grid,
    Picture,
    TextList,
    value_text,
)
from geneva_cli.output.document.html import inline
from geneva_cli.output.letters import western
from geneva_cli.output.pdf import pdf_drawing, pdf_file
from geneva_cli.output.pdf.pdf_pages import SOFT, lines, wide
from geneva_cli.study.document import document
from geneva_cli.table import record_table

pytestmark = pytest.mark.usefixtures("made_once")
# Loads and a motor; a sphere; tolerances; a linkage; a groove; unlike engagements.
KINDS = ("turret", "spherical-z6", "tolerances", "four-bar-z4", "cam-geneva", "unequal-steps")
JAMS = (
    'title = "Größe ψ <b>&</b> 中"\n[wheel]\nz = 6\n[size]\nwheel_radius_mm = 120\n'
    "[load]\ninertia_kgm2 = 0.2\n[limits]\nacceleration_max = 1.0\n"
)
VOID = {"meta", "br", "img", "link"}


@pytest.fixture(scope="module", autouse=True)
def few_samples() -> Iterator[None]:
    """What is shown of tolerances does not depend on how many machines are drawn at random."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("geneva_cli.verdict.report.load_report.SAMPLES", 64)
        yield


@functools.cache
def made(path: str) -> tuple[Design, Document]:
    design = load(path)
    return design, document(design)


@functools.cache
def of(name: str) -> tuple[Design, Document]:
    return made(str(repo.DESIGNS / f"{name}.toml"))


@pytest.fixture(scope="module")
def jams(tmp_path_factory: pytest.TempPathFactory) -> str:
    file = tmp_path_factory.mktemp("jams") / "spec.toml"
    file.write_text(JAMS, encoding="utf-8")
    return str(file)


class Page(HTMLParser):
    """A page as a strict reader sees it: every element is closed in its order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.cells: list[str] = []
        self.tables: list[list[str]] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        given = dict(attrs)
        self.tags.append((tag, given))
        self.ids += [given["id"]] if "id" in given else []
        self.links += [v for k, v in attrs if k in ("src", "href", "xlink:href", "srcset")]
        if tag in ("th", "td", "li", "p", "h1"):
            self.cells.append("")
        if tag == "table":
            self.tables.append([])
        elif "table" in self.open:
            self.tables[-1].append(tag)
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: Any) -> None:
        self.handle_starttag(tag, attrs)
        self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.cells and self.open and self.open[-1] in ("th", "td", "li", "p", "h1"):
            self.cells[-1] += data


def values(tree: Any) -> list[Any]:
    """The values of a json object that are not null."""
    if isinstance(tree, dict):
        return [v for one in tree.values() for v in values(one)]
    if isinstance(tree, list):
        return [v for one in tree for v in values(one)]
    return [] if tree is None else [tree]


def has(cells: set[str], told: str, value: Any) -> bool:
    """Whether a value is in a cell, alone or before its unit; a text in any text."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return value in told if isinstance(value, str) else value_text(value) in cells
    return value_text(value).replace("\u00a0", " ") in cells


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", KINDS)
def test_every_value_of_the_report_is_on_the_page(name: str) -> None:
    design, found = of(name)
    page = Page("".join(html.chunks(found)))
    told = "\n".join(page.cells)
    cells = {part for cell in page.cells for text in cell.split(", ") for part in _parts(text)}
    tree = json.loads("".join(jsonfile.chunks(design.report.table)))
    assert tree.pop("spec") == design.spec.path
    assert tree.pop("passes") is True
    every = values(tree)
    assert len(every) > 60
    assert [v for v in every if not has(cells, told, v)] == []
    assert not has(cells, told, 123.456) and not has(cells, told, "no such text")


def _parts(cell: str) -> list[str]:
    """A cell as it is, and without its unit."""
    bare = cell.removesuffix("°")
    head, _, _ = bare.rpartition(" ")
    return [cell, bare, head, bare.split(" ")[0], " ".join(bare.split(" ")[:3])]


@pytest.mark.sampled(3)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("name", KINDS)
def test_a_page_is_well_formed_and_needs_nothing_else(name: str) -> None:
    _, found = of(name)
    text = "".join(html.chunks(found))
    page = Page(text)
    assert text.startswith("<!DOCTYPE html>")
    assert len(page.ids) == len(set(page.ids))
    assert page.links == [] and "@import" not in text and "<script" not in text
    addresses = set(re.findall(r"https?://[^\s\"<]+", text))
    assert addresses <= {"http://www.w3.org/2000/svg"}  # the name of a language, not a place
    assert str(repo.ROOT) not in text and "nan" not in re.findall(r"[a-z]+", text)
    used = re.findall(r"url\(#([^)]+)\)", text)
    assert set(used) <= set(page.ids)
    # what stands in a table is named for who hears it
    assert all(table[0] == "caption" for table in page.tables)
    heads = [given for tag, given in page.tags if tag == "th"]
    assert heads and all(given["scope"] in ("row", "col") for given in heads)
    assert text == "".join(html.chunks(found))


def test_a_design_has_one_document() -> None:
    """However often, and whichever answers were asked for before."""
    design, found = of("spherical-z6")
    again = Design.of(design.spec)
    assert again.loads and "".join(html.chunks(document(again))) == "".join(html.chunks(found))


def test_the_styles_of_a_drawing_are_its_own() -> None:
    svg = (
        '<?xml version="1.0"?>\n<svg xmlns="x"><title>a</title><style>\n'
        "@media (prefers-color-scheme: dark) {\n.page { fill: #15181c } #TEXT, .b { fill: red }\n"
        "g[id='WHEEL'] { stroke: #73b7ce }\n}\n</style>\n"
        '<g id="WHEEL" fill="url(#hatch)"/></svg>'
    )
    assert inline([svg], "one") == (
        '<svg id="one" xmlns="x"><title>a</title><style>\n'
        "@media screen and (prefers-color-scheme: dark) {\n"
        "#one .page { fill: #15181c }#one #one-TEXT, #one .b { fill: red }\n"
        "#one g[id='one-WHEEL'] { stroke: #73b7ce }\n}\n</style>\n"
        '<g id="one-WHEEL" fill="url(#one-hatch)"/></svg>'
    )


def said(text: str) -> tuple[list[str], dict[int, str]]:
    """The texts of a PDF in their order, and its objects."""
    found, _ = objects(text)
    streams = [body for _, body in sorted(found.items()) if "stream" in body]
    texts = [t for body in streams for t in re.findall(r"\(((?:[^()\\]|\\.)*)\) Tj", body)]
    return [_plain(t) for t in texts], found


def _plain(text: str) -> str:
    codes = re.sub(r"\\(\d{3})", lambda m: chr(int(m[1], 8)), text)
    return re.sub(r"\\(.)", r"\1", codes).encode("latin-1").decode("cp1252")


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ["turret", "spherical-z6", "jams"])
def test_a_pdf_holds_title_verdict_and_every_check(name: str, jams: str) -> None:
    design, found = made(jams) if name == "jams" else of(name)
    text = "".join(document_pdf.chunks(found))
    texts, every = said(text)
    assert texts[0] == western(found.title)[: len(texts[0])]
    assert found.verdict in texts
    assert all(check.name in texts for check in design.checks)
    assert not any("?" in t for t in texts)
    pages = [body for body in every.values() if "/Type /Page " in body]
    numbers = [t for t in texts if re.fullmatch(r"\d+ / \d+", t)]
    assert numbers == [f"{i} / {len(pages)}" for i in range(1, len(pages) + 1)]
    assert text == "".join(document_pdf.chunks(found)) and "CreationDate" not in text


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["turret", "spherical-z6", "press-curved", "internal-z6"])
def test_page_1_is_machine_verdict_key_figures_and_motor(name: str) -> None:
    _, found = of(name)
    every, _ = objects("".join(document_pdf.chunks(found)))
    first = next(body for _, body in sorted(every.items()) if "stream" in body)
    texts = [_plain(t) for t in re.findall(r"\(((?:[^()\\]|\\.)*)\) Tj", first)]
    assert found.verdict in texts
    assert {"The machine", "In short", "Cycle", "Size", "Tightest", "Motor"} <= set(texts)
    (grid,) = (b for b in found.blocks if isinstance(b, Grid) and b.caption == "In short")
    assert len(grid.rows) == 7


def test_the_parts_list_fits_its_columns() -> None:
    """No heading and no number of it is broken."""
    _, found = of("turret")
    texts, _ = said("".join(document_pdf.chunks(found)))
    assert {"Count", "Mass, kg", "461.94", "143.342", "material.wheel"} <= set(texts)
    assert "Centroid x, mm" in texts


def test_a_power_of_ten_is_raised_on_paper() -> None:
    """The exponent is smaller and higher, and no caret stands before it."""
    shown_ = pdf_file.text(western(value_text(1.21353e-6)), (0.0, 0.0), 10.0)
    assert "10) Tj /F1 7 Tf 3.3 Ts (-6) Tj" in shown_
    assert pdf_file.wide("10^-6", 10.0) < pdf_file.wide("10-6", 10.0)


@pytest.mark.usefixtures("no_advice")
def test_nothing_of_a_pdf_leaves_its_page(jams: str) -> None:
    """Texts end before the margin, and stand between the first line and the page's number."""
    shown_ = r"/F([12]) (\S+) Tf 1 0 0 1 (\S+) (\S+) Tm \(((?:[^()\\]|\\.)*)\) Tj"
    every = re.findall(shown_, "".join(document_pdf.chunks(made(jams)[1])))
    assert len(every) > 500
    for font, size, x, y, text in every:
        end = float(x) + wide(_plain(text), float(size), font == "2")
        assert float(x) >= 16.0 and end <= 210.0 - 15.9, text
        assert 11.0 <= float(y) <= 281.0, text


@pytest.mark.parametrize(
    ("wide_mm", "high_mm", "x", "y"),
    [(400.0, 50.0, (19.0, 191.0), (225.5, 247.0)), (50.0, 400.0, (99.25, 110.75), (155.0, 247.0))],
)
def test_a_drawing_is_as_large_as_its_page_lets_it_be(wide_mm, high_mm, x, y) -> None:
    """172 mm wide between margins of 16 + 3 mm, or 92 mm high, below a line at 250 mm."""
    corners = [(0.0, 0.0), (wide_mm, 0.0), (wide_mm, high_mm), (0.0, high_mm)]
    sides = [Line(p, q) for p, q in zip(corners, corners[1:] + corners[:1], strict=True)]
    stream = pdf_drawing.drawing(Drawing("", (closed("FRAME", sides),))).draw(250.0)
    shapes, _, _ = stream.partition(SOFT)  # the ink of notes
    points = re.findall(r"^(\S+) (\S+) [ml]$", shapes, re.MULTILINE)
    xs, ys = ([float(one) for one in row] for row in zip(*points, strict=True))
    assert (min(xs), max(xs)) == x
    assert (min(ys), max(ys)) == y


def test_lines_fit_and_lose_no_word() -> None:
    text = "material.roller.youngs_modulus_GPa and a word that is very, very long " + "x" * 90
    for room in (18.0, 40.0, 120.0):
        found = lines(text, 2.8, room)
        assert all(wide(line, 2.8) <= room + 1e-9 for line in found)
        assert "".join(found).replace(" ", "") == text.replace(" ", "")


@pytest.mark.usefixtures("no_advice")
def test_a_failing_design_says_so_first_and_exits_as_check_does(jams: str) -> None:
    run = CliRunner().invoke
    checked = run(app, ["check", jams, "--format", "json"])
    rows = json.loads(checked.stdout)["rows"]
    failed = [r["check"] for r in rows if r["passes"] is False]
    assert checked.exit_code == 1 and len(failed) >= 2
    for format in ("html", "pdf", "md"):
        found = run(app, ["report", jams, "--format", format])
        assert found.exit_code == 1, format
        text = found.stdout
        if format == "pdf":
            text = "\n".join(said(text)[0])
        first = min(text.index(f"{name} = ") for name in failed)
        assert text.index(f"{len(failed)} of {len(rows)} checks fail") < first
        assert first < text.index("An external wheel")
    _, page = made(jams)
    assert (page.state, len(page.reasons)) == ("fails", len(failed))
    (grid,) = (b for b in page.blocks if isinstance(b, Grid) and b.heads[0] == "Check")
    assert [row[0] for row in grid.rows if row[5] == "FAILS"] == failed


@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("format", ["html", "md"])
def test_a_users_words_stay_words(jams: str, format: str) -> None:
    text = CliRunner().invoke(app, ["report", jams, "--format", format]).stdout
    assert "<b>" not in text and "Größe ψ &lt;b&gt;" in text


def test_the_formats_go_by_the_extension(tmp_path: Path) -> None:
    spec = str(repo.DESIGNS / "spherical-z6.toml")
    files = (("a.html", "<!DOCTYPE"), ("a.htm", "<!DOCTYPE"), ("a.pdf", "%PDF-1.4"))
    for name, begin in some(files, files[1:]):
        file = tmp_path / name
        found = CliRunner().invoke(app, ["report", spec, "-o", str(file)])
        assert (found.exit_code, found.stdout) == (0, "")
        assert file.read_text(encoding="utf-8").startswith(begin)
    refused = CliRunner().invoke(app, ["report", spec, "-o", str(tmp_path / "a.svg")])
    assert refused.exit_code == 2 and ".html, .htm" in refused.output


def test_a_section_that_is_new_is_shown() -> None:
    design = Design.of(of("spherical-z6")[0].spec)
    table = design.report.table
    own = dict(zip(table.names, next(table.rows()), strict=True))
    wider = record_table({**own, "bell.mass_kg": 0.25}, table.title, table.prose)
    design.__dict__["report"] = design.report._replace(table=wider)
    found = document(design).blocks
    assert Facts("Bell", (Fact("Mass", 0.25, "kg"),)) in found


def test_inputs_say_what_is_a_default() -> None:
    design, found = of("turret")
    (grid,) = (b for b in found.blocks if isinstance(b, Grid) and b.heads[0] == "Key")
    rows = {row[0]: row[1:3] for row in grid.rows}
    assert rows["load.inertia_kgm2"] == (1.2, "kg m²")
    assert rows["drive.n_rpm"] == (design.spec.drive.n_rpm, "rpm")
    appendix = found.blocks[-1]
    assert isinstance(appendix, Facts)
    assert Fact("load.friction_at", "slot") in appendix.facts
    assert not {fact.name for fact in appendix.facts} & set(rows)


def test_sources_are_those_of_the_machine() -> None:
    for name, source in (("turret", "handbook no. 7"), ("cam-geneva", "law of sines")):
        told = next(b for b in reversed(of(name)[1].blocks) if isinstance(b, TextList))
        assert isinstance(told, TextList) and any(source in text for text in told.texts[:2])


def test_what_is_not_drawn_is_said_in_its_place(tmp_path: Path) -> None:
    assert any(isinstance(block, Picture) for block in of("turret")[1].blocks)
    (flat,) = (b for b in of("spherical-z6")[1].blocks if isinstance(b, Picture))
    assert flat.drawing.title == "Wheel and crank, laid flat"
    file = tmp_path / "spec.toml"
    file.write_text("[wheel]\nz = 400\n", encoding="utf-8")
    said_ = "".join(document_markdown.chunks(made(str(file))[1]))
    assert "Not drawn: z = 400" in said_


def test_a_value_that_is_none_of_a_number_is_never_shown() -> None:
    with pytest.raises(ArithmeticError, match="not a number"):
        value_text(math.nan)
    assert value_text(math.inf) == "no bound"
    assert (value_text(-0.0, "°"), value_text((1.0, 2.5), "mm")) == ("0°", "1 mm, 2.5 mm")
    assert value_text(1.21353e-6, "kg m²") == "1.21353\u00a0×\u00a010⁻⁶ kg m²"


def test_letters_beyond_the_western_ones_are_spelled() -> None:
    text = "ψ θ Ω d³ψ/dθ³ 10⁻⁶ 10⁻³ ≥ ñ ő Д 中 m²"
    spelled = western(text)
    assert spelled.encode("cp1252").decode("cp1252") == spelled
    assert spelled == "psi theta Omega d³psi/dtheta³ 10^-6 10^-3 >= ñ o [U+0414] [U+4E2D] m²"
    every = [chr(i) for i in range(32, 0x2800) if unicodedata.category(chr(i))[0] in "LNPS"]
    asked = [c for c in every if "?" in unicodedata.normalize("NFKD", c)]
    assert "?" in asked and len(asked) < 10
    assert "?" not in western("".join(c for c in every if c not in asked))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ["press-straight", "turret", "sine-group"])
def test_every_format_lists_the_same_warnings(name: str) -> None:
    """The wheel's own inertia was a warning of the page alone, not of json and the table."""
    design, page = of(name)
    at = [i for i, b in enumerate(page.blocks) if getattr(b, "text", "") == "Warnings"]
    block = page.blocks[at[0] + 1]
    assert isinstance(block, TextList)
    told = design.report.table.to_dict()["warnings"]
    assert block.texts == told == tuple(design.warnings)
    assert sum("the wheel's own inertia" in text for text in told) == 1


def test_a_unit_on_paper_is_not_broken() -> None:
    """In a column of short words a cell has one text, of a sentence several."""
    sentence = "a sentence that is long enough to be broken into lines " * 4
    table = Grid("", ("Key", "Unit", "Meaning"), (("inertia", "kg m²", sentence),))
    stream = "".join(item.draw(250.0) for item in pdf_table.grid(table))
    assert stream.count(r"(kg m\262) Tj") == 1
    assert sentence not in stream and "sentence" in stream
