"""``geneva motion``."""

from typing import Annotated

import typer

from geneva_cli.commands.options import Format, Output, Settings, SpecPath, warn

EXAMPLES = (
    "geneva motion spec.toml --samples 13",
    "geneva motion spec.toml -o motion.csv",
)


def run(
    spec: SpecPath,
    samples: Annotated[int, typer.Option(metavar="N", help="Rows, both ends included.")] = 361,
    settings: Settings = None,
    output: Output = "-",
    format: Format = "",
) -> None:
    """Position, velocity, acceleration and jerk over a cycle from entry.

    If the engagements differ, it covers a whole period of the machine.
    """
    from geneva_cli.design import load
    from geneva_cli.output import show

    design = load(spec, settings or ())
    show(design.motion(samples), output, format, design.spec.files)
    warn(design)
