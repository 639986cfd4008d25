"""``geneva report``."""

from __future__ import annotations

import typer

from geneva_cli.commands.options import Format, Output, SpecPath, say


def run(spec: SpecPath, output: Output = "-", format: Format = "") -> None:
    """One page on a design, for a person: failed checks, words, timing, peaks, loads, sizes.

    Exit status 1 where `check` has it: where a check fails.
    """
    from geneva_cli.output import show
    from geneva_cli.specfile.reader import load_and
    from geneva_cli.verdict.report import report

    mechanism, found = load_and(spec, lambda m: (m, report(m)))
    show(found.table, output, format, mechanism.spec.files)
    say(mechanism.spec.path, found.cautions)
    if not found.passes:
        raise typer.Exit(1)
