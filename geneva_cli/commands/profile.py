"""``geneva profile``."""

from __future__ import annotations

from typing import Annotated

import typer

from geneva_cli.commands.options import Format, Output, SpecPath, warn


def run(
    spec: SpecPath,
    part: Annotated[str, typer.Option(metavar="PART", help="slot, gears or groove.")] = "slot",
    tolerance: Annotated[
        float, typer.Option(metavar="MM", help="Greatest distance from the true curve.")
    ] = 0.001,
    samples: Annotated[
        int | None, typer.Option(metavar="N", help="This many rows instead, evenly.")
    ] = None,
    output: Output = "-",
    format: Format = "",
) -> None:
    """The slot: pitch curve, both flanks, pressure angle and radius of curvature.

    In the wheel's frame, x towards the crank's axis at mid-motion. Left and right are the flanks
    as the pin travels in; the radius is positive where its centre lies to the left.
    """
    from geneva_cli.output import show
    from geneva_cli.part import part_table
    from geneva_cli.spec import load

    mechanism = load(spec)
    table = part_table(mechanism, part, tolerance, samples)
    show(table, output, format, mechanism.spec.files)
    warn(mechanism)
