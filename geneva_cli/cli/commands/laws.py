"""``geneva laws``."""

from geneva_cli.cli.command import FORMAT, OUTPUT, option


def run(
    shape: float = option(0.0, "X", "Shape of the sine group.", name="--lambda"),
    output: str = OUTPUT,
    format: str = FORMAT,
) -> None:
    """List the motion laws and their characteristic values.

    These are the greatest ds/du, d2s/du2 and d3s/du3, and the greatest product of the first two
    (power), with u and s from 0 to 1.

    Examples:
        geneva laws
        geneva laws --lambda 0.1 --format csv
    """
    from geneva_cli.output import show
    from geneva_cli.study.law_values import laws_table

    show(laws_table(shape), output, format)
