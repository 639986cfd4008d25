"""The example of the page about Python runs, and prints what it says."""

import re

from geneva_cli.manual import page


def test_the_page_runs_and_prints_what_it_says(capsys):
    blocks = re.findall(
        r"```python\n(.*?)```", page("python").partition("## An example")[2], re.DOTALL
    )
    names, said = {}, []
    for block in blocks:
        exec(compile(block, "block", "exec"), names)
        printed = capsys.readouterr().out.splitlines()
        comments = [line.split("  # ")[1:] for line in block.splitlines() if "print(" in line]
        said += [(p, c[0]) for p, c in zip(printed, comments, strict=False) if c]
    assert len(said) == 3 and all(out.startswith(comment.strip()) for out, comment in said)
