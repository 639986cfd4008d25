"""What is handed over: nothing of the report is missing, and it never disagrees with `check`."""

import base64
import functools
import json
import re
from collections.abc import Iterator
from typing import Any
from xml.etree import ElementTree

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli.answer import value_text
from geneva_cli.cli.app import app
from geneva_cli.design import Design, load
from geneva_cli.output import jsonfile
from geneva_cli.output.document import document_pdf, html
from geneva_cli.output.document.blocks import BAD, Document, Grid, Heading
from geneva_cli.study.document import document, short_document
from geneva_cli.verdict.failures import below_summary

pytestmark = pytest.mark.usefixtures("made_once")
# Loads and a motor; a sphere; tolerances; a linkage; a groove; unlike engagements.
KINDS = ("turret", "spherical-z6", "unequal-steps")
JAMS = (
    'title = "Größe ψ <b>&</b> 中"\n[wheel]\nz = 6\n[size]\nwheel_radius_mm = 120\n'
    "[load]\ninertia_kgm2 = 0.2\n[limits]\nacceleration_max = 1.0\n"
)


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


def parsed(text: str) -> ElementTree.Element:
    """A page as a strict reader sees it: every element is closed in its order."""
    closed = re.sub(r"<(meta|br|img|link)\b([^>]*?)/?>", r"<\1\2/>", text)
    return ElementTree.fromstring(closed.removeprefix("<!DOCTYPE html>"))


def cells_of(page: ElementTree.Element) -> list[str]:
    return ["".join(e.itertext()) for e in page.iter() if e.tag in ("th", "td", "li", "p", "h1")]


def values(tree: Any) -> list[Any]:
    """The values of a json object that are not null."""
    if isinstance(tree, dict):
        return [v for one in tree.values() for v in values(one)]
    if isinstance(tree, list):
        return [v for one in tree for v in values(one)]
    return [] if tree is None else [tree]


def has(cells: set[str], told: str, value: Any) -> bool:
    """Whether a value is in a cell, alone or before its unit; a text in any text."""
    if isinstance(value, float) and abs(value) < 1e-9:  # an angle of rounding
        return "0" in cells
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return value in told if isinstance(value, str) else value_text(value) in cells
    texts = {value_text(value, unit).removesuffix(f" {unit}") for unit in ("", "mm")}
    return bool({text.replace("\u00a0", " ") for text in texts} & cells)


@pytest.mark.long
@pytest.mark.parametrize("name", KINDS)
def test_every_value_of_the_report_is_on_the_page(name: str) -> None:
    design, found = of(name)
    shown = cells_of(parsed("".join(html.chunks(found))))
    told = "\n".join(shown)
    cells = {part for cell in shown for text in cell.split(", ") for part in _parts(text)}
    tree = json.loads("".join(jsonfile.chunks(below_summary(design.report.table))))
    assert tree.pop("spec") == design.spec.path
    assert tree.pop("passes") is True and tree.pop("chosen")
    every = values(tree)
    assert len(every) > 60
    assert [v for v in every if not has(cells, told, v)] == []
    assert not has(cells, told, 123.456) and not has(cells, told, "no such text")


def _parts(cell: str) -> list[str]:
    """A cell as it is, and without its unit."""
    bare = cell.removesuffix("°")
    head, _, _ = bare.rpartition(" ")
    return [cell, bare, head, bare.split(" ")[0], " ".join(bare.split(" ")[:3])]


@pytest.mark.sampled(40)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("file", sorted(repo.DESIGNS.glob("*.toml")), ids=lambda f: f.stem)
def test_a_report_for_a_first_reader_has_two_pages(file: Any) -> None:
    """Verdict, picture, motor, loads with limits, parts, warnings; words in place of keys."""
    design = load(str(file))
    short = short_document(design)
    heads = [block.text for block in short.blocks if isinstance(block, Heading)]
    assert heads == ["The machine", "Greatest loads", "Parts", "Warnings"]
    text = "".join(document_pdf.chunks(short))
    assert len(re.findall(r"/Type /Page\b", text)) == 2
    page = "".join(html.chunks(short))
    assert "material." not in page and "geneva explain" not in page and "Motor" in page
    grids = {block.heads: block for block in short.blocks if isinstance(block, Grid)}
    loads = next((grid for heads, grid in grids.items() if "Limit" in heads), None)
    assert bool(loads) or not design.cycle.is_loaded
    ends = ("_MPa", "pressure_angle_deg")
    stresses = {c.name: c for c in design.checks if c.name.endswith(ends) and c.value}
    limits = [row[5] for row in loads.rows if row[5] is not None] if loads else []
    assert set(limits) >= {c.limit for c in stresses.values()}


@pytest.mark.usefixtures("no_advice")
def test_a_report_shows_limits_beside_loads_and_what_fails() -> None:
    """A limit of the cycle's loads stands in the row of the load."""
    design = load(str(repo.DESIGNS / "turret.toml"), ["limits.pin_force_max_N=150"])
    (grid,) = (
        b for b in short_document(design).blocks if isinstance(b, Grid) and "Limit" in b.heads
    )
    (force,) = (row for row in grid.rows if row[0] == "Pin force")
    assert force[1:] == (
        design.loads["pin_force_N"].max,
        "N",
        pytest.approx(-24.071, abs=5e-4),
        "at most",
        150,
        BAD,
    )


@pytest.mark.long
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("name", KINDS)
def test_a_page_is_well_formed_and_needs_nothing_else(name: str) -> None:
    _, found = of(name)
    text = "".join(html.chunks(found))
    page = parsed(text)
    links = re.findall(r'\b(?:src|href|srcset)="([^"]*)"', text)
    data = "data:image/svg+xml;base64,"
    assert text.startswith("<!DOCTYPE html>")
    assert links and all(link.startswith(data) for link in links)
    assert "@import" not in text and "<script" not in text and "://" not in text
    assert b"<svg " in base64.b64decode(links[0].removeprefix(data))
    assert "nan" not in " ".join(cells_of(page)).split()
    # what stands in a table is named for who hears it
    assert all(table[0].tag == "caption" for table in page.iter("table"))
    heads = [*page.iter("th")]
    assert heads and all(head.get("scope") in ("row", "col") for head in heads)
    assert text == "".join(html.chunks(found))


@pytest.mark.long
@pytest.mark.usefixtures("no_advice")
def test_a_failing_design_says_so_first_and_exits_as_check_does(jams: str) -> None:
    run = CliRunner().invoke
    checked = run(app, ["check", jams, "--format", "json"])
    rows = json.loads(checked.stdout)["rows"]
    failed = [r["check"] for r in rows if r["passes"] is False]
    assert checked.exit_code == 1 and len(failed) >= 2
    for format in ("html", "md"):
        found = run(app, ["report", jams, "--format", format])
        assert found.exit_code == 1, format
        text = found.stdout
        first = min(text.index(words) for words in ("parts overlap by", "peak acceleration "))
        assert text.index(f"{len(failed)} of {len(rows)} checks fail") < first
        assert first < text.index("An external wheel")
    _, page = made(jams)
    assert (page.state, len(page.reasons)) == ("fails", len(failed))
    (grid,) = (b for b in page.blocks if isinstance(b, Grid) and b.heads[0] == "Check")
    assert [row[0] for row in grid.rows if row[5] == "FAILS"] == failed


@pytest.mark.sampled(2)
@pytest.mark.usefixtures("no_advice")
@pytest.mark.parametrize("format", ["html", "md"])
def test_a_users_words_stay_words(jams: str, format: str) -> None:
    text = CliRunner().invoke(app, ["report", jams, "--format", format]).stdout
    assert "<b>" not in text and "Größe ψ &lt;b&gt;" in text


def test_inputs_say_what_is_a_default() -> None:
    _, found = of("turret")
    (grid,) = (b for b in found.blocks if isinstance(b, Grid) and b.heads[0] == "Key")
    rows = {row[0]: row[1:3] for row in grid.rows}
    assert rows["load.inertia_kgm2"] == ("1.2", "kg m²")
    assert rows["drive.n_rpm"] == ("40", "rpm")
    appendix = found.blocks[-1]
    assert isinstance(appendix, Grid) and appendix.facts
    assert ("load.friction_at", "slot") in appendix.rows
    assert not {row[0] for row in appendix.rows} & set(rows)
