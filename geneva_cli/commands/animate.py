"""``geneva animate``."""

from typing import Annotated

import typer

from geneva_cli.commands.options import Given, SpecPath, warn

EXAMPLES = ("geneva animate spec.toml -o machine.html",)


def run(
    spec: SpecPath,
    given: Given = None,
    output: Annotated[
        str,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Write to this .html, .gif or .svg; - prints html.",
        ),
    ] = "-",
) -> None:
    """A page that needs no network, on which the machine turns.

    Its parts and links as they are cut, gears, the contact's force, what holds the wheel, and the
    curves with a cursor; played, or moved by a slider over the input's angle. A .gif needs the
    extra plot; an .svg stands still.
    """
    from geneva_cli.design import load
    from geneva_cli.output import animate
    from geneva_cli.study.animation.scene import scene

    design = load(spec, given or ())
    animate(scene(design), output, design.spec.files)
    warn(design)
