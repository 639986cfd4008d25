"""``geneva table``."""

from typing import Annotated

from geneva_cli.cli.command import Format, Output, flag, option
from geneva_cli.errors import GenevaError
from geneva_cli.output import show

EXAMPLES = (
    "geneva table --z 3..12",
    "geneva table --z 4,6 --internal --format csv",
    "geneva table --z 6 --A 0.6 --n 90",
)


def run(
    z: Annotated[str, option("Z", "Slots: 6, 3..12 or 3,4,6.")] = "3..12",
    internal: Annotated[bool, flag("--internal", "Internal wheels.")] = False,
    spherical: Annotated[
        bool, flag("--spherical", "Spherical wheels, shafts at 90 degrees.")
    ] = False,
    n: Annotated[float, option("RPM", "Input speed.", name="--n")] = 60.0,
    rollers: Annotated[int, option("M", "Rollers on the crank.")] = 1,
    A: Annotated[float, option("X", "Side-crank offset; 0: plain crank.", name="--A")] = 0.0,
    output: Output = "-",
    format: Format = "",
) -> None:
    """Timing and peaks of wheels, one row for each number of slots."""
    from geneva_cli.study.survey import survey

    if internal and spherical:
        raise GenevaError("--internal with --spherical: choose one of them")
    gearing = "internal" if internal else "spherical" if spherical else "external"
    show(survey(z, gearing, n, rollers, A), output, format)
