"""``geneva table``."""

from geneva_cli.errors import GenevaError
from geneva_cli.output import show


def run(
    z: str = "3..12",
    internal: bool = False,
    spherical: bool = False,
    n: float = 60.0,
    rollers: int = 1,
    A: float = 0.0,
    output: str = "-",
    format: str = "",
) -> None:
    """Timing and peaks of wheels, one row for each number of slots.

    Options:
      --z Z        Slots: 6, 3..12 or 3,4,6.
      --internal   Internal wheels.
      --spherical  Spherical wheels, shafts at 90 degrees.
      --n RPM      Input speed.
      --rollers M  Rollers on the crank.
      --A X        Side-crank offset; 0: plain crank.

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
