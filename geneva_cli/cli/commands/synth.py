"""``geneva synth``."""

from geneva_cli.cli.command import say, tell
from geneva_cli.errors import GenevaError, cut


def run(
    tau: str = "",
    motion_deg: str = "",
    dwell_deg: str = "",
    motion_s: str = "",
    dwell_s: str = "",
    cycle: str = "",
    subject_to: tuple[str, ...] = (),
    z: str = "",
    internal: bool = False,
    external: bool = False,
    spherical: bool = False,
    rollers: int | None = None,
    law: str = "modified-sine",
    space: str = "",
    from_: str = "",
    settings: tuple[str, ...] = (),
    sort: str = "",
    check: int = 20,
    buildable: bool = False,
    write: int | None = None,
    output: str = "-",
    format: str = "",
) -> None:
    """Find the machines that meet all requirements; the lowest peak comes first.
    The machines tried, and the columns: `geneva help search`.

    Wanted, a number or a range (0.2..0.3, 0.8.., ..180, 1/3):
      --tau X             Motion / cycle.
      --motion-deg DEG    Input angle of one motion.
      --dwell-deg DEG     Input angle of a dwell.
      --motion-s S        Seconds of motion.
      --dwell-s S         Seconds of dwell.
      --cycle S           Seconds from step to step.
      --subject-to BOUND  Of any quantity, as "jerk.max <= 5"; repeat.

    Machines that are tried:
      --z Z        Slots: 6, 3..12 or 3,4,6.  [default: (3..24)]
      --internal   Internal wheels.
      --external   External wheels.
      --spherical  Spherical wheels.
      --rollers M  Rollers; without it, any number.
      --law NAME   Law of curved slots, or all.
      --space X    Largest four-bar, in centre distances.  [default: (3)]
      --from SPEC  Take z, speed, sizes, loads and limits from it.

    Rows:
      --sort min:FIELD  The least first; max:FIELD: the greatest.
      --check N         Turn and check the parts of N rows.
      --buildable       Only rows that pass.
      --write N         Write row N as a spec instead.

    Examples:
      geneva synth --motion-deg 180 --z 6 --check 0
      geneva synth --dwell-s 0.8.. --cycle 1.5 --z 8 --check 0
    """
    typed = locals()
    from geneva_cli.design import Design
    from geneva_cli.output import is_for_people, is_seen, require_spec, show, show_text
    from geneva_cli.study.synth.reading import read_frame, read_target
    from geneva_cli.study.synth.synth_search import search
    from geneva_cli.study.synth.synth_table import chosen, for_people, synthesis_table

    if settings and not from_:
        raise GenevaError("--set goes with --from: it changes a key of that spec")
    if check < 0 or (buildable and not check):
        raise GenevaError(f"--check {cut(check)}: it must be at least {int(buildable)}")
    if write is not None and write < 1:
        raise GenevaError(f"--write {cut(write)}: rows are numbered from 1")
    frame = read_frame(from_, settings) if from_ else None
    target = read_target(frame, **typed)
    if write is None:
        if output.endswith(".toml") and not format:
            text = "a spec is one row of the table; add --write N"
            raise GenevaError(f"-o {cut(output, 300)}: {text}")
        table = synthesis_table(target, check, buildable)
        if is_for_people(output, format):
            # a terminal shows no fewer than are turned by default
            table = for_people(table, max(check, 20) if is_seen(output) else None)
        show(table, output, format, target.own.files)
        return
    require_spec(output, format)
    row, text = chosen(target, search(target), write)
    show_text(text, output, target.own.files)
    path = "<stdout>" if output == "-" else output
    if row.trouble:
        tell(f"{path}: warning: its parts cannot be built: {row.trouble}")
    say(path, Design.of(row.spec.replace(path=path)).motion_warnings)
