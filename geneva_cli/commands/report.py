"""``geneva report``."""

from __future__ import annotations

from geneva_cli.commands.options import Format, Output, SpecPath, warn


def run(spec: SpecPath, output: Output = "-", format: Format = "") -> None:
    """One page on a design, for a person: words, timing, peaks, loads, sizes and warnings."""
    from geneva_cli.output import show
    from geneva_cli.report import report_table
    from geneva_cli.spec import load

    mechanism = load(spec)
    show(report_table(mechanism), output, format, mechanism.spec.files)
    warn(mechanism)
