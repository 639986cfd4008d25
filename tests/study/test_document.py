"""What is handed over: nothing of the report is missing, and it never disagrees with `check`."""

import functools
import json
import re
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
from geneva_cli.output import jsonfile
from geneva_cli.output.document import document_markdown, document_pdf, html
from geneva_cli.output.document.blocks import (
    Document,
    Fact,
    Facts,
    Grid,
    Picture,
    TextList,
    value_text,
)
from geneva_cli.output.letters import western
from geneva_cli.output.pdf.pdf_pages import wide
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
        patch.setattr("geneva_cli.verdict.report_sections.SAMPLES", 64)
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


def test_what_is_not_drawn_is_said_in_its_place(tmp_path: Path) -> None:
    assert any(isinstance(block, Picture) for block in of("turret")[1].blocks)
    (flat,) = (b for b in of("spherical-z6")[1].blocks if isinstance(b, Picture))
    assert flat.drawing.title == "Wheel and crank, laid flat"
    file = tmp_path / "spec.toml"
    file.write_text("[wheel]\nz = 400\n", encoding="utf-8")
    said_ = "".join(document_markdown.chunks(made(str(file))[1]))
    assert "Not drawn: z = 400" in said_


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
