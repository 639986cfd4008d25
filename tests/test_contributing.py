"""The worked example of CONTRIBUTING, carried out in a copy of the program as it stands there."""

import re
import shutil
import subprocess
import sys

from repo import ROOT

PAGE = (ROOT / ".github" / "CONTRIBUTING.md").read_text(encoding="utf-8")
# The text that the example adds to, and the file that it adds to.
FILES = {
    "class Limits": "geneva_cli/spec/tables.py",
    "def limited": "geneva_cli/verdict/checks/motion.py",
    "LIMITS: ": "geneva_cli/verdict/checks/registry.py",
    "## dwell": "geneva_cli/manual/reference/checks.md",
    "def test": "tests/verdict/test_checks.py",
}


def run(folder, *words):
    python = [sys.executable, "-m", *words]
    return subprocess.run(python, cwd=folder, capture_output=True, text=True, check=False)


def test_the_example_of_a_key_and_its_check_does_what_the_page_says(tmp_path):
    for name in ("geneva_cli", "tests", "designs"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    example = PAGE.partition("### Example: a key and its check")[2].partition("\n## Style")[0]
    blocks = re.findall(r"```(\w+)\n(.*?)```", example, re.DOTALL)
    for _, block in blocks[:-1]:
        (name,) = {file for start, file in FILES.items() if block.startswith(start)}
        path = tmp_path / name
        text, (first, *lines) = path.read_text(encoding="utf-8"), block.splitlines()
        if lines[0] == "    ...":  # the last line belongs behind the first one of the file
            head = re.search(rf"(?m)^{re.escape(first)}\n", text).end()
            if first.startswith("class"):  # and behind its docstring
                head = text.index("    TABLE", head)
            added = f"{text[:head]}{lines[-1]}\n{text[head:]}"
        else:
            added = f"{text}\n\n{block}"
        path.write_text(added, encoding="utf-8")
    tested = run(tmp_path, "pytest", "-q", "tests/verdict/test_checks.py", "-k", "dwell_that_is")
    assert tested.returncode == 0, tested.stdout
    (tmp_path / "spec.toml").write_text("[wheel]\nz = 6\n[limits]\ndwell_min_s = 0.7\n")
    shown = run(tmp_path, "geneva_cli", "check", "spec.toml").stdout
    assert shown.startswith(blocks[-1][1])
