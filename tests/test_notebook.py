"""The example notebook, run cell by cell, and how a notebook shows a design."""

import ast
import base64
import json
import re
from xml.etree import ElementTree

import pytest
from repo import DESIGNS, ROOT

from geneva_cli import load
from geneva_cli.manual import page

NOTEBOOK = json.loads(
    (ROOT / "geneva_cli" / "manual" / "howto" / "choosing.ipynb").read_text(encoding="utf-8")
)


def displayed(source, names):
    """What a notebook displays of a cell: the value of its last expression."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    if last is None:
        return None
    return eval(compile(ast.Expression(last.value), "cell", "eval"), names)


def test_the_example_runs_and_shows_what_it_says():
    names, shown = {}, []
    for cell in NOTEBOOK["cells"]:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None
            shown.append(displayed("".join(cell["source"]), names))
    design, answers, rows, cycle, table = shown
    assert "<img" in design._repr_html_() and "<table" in table._repr_html_()
    # as the turret of theory-loads: 75.2 W, 5.816 N m; 135 of 360 degrees move at 40 rpm
    assert answers == pytest.approx((0.9375, 75.22014, 5.815886), rel=1e-6)
    dwells, accelerations = [r[1] for r in rows], [r[2] for r in rows]
    assert dwells == sorted(dwells, reverse=True) and accelerations[0] > accelerations[1]
    assert cycle[1] == pytest.approx(17.957, rel=1e-3)


def test_the_page_runs_cell_by_cell_and_prints_what_it_says(capsys):
    blocks = re.findall(
        r"```python\n(.*?)```", page("python").partition("## In a notebook")[2], re.DOTALL
    )
    names, said = {}, []
    for block in blocks:
        displayed(block, names)
        printed = capsys.readouterr().out.splitlines()
        comments = [line.split("  # ")[1:] for line in block.splitlines() if "print(" in line]
        said += [(p, c[0]) for p, c in zip(printed, comments, strict=False) if c]
    assert len(said) == 3 and all(out.startswith(comment.strip()) for out, comment in said)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ["two-rollers-side-crank", "spherical-z6", "gear-sector"])
def test_a_design_shows_its_pictures_and_its_verdict(name):
    html = load(str(DESIGNS / f"{name}.toml"))._repr_html_()
    pictures = re.findall(r"base64,([^\"]+)", html)
    assert len(pictures) == 2
    for picture in pictures:
        assert ElementTree.fromstring(base64.b64decode(picture)).tag.endswith("svg")
    assert re.search(r"<b>(all \d+ checks pass|\d+ of \d+ checks pass, 1 not proved)", html)
    assert "<details>" in html
