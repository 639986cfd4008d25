"""``geneva table``."""

from geneva_cli.cli.command import FORMAT, OUTPUT, flag, option
from geneva_cli.errors import GenevaError
from geneva_cli.output import show


def run(
    z: str = option("3..12", "Z", "Slots: 6, 3..12 or 3,4,6."),
    internal: bool = flag("--internal", "Internal wheels."),
    spherical: bool = flag("--spherical", "Spherical wheels, shafts at 90 degrees."),
    n: float = option(60.0, "RPM", "Input speed.", name="--n"),
    rollers: int = option(1, "M", "Rollers on the crank."),
    A: float = option(0.0, "X", "Side-crank offset; 0: plain crank.", name="--A"),
    output: str = OUTPUT,
    format: str = FORMAT,
) -> None:
    """Timing and peaks of wheels, one row for each number of slots.

    Examples:
        geneva table --z 3..12
        geneva table --z 4,6 --internal --format csv
        geneva table --z 6 --A 0.6 --n 90
    """
    from geneva_cli.study.survey import survey

    if internal and spherical:
        raise GenevaError("--internal with --spherical: choose one of them")
    gearing = "internal" if internal else "spherical" if spherical else "external"
    show(survey(z, gearing, n, rollers, A), output, format)
