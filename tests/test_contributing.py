"""The worked examples of CONTRIBUTING, carried out in a copy of the program as they stand there."""

import re
import shutil
import subprocess
import sys

import pytest
from repo import ROOT

PAGE = (ROOT / ".github" / "CONTRIBUTING.md").read_text(encoding="utf-8")
PATH = re.compile(r"`([\w./-]+/[\w./-]+)`")


def run(folder, *words):
    python = [sys.executable, "-m", *words]
    return subprocess.run(python, cwd=folder, capture_output=True, encoding="utf-8", check=False)


def put(path, block):
    """Write a block of the page: a new file, text at a file's end, or lines of a list."""
    if not path.exists():
        path.parent.mkdir(exist_ok=True)
        path.write_text(block, encoding="utf-8")
        return
    text, (first, *lines) = path.read_text(encoding="utf-8"), block.splitlines()
    if lines[0] == "    ...":  # the others belong behind the first one of the file
        head = re.search(rf"(?m)^{re.escape(first)}\n", text).end()
        if first.startswith("class"):  # and behind its docstring
            head = text.index('    """\n\n', head) + 9
        text = "\n".join((text[:head].rstrip("\n"), *lines[1:], text[head:]))
    else:
        text = f"{text}\n\n{block}"
    path.write_text(text, encoding="utf-8")


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("example", "command"), [("a key and its check", "check"), ("a kind of machine", "peaks")]
)
def test_an_example_does_what_the_page_says(example, command, tmp_path):
    for name in ("geneva_cli", "tests", "designs"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    section = re.split(
        r"\n(?:### Example|## Style)", PAGE.partition(f"### Example: {example}\n")[2]
    )[0]
    parts = re.split(r"```(\w+)\n(.*?)```", section, flags=re.DOTALL)
    for said, block in zip(parts[:-4:3], parts[2:-3:3], strict=True):
        name = PATH.findall(said)[-1]  # the file that the page names last
        put(tmp_path / name, block)
    (test,) = re.findall(r"def (test_\w+)", block)
    tested = run(tmp_path, "pytest", "-q", f"{name}::{test}")
    assert tested.returncode == 0, tested.stdout
    if command == "peaks":
        run(tmp_path, "geneva_cli", "new", "reduced", "-o", "spec.toml")
    else:
        (tmp_path / "spec.toml").write_text("[wheel]\nz = 6\n[limits]\ntau_max = 0.3\n")
    shown = run(tmp_path, "geneva_cli", command, "spec.toml").stdout
    assert shown.startswith(parts[-2])
