"""``geneva synth``."""

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import typer

from geneva_cli.commands import completion
from geneva_cli.commands.options import Format, Given, Output, warn
from geneva_cli.errors import GenevaError, clean, cut

if TYPE_CHECKING:
    from geneva_cli.machine.spec import Spec
    from geneva_cli.study.synthesis.wish import Wish

EXAMPLES = (
    "geneva synth --motion-deg 180 --z 6 --check 0",
    "geneva synth --dwell-s 0.8.. --cycle 1.5 --z 8 --sort min:jerk.max --check 0",
)


def run(
    tau: Annotated[str, typer.Option(metavar="X", help="Wish: motion / cycle.")] = "",
    motion_deg: Annotated[
        str, typer.Option(metavar="DEG", help="Wish: input angle of one motion.")
    ] = "",
    dwell_deg: Annotated[
        str, typer.Option(metavar="DEG", help="Wish: input angle of a dwell.")
    ] = "",
    motion_s: Annotated[str, typer.Option(metavar="S", help="Wish: seconds of motion.")] = "",
    dwell_s: Annotated[str, typer.Option(metavar="S", help="Wish: seconds of dwell.")] = "",
    cycle: Annotated[str, typer.Option(metavar="S", help="Wish: seconds from step to step.")] = "",
    subject_to: Annotated[
        list[str] | None,
        typer.Option(
            metavar="BOUND",
            help='Wish: "jerk.max <= 5", any quantity; repeat.',
            autocompletion=completion.words(completion.fields),
        ),
    ] = None,
    z: Annotated[str, typer.Option(help="Slots: 6, 3..12 or 3,4,6.", show_default="3..24")] = "",
    internal: Annotated[bool, typer.Option("--internal", help="Internal wheels.")] = False,
    external: Annotated[bool, typer.Option("--external", help="External wheels.")] = False,
    spherical: Annotated[bool, typer.Option("--spherical", help="Spherical wheels.")] = False,
    rollers: Annotated[
        int | None, typer.Option(metavar="M", help="Rollers; without: see above.")
    ] = None,
    law: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Law of curved slots and cams, or all.",
            autocompletion=completion.words(completion.laws),
        ),
    ] = "modified-sine",
    from_: Annotated[
        str,
        typer.Option("--from", metavar="SPEC", help="Its z, speed, sizes, loads, limits for all."),
    ] = "",
    given: Given = None,
    space: Annotated[
        str,
        typer.Option(
            metavar="X",
            help="Four-bars: joints at most X centre distances from the crank.",
            show_default="3",
        ),
    ] = "",
    sort: Annotated[
        str,
        typer.Option(
            metavar="min:FIELD",
            help="The least of it first; max:FIELD the greatest.",
            autocompletion=completion.words(completion.fields),
        ),
    ] = "",
    check: Annotated[
        int,
        typer.Option(metavar="N", help="Turn the parts of so many rows; 0 for none."),
    ] = 20,
    buildable: Annotated[
        bool, typer.Option("--buildable", help="Only rows that pass, --check many: see above.")
    ] = False,
    write: Annotated[
        int | None, typer.Option(metavar="N", help="Write row N as a spec instead.")
    ] = None,
    output: Output = "-",
    format: Format = "",
) -> None:
    """From wishes to machines that grant them all, the lowest peak acceleration first.

    Where seconds are asked for, or --from gives a speed, peaks are compared in rad/s2.

    Numbers may be fractions, and where there is an angle, a time, tau or k also ranges: 0.2..0.3,
    0.8.. or ..180. In a range the machine of each kind is the one with the lowest peak, or with
    the least of --sort; with bounds, no wish for a motion and no --sort, the one that keeps them
    nearest to the plain crank (a four-bar: the gentlest, of the plain crank's motion if it can). A
    bound on tau, k, motion_deg or dwell_deg is a wish for a motion; with --cycle or --from, one on
    seconds of motion or dwell too.

    Tried for each wheel: the plain crank (it may miss the motion by a millionth), also with slots a
    tenth of the centre distance aside, or as far as a bound or --sort has them; a side-crank; equal
    elliptical gears; a planet gear (z 3, 4, 6); a four-bar's coupler; curved slots and a cam, with
    an extra dwell. Side-crank, gears, planet and four-bar carry one roller, straight slots as many
    as leave a dwell, curved slots and cams also more while their parts can be built. Where a range
    has no other end, a hundredth of the cycle is left to motion and to dwell. --law all takes
    seconds more. Spherical wheels stand at 90 deg, or with a plain crank at the angle that makes
    the motion; with a side-crank also at the best angle, where both are a hundredth better than
    either alone.

    The four-bar is the best found among proportions whose crank turns all round, whose joints keep
    to --space and whose roller passes the wheel on its way back; where --sort or a bound is not on
    times, peaks or entries, the best of its gentlest seven. A machine is named by its crank,
    ground, coupler, rocker and the roller's distance on the coupler, in mm. Something else must
    hold its wheel at rest: "detent".

    Column parts: yes for parts that were turned and pass every check, with sizes chosen so that
    they do; no, with the reason; maybe for those below the first twenty (--check). --write turns
    the parts of its row. Where one of the first twenty says no without being turned, the best of
    its range that is found to pass is a row too; --buildable shows rows that pass, and for any
    that fails in its turn the best of its range that is found to, under its number.
    """
    from geneva_cli.study.synthesis.reading import read_wish

    if given and not from_:
        raise GenevaError("--set goes with --from: it changes a key of that spec")
    if check < 0 or (buildable and not check):
        raise GenevaError(f"--check {cut(check)}: it must be at least {int(buildable)}")
    if write is not None and write < 1:
        raise GenevaError(f"--write {cut(write)}: rows are numbered from 1")
    wish = read_wish(
        tau=tau,
        motion_deg=motion_deg,
        dwell_deg=dwell_deg,
        motion_s=motion_s,
        dwell_s=dwell_s,
        cycle=cycle,
        z=z,
        internal=internal,
        external=external,
        spherical=spherical,
        rollers=rollers,
        law=law,
        frame=_frame(from_, given or ()) if from_ else None,
        sort=sort,
        subject_to=subject_to or (),
        space=space,
    )
    if write is None:
        _show(wish, check, buildable, output, format)
    else:
        _write(wish, write, buildable, output, format)


def _frame(path: str, given: Sequence[str]) -> "Spec":
    from geneva_cli.design import load

    return load(path, given).spec


def _inputs(wish: "Wish") -> Sequence[str]:
    """The files that the wish was read from."""
    return wish.frame.files if wish.frame else ()


def _show(wish: "Wish", check: int, buildable: bool, output: str, format: str) -> None:
    from geneva_cli.output import show
    from geneva_cli.output.formats import format_of
    from geneva_cli.study.synthesis.shown import for_people
    from geneva_cli.study.synthesis.table import synthesis_table

    if output.endswith(".toml") and not format:
        raise GenevaError(f"-o {cut(output, 300)}: a spec is one row of the table; add --write N")
    name = format or format_of(output)
    table = synthesis_table(wish, check, buildable)
    show(for_people(table) if name in ("table", "md") else table, output, format, _inputs(wish))


def _write(wish: "Wish", number: int, buildable: bool, output: str, format: str) -> None:
    from geneva_cli.design import Design
    from geneva_cli.output import show_text
    from geneva_cli.study.synthesis.search import search
    from geneva_cli.study.synthesis.written import chosen

    if format:
        raise GenevaError(f"--format {cut(format)}: --write writes a spec, which is TOML")
    if output != "-" and not output.endswith(".toml"):
        raise GenevaError(f'-o "{cut(output, 300)}": --write writes a spec: it must end in .toml')
    found, text = chosen(search(wish), number, buildable)
    show_text(text, output, _inputs(wish))
    path = "<stdout>" if output == "-" else output
    if found.trouble:
        said = f"{path}: warning: its parts cannot be built: {found.trouble}"
        print(clean(said), file=sys.stderr)
    warn(Design.of(found.spec.replace(path=path)))
