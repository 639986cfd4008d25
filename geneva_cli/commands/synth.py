"""``geneva synth``."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from geneva_cli.commands.options import Format, Output, warn


def run(
    tau: Annotated[str, typer.Option(metavar="X", help="Wish: motion / cycle.")] = "",
    k: Annotated[str, typer.Option("--k", metavar="X", help="Wish: motion / dwell.")] = "",
    motion_deg: Annotated[
        str, typer.Option(metavar="DEG", help="Wish: input angle of one motion.")
    ] = "",
    step: Annotated[str, typer.Option(metavar="DEG", help="Wish: the wheel's step.")] = "",
    acceleration_max: Annotated[
        str, typer.Option(metavar="X", help="Wish: greatest acceleration, an invariant.")
    ] = "",
    cycle: Annotated[
        str, typer.Option(metavar="S", help="Seconds from step to step; gives n_rpm.")
    ] = "",
    motion_s: Annotated[
        str, typer.Option(metavar="S", help="Seconds of motion, with --step and --cycle.")
    ] = "",
    z: Annotated[str, typer.Option(help="Slots: 6, 3..12 or 3,4,6.", show_default="3..24")] = "",
    internal: Annotated[bool, typer.Option("--internal", help="Internal wheels.")] = False,
    external: Annotated[bool, typer.Option("--external", help="External wheels.")] = False,
    spherical: Annotated[bool, typer.Option("--spherical", help="Spherical wheels.")] = False,
    rollers: Annotated[
        int | None, typer.Option(metavar="M", help="Rollers; without: see above.")
    ] = None,
    law: Annotated[
        str, typer.Option(metavar="NAME", help="Law of the curved slots, or all.")
    ] = "modified-sine",
    write: Annotated[
        int | None, typer.Option(metavar="N", help="Write row N as a spec instead.")
    ] = None,
    output: Output = "-",
    format: Format = "",
) -> None:
    """From a wish to machines that grant it, the lowest peak acceleration first.

    One of --tau, --k, --motion-deg, --step with --cycle, or --acceleration-max; numbers may be
    fractions.

    Tried for each wheel: the plain crank (it may miss the motion by a millionth), a side-crank,
    equal elliptical gears, and curved slots with an extra dwell. Side-crank and gears carry one
    roller, straight slots as many as leave a dwell, curved slots also more while their parts can
    be built. Spherical wheels stand at 90 deg, or with a plain crank at the angle that makes the
    motion; for --acceleration-max only the plain crank at 90 deg is tried.

    Column parts: no, with the reason, where flat parts cannot be built; maybe, where only turning
    them tells; else yes. --write turns the parts of its row.
    """
    from geneva_cli.errors import GenevaError, clean, cut
    from geneva_cli.output import format_of, show, show_text
    from geneva_cli.study.synthesis.search import for_people, synthesis, synthesis_table
    from geneva_cli.study.synthesis.target import read_wish

    wish = read_wish(
        tau=tau,
        k=k,
        motion_deg=motion_deg,
        step=step,
        cycle=cycle,
        motion_s=motion_s,
        acceleration_max=acceleration_max,
        z=z,
        internal=internal,
        external=external,
        spherical=spherical,
        rollers=rollers,
        law=law,
    )
    if write is None:
        if output.endswith(".toml") and not format:
            raise GenevaError(
                f"-o {cut(output, 300)}: a spec is one row of the table; add --write N"
            )
        name = format or format_of(output)
        table = synthesis_table(wish)
        show(for_people(table) if name in ("table", "md") else table, output, format)
        return
    from geneva_cli.design import Design
    from geneva_cli.study.synthesis.spec import chosen

    if format:
        raise GenevaError(f"--format {cut(format)}: --write writes a spec, which is TOML")
    found, text = chosen(wish, synthesis(wish), write)
    show_text(text, output)
    path = "<stdout>" if output == "-" else output
    if found.trouble:
        print(clean(f"{path}: warning: {found.trouble}"), file=sys.stderr)
    warn(Design.of(found.spec.but(path=path)))
