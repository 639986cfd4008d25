"""``geneva peaks``."""

from __future__ import annotations

from geneva_cli.commands.options import Format, Output, SpecPath, warn


def run(spec: SpecPath, output: Output = "-", format: Format = "") -> None:
    """Greatest velocity, acceleration, jerk and power of a design, as invariants.

    Angles are signed input angles from mid-motion. Where the stations differ, the greatest of all.
    """
    from geneva_cli.analysis.peaks import peaks_table
    from geneva_cli.output import show
    from geneva_cli.specfile.reader import load

    mechanism = load(spec)
    show(peaks_table(mechanism), output, format, mechanism.spec.files)
    warn(mechanism)
