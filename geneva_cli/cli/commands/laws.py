"""``geneva laws``."""

from typing import Annotated

from geneva_cli.cli.command import Format, Output, option

EXAMPLES = ("geneva laws", "geneva laws --lambda 0.1 --format csv")


def run(
    shape: Annotated[float, option("X", "Shape of the sine group.", name="--lambda")] = 0.0,
    output: Output = "-",
    format: Format = "",
) -> None:
    """List the motion laws and their characteristic values.

    These are the greatest ds/du, d2s/du2 and d3s/du3, and the greatest product of the first two
    (power), with u and s from 0 to 1.
    """
    from geneva_cli.output import show
    from geneva_cli.study.law_values import laws_table

    show(laws_table(shape), output, format)
