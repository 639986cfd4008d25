"""``geneva peaks``."""

from geneva_cli.commands.options import Format, Given, Output, SpecPath, warn

EXAMPLES = (
    "geneva peaks spec.toml",
    "geneva peaks spec.toml --set wheel.z=5 --format json",
)


def run(spec: SpecPath, given: Given = None, output: Output = "-", format: Format = "") -> None:
    """Greatest velocity, acceleration, jerk and power of a design, as invariants.

    Angles are signed input angles from mid-motion. If engagements differ, these are the greatest of
    all.
    """
    from geneva_cli.design import load
    from geneva_cli.output import show

    design = load(spec, given or ())
    show(design.peaks_table, output, format, design.spec.files)
    warn(design)
