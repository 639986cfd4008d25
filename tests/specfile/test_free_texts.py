"""Free texts of a spec: what is written is TOML, harms no terminal, and is read back unchanged."""

import re
from pathlib import Path

import pytest
import tomli
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.errors import GenevaError
from geneva_cli.spec.schema import TEXT_MAX
from geneva_cli.specfile.reader import Text, read
from geneva_cli.specfile.writer import quoted, spec_lines

# A line feed, terminal escapes, a bell, and letters that turn a line round or break it.
ODD = 'a\n\x1b[31mred\x1b]0;x\x07\x7f\x85b\u202ec\u2028\U000e0001"\\'
SPEC = f"""title = {quoted(ODD)}
[wheel]
z = 6
[[mass]]
shape = "point"
mass_kg = 1
radius_mm = 20
name = {quoted(ODD)}
[drawing]
number = {quoted(ODD)}
revision = {quoted(ODD)}
author = {quoted(ODD)}
date = {quoted(ODD)}
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("spec.toml").write_text(SPEC, encoding="utf-8")


def test_every_letter_is_read_back_and_shown() -> None:
    """By tomli, which refuses control characters in a text; surrogates are no letters."""
    letters = [*range(0x20C0), *range(0x2000, 0x2070), 0xFEFF, 0x1F600, 0xE0001, 0x10FFFF]
    for letter in map(chr, letters):
        written = quoted(letter)
        assert tomli.loads(f"x = {written}") == {"x": letter}
        assert written.isprintable()


def test_a_spec_is_read_back() -> None:
    spec = read("spec.toml").spec()
    assert spec.drawing.author == spec.mass[0].name == ODD
    again = Text("spec.toml", "\n".join(spec_lines(spec))).spec()
    assert (again.drawing, again.mass) == (spec.drawing, spec.mass)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "command",
    [
        "sweep spec.toml --vary drive.n_rpm=50..70 --random 4 --best min:acceleration.max",
        "animate spec.toml -o page.html",
        "export spec.toml --for laser -o out",
    ],
)
def test_what_is_written_harms_no_terminal(command: str) -> None:
    result = CliRunner().invoke(app, command.split())
    assert result.exit_code == 0
    files = [Path("page.html"), *(Path("out").glob("*.toml") if Path("out").exists() else [])]
    texts = [result.output, *(f.read_text(encoding="utf-8") for f in files if f.exists())]
    for text in texts:
        assert all(letter.isprintable() for letter in text if letter != "\n")
    assert any("\\u001B[31mred" in text for text in texts)


@pytest.mark.parametrize("key", ["title", "author", "name"])
def test_a_text_is_as_long_as_a_drawing_can_show(key: str) -> None:
    text = read("spec.toml").text
    for length in (TEXT_MAX, TEXT_MAX + 1):
        changed = re.sub(f"^{key} = .*", f'{key} = "{"x" * length}"', text, flags=re.M)
        if length == TEXT_MAX:
            Text("spec.toml", changed).spec()
            continue
        with pytest.raises(
            GenevaError, match=rf"spec.toml:\d+: .*{key} has 501 letters; at most 500"
        ):
            Text("spec.toml", changed).spec()


def test_bytes_of_a_shell_that_are_no_text() -> None:
    with pytest.raises(GenevaError, match="not UTF-8 text"):
        read("spec.toml", ["title=\udcff"]).spec()
