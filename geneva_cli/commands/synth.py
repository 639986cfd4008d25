"""``geneva synth``."""

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from geneva_cli.commands import completion
from geneva_cli.commands.options import Format, Output, Settings, warn
from geneva_cli.errors import GenevaError, clean, cut

if TYPE_CHECKING:
    from geneva_cli.machine.spec import Spec
    from geneva_cli.study.target import Target

EXAMPLES = (
    "geneva synth --motion-deg 180 --z 6 --check 0",
    "geneva synth --dwell-s 0.8.. --cycle 1.5 --z 8 --check 0",
)


WANTED = "Wanted, a number or a range (0.2..0.3, 0.8.., ..180, 1/3)"
MACHINES = "Machines that are tried"
ROWS = "Rows"


def run(
    tau: Annotated[
        str, typer.Option(metavar="X", help="Motion / cycle.", rich_help_panel=WANTED)
    ] = "",
    motion_deg: Annotated[
        str,
        typer.Option(metavar="DEG", help="Input angle of one motion.", rich_help_panel=WANTED),
    ] = "",
    dwell_deg: Annotated[
        str, typer.Option(metavar="DEG", help="Input angle of a dwell.", rich_help_panel=WANTED)
    ] = "",
    motion_s: Annotated[
        str, typer.Option(metavar="S", help="Seconds of motion.", rich_help_panel=WANTED)
    ] = "",
    dwell_s: Annotated[
        str, typer.Option(metavar="S", help="Seconds of dwell.", rich_help_panel=WANTED)
    ] = "",
    cycle: Annotated[
        str, typer.Option(metavar="S", help="Seconds from step to step.", rich_help_panel=WANTED)
    ] = "",
    index_mm: Annotated[
        str,
        typer.Option(metavar="MM", help="Travel of a rack per step.", rich_help_panel=WANTED),
    ] = "",
    subject_to: Annotated[
        list[str] | None,
        typer.Option(
            metavar="BOUND",
            help='Of any quantity, as "jerk.max <= 5"; repeat.',
            autocompletion=completion.words(completion.fields),
            rich_help_panel=WANTED,
        ),
    ] = None,
    z: Annotated[
        str,
        typer.Option(
            metavar="Z",
            help="Slots: 6, 3..12 or 3,4,6.",
            show_default="3..24",
            rich_help_panel=MACHINES,
        ),
    ] = "",
    internal: Annotated[
        bool, typer.Option("--internal", help="Internal wheels.", rich_help_panel=MACHINES)
    ] = False,
    external: Annotated[
        bool, typer.Option("--external", help="External wheels.", rich_help_panel=MACHINES)
    ] = False,
    spherical: Annotated[
        bool, typer.Option("--spherical", help="Spherical wheels.", rich_help_panel=MACHINES)
    ] = False,
    linear: Annotated[
        bool, typer.Option("--linear", help="Racks alone.", rich_help_panel=MACHINES)
    ] = False,
    carousel: Annotated[
        str,
        typer.Option(
            metavar="N", help="Wheels on a carrier alone: 3, or 1..4.", rich_help_panel=MACHINES
        ),
    ] = "",
    rollers: Annotated[
        int | None,
        typer.Option(
            metavar="M", help="Rollers; without it, any number.", rich_help_panel=MACHINES
        ),
    ] = None,
    law: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Law of curved slots, or all.",
            autocompletion=completion.words(completion.laws),
            rich_help_panel=MACHINES,
        ),
    ] = "modified-sine",
    space: Annotated[
        str,
        typer.Option(
            metavar="X",
            help="Largest four-bar, in centre distances.",
            show_default="3",
            rich_help_panel=MACHINES,
        ),
    ] = "",
    from_: Annotated[
        str,
        typer.Option(
            "--from",
            metavar="SPEC",
            help="Take z, speed, sizes, loads and limits from it.",
            rich_help_panel=MACHINES,
        ),
    ] = "",
    settings: Settings = None,
    sort: Annotated[
        str,
        typer.Option(
            metavar="min:FIELD",
            help="The least first; max:FIELD: the greatest.",
            autocompletion=completion.words(completion.fields),
            rich_help_panel=ROWS,
        ),
    ] = "",
    check: Annotated[
        int,
        typer.Option(metavar="N", help="Turn and check the parts of N rows.", rich_help_panel=ROWS),
    ] = 20,
    buildable: Annotated[
        bool, typer.Option("--buildable", help="Only rows that pass.", rich_help_panel=ROWS)
    ] = False,
    write: Annotated[
        int | None,
        typer.Option(metavar="N", help="Write row N as a spec instead.", rich_help_panel=ROWS),
    ] = None,
    output: Output = "-",
    format: Format = "",
) -> None:
    """Find the machines that meet all requirements; the lowest peak comes first.
    The machines tried, and the columns: `geneva help search`.
    """
    from geneva_cli.synthesis.reading import read_target

    if settings and not from_:
        raise GenevaError("--set goes with --from: it changes a key of that spec")
    if check < 0 or (buildable and not check):
        raise GenevaError(f"--check {cut(check)}: it must be at least {int(buildable)}")
    if write is not None and write < 1:
        raise GenevaError(f"--write {cut(write)}: rows are numbered from 1")
    target = read_target(
        tau=tau,
        motion_deg=motion_deg,
        dwell_deg=dwell_deg,
        motion_s=motion_s,
        dwell_s=dwell_s,
        cycle=cycle,
        index_mm=index_mm,
        z=z,
        internal=internal,
        external=external,
        spherical=spherical,
        linear=linear,
        carousel=carousel,
        rollers=rollers,
        law=law,
        frame=_frame(from_, settings or ()) if from_ else None,
        sort=sort,
        subject_to=subject_to or (),
        space=space,
    )
    if write is None:
        _show(target, check, buildable, output, format)
    else:
        _write(target, write, buildable, output, format)


def _frame(path: str, settings: Sequence[str]) -> "Spec":
    from geneva_cli.design import load

    return load(path, settings).frame


def _inputs(target: "Target") -> Sequence[str]:
    """The files that the requirement was read from."""
    return target.frame.files if target.frame else ()


def _show(target: "Target", check: int, buildable: bool, output: str, format: str) -> None:
    from geneva_cli.output import is_seen, show
    from geneva_cli.output.formats import format_of
    from geneva_cli.synthesis.shown import for_people, for_terminal
    from geneva_cli.synthesis.table import synthesis_table

    if output.endswith(".toml") and not format:
        raise GenevaError(f"-o {cut(output, 300)}: a spec is one row of the table; add --write N")
    name = format or format_of(output)
    table = synthesis_table(target, check, buildable)
    if name == "table" and is_seen(output):
        table = for_terminal(table, max(check, 20))  # no fewer than are turned by default
    elif name in ("table", "md"):
        table = for_people(table)
    show(table, output, format, _inputs(target))


def _write(target: "Target", number: int, buildable: bool, output: str, format: str) -> None:
    from geneva_cli.design import Design
    from geneva_cli.output import show_text
    from geneva_cli.synthesis.search import search
    from geneva_cli.synthesis.written import chosen

    if format:
        raise GenevaError(f"--format {cut(format)}: --write writes a spec, which is TOML")
    if output != "-" and not output.endswith(".toml"):
        raise GenevaError(f'-o "{cut(output, 300)}": --write writes a spec: it must end in .toml')
    row, text = chosen(search(target), number, buildable)
    show_text(text, output, _inputs(target))
    path = "<stdout>" if output == "-" else output
    if row.trouble:
        note = f"{path}: warning: its parts cannot be built: {row.trouble}"
        print(clean(note), file=sys.stderr)
    warn(Design.of(row.spec.replace(path=path)))
