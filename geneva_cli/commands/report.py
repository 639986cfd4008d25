"""``geneva report``."""

from __future__ import annotations

import typer

from geneva_cli.commands.options import Format, Given, Output, SpecPath, say

EXAMPLES = (
    "geneva report spec.toml",
    "geneva report spec.toml -o report.json",
)


def run(spec: SpecPath, given: Given = None, output: Output = "-", format: Format = "") -> None:
    """One page on a design, for a person: failed checks, words, timing, peaks, loads, sizes.

    Exit status 1 where `check` has it: where a check fails.
    """
    from geneva_cli.design import load
    from geneva_cli.output import show

    design = load(spec, given or ())
    found = design.report
    show(found.table, output, format, design.spec.files)
    say(design.spec.path, found.cautions)
    if not found.passes:
        raise typer.Exit(1)
