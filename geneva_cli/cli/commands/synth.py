"""``geneva synth``."""

from typing import TYPE_CHECKING

from geneva_cli.cli.command import FORMAT, OUTPUT, SETTINGS, flag, option, say, tell
from geneva_cli.errors import GenevaError, cut

if TYPE_CHECKING:
    from geneva_cli.study.target import Target


WANTED = "Wanted, a number or a range (0.2..0.3, 0.8.., ..180, 1/3)"
MACHINES = "Machines that are tried"
ROWS = "Rows"


def run(
    tau: str = option("", "X", "Motion / cycle.", WANTED),
    motion_deg: str = option("", "DEG", "Input angle of one motion.", WANTED),
    dwell_deg: str = option("", "DEG", "Input angle of a dwell.", WANTED),
    motion_s: str = option("", "S", "Seconds of motion.", WANTED),
    dwell_s: str = option("", "S", "Seconds of dwell.", WANTED),
    cycle: str = option("", "S", "Seconds from step to step.", WANTED),
    subject_to: list[str] = option(
        (), "BOUND", 'Of any quantity, as "jerk.max <= 5"; repeat.', WANTED
    ),
    z: str = option("", "Z", "Slots: 6, 3..12 or 3,4,6.", MACHINES, show="3..24"),
    internal: bool = flag("--internal", "Internal wheels.", MACHINES),
    external: bool = flag("--external", "External wheels.", MACHINES),
    spherical: bool = flag("--spherical", "Spherical wheels.", MACHINES),
    rollers: int | None = option(None, "M", "Rollers; without it, any number.", MACHINES),
    law: str = option("modified-sine", "NAME", "Law of curved slots, or all.", MACHINES),
    space: str = option("", "X", "Largest four-bar, in centre distances.", MACHINES, show="3"),
    from_: str = option(
        "", "SPEC", "Take z, speed, sizes, loads and limits from it.", MACHINES, name="--from"
    ),
    settings: list[str] = SETTINGS,
    sort: str = option("", "min:FIELD", "The least first; max:FIELD: the greatest.", ROWS),
    check: int = option(20, "N", "Turn and check the parts of N rows.", ROWS),
    buildable: bool = flag("--buildable", "Only rows that pass.", ROWS),
    write: int | None = option(None, "N", "Write row N as a spec instead.", ROWS),
    output: str = OUTPUT,
    format: str = FORMAT,
) -> None:
    """Find the machines that meet all requirements; the lowest peak comes first.
    The machines tried, and the columns: `geneva help search`.

    Examples:
        geneva synth --motion-deg 180 --z 6 --check 0
        geneva synth --dwell-s 0.8.. --cycle 1.5 --z 8 --check 0
    """
    options = locals()
    from geneva_cli.study.synth.reading import OPTIONS, read_frame, read_target

    if settings and not from_:
        raise GenevaError("--set goes with --from: it changes a key of that spec")
    if check < 0 or (buildable and not check):
        raise GenevaError(f"--check {cut(check)}: it must be at least {int(buildable)}")
    if write is not None and write < 1:
        raise GenevaError(f"--write {cut(write)}: rows are numbered from 1")
    frame = read_frame(from_, settings) if from_ else None
    wanted = {name: text for name, text in options.items() if name in OPTIONS}
    target = read_target(frame=frame, subject_to=subject_to, **wanted)
    if write is None:
        _show(target, check, buildable, output, format)
    else:
        _write(target, write, output, format)


def _show(target: "Target", check: int, buildable: bool, output: str, format: str) -> None:
    from geneva_cli.output import is_for_people, is_seen, show
    from geneva_cli.study.synth.synth_table import for_people, synthesis_table

    if output.endswith(".toml") and not format:
        raise GenevaError(f"-o {cut(output, 300)}: a spec is one row of the table; add --write N")
    table = synthesis_table(target, check, buildable)
    if is_for_people(output, format):
        # a terminal shows no fewer than are turned by default
        table = for_people(table, max(check, 20) if is_seen(output) else None)
    show(table, output, format, target.own.files)


def _write(target: "Target", number: int, output: str, format: str) -> None:
    from geneva_cli.design import Design
    from geneva_cli.output import require_spec, show_text
    from geneva_cli.study.synth.synth_search import search
    from geneva_cli.study.synth.synth_table import chosen

    require_spec(output, format)
    row, text = chosen(target, search(target), number)
    show_text(text, output, target.own.files)
    path = "<stdout>" if output == "-" else output
    if row.trouble:
        tell(f"{path}: warning: its parts cannot be built: {row.trouble}")
    say(path, Design.of(row.spec.replace(path=path)).motion_warnings)
