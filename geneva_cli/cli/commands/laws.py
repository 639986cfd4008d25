"""``geneva laws``."""


def run(lambda_: float = 0.0, output: str = "-", format: str = "") -> None:
    """List the motion laws and their characteristic values.

    These are the greatest ds/du, d2s/du2 and d3s/du3, and the greatest product of the first two
    (power), with u and s from 0 to 1.

    Options:
      --lambda X  Shape of the sine group.

    Examples:
      geneva laws
      geneva laws --lambda 0.1 --format csv
    """
    from geneva_cli.output import show
    from geneva_cli.study.law_values import laws_table

    show(laws_table(lambda_), output, format)
