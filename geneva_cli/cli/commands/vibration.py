"""``geneva vibration``."""

from geneva_cli.cli.command import Reversible, say


def run(
    design: Reversible,
    period_ratio: float | None = None,
    damping: float | None = None,
    samples: int = 401,
    output: str = "-",
    format: str = "",
) -> None:
    """The load on an elastic shaft: vibration after each index, and the speeds to avoid.

    As csv the spectrum: the residual from half to twice the design's speed. At a
    speed to avoid the residual has a local maximum of at least 0.0001 of the step. `avoid` says
    how far it moves with a stiffness 20 % lower and higher.

    Options:
      --period-ratio X  Motion time over natural period, in place of [shaft].
      --damping Z       Damping ratio, in place of [shaft]'s.
      --samples N       Number of speeds in the csv.

    Examples:
      geneva vibration spec.toml --period-ratio 5.5 --damping 0.02
    """
    from geneva_cli.output import chosen, show, show_answer
    from geneva_cli.study.summary.report_summary import of_vibration

    if chosen(output, format) == "csv":
        table = design.spectrum(samples, period_ratio, damping)
        show(table, output, format, design.spec.files)
        say(design.spec.path, design.ideal_notes)
        return
    result = design.vibration(period_ratio, damping)
    show_answer(of_vibration(design, result), output, format, design.spec.files)
    if output != "-":
        say(design.spec.path, result.to_dict()["warnings"])
