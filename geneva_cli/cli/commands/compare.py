"""``geneva compare``."""

from geneva_cli.cli import command
from geneva_cli.errors import GenevaError


def run(
    specs: tuple[str, ...],
    vary: tuple[str, ...] = (),
    pick: str = "",
    against: str = "",
    ratio: bool = False,
    differing: bool = False,
    reverse: bool = False,
    settings: tuple[str, ...] = (),
    output: str = "-",
    format: str = "",
) -> None:
    """Designs side by side: a column for each design, a row for each quantity.

    --against compares one spec with a cam indexer and a servo.

    Options:
      --vary KEY=VALUES   One spec with several values: drive.A=0,0.3,0.6.
      --pick FIELD,...    Only these, as acceleration.max,dwell_s.
      --against NAME,...  One spec with cam, servo: the same step, time and load.
      --ratio             Numbers over the first design's.
      --differing         Only what differs.
      --reverse           Also each design turning the other way.

    Examples:
      geneva compare spec.toml --vary wheel.z=4,6,8 --pick dwell_s,acceleration.max
      geneva compare spec.toml --against cam,servo
    """
    from geneva_cli.design import load
    from geneva_cli.output import show
    from geneva_cli.study import compare

    if against:
        from geneva_cli.kept import load_extra

        if len(specs) > 1 or vary or pick or ratio or differing or reverse:
            raise GenevaError("--against: one spec, without --vary, --pick, --ratio and --reverse")
        table = load_extra("servo", "against")(specs[0], settings, command.words_in(against))
    else:
        designs = compare.designs_of(specs, settings, vary, reverse)
        table = compare.compare(designs, command.words_in(pick), ratio, bool(vary), differing)
    show(table, output, format, specs)
    for path in specs:
        command.say(path, load(path, settings).ideal_notes)
