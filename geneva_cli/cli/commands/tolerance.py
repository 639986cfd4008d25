"""``geneva tolerance``."""

from geneva_cli.cli.command import Design, say


def run(
    design: Design,
    samples: int = 65536,
    seed: int = 0,
    radius: float | None = None,
    output: str = "-",
    format: str = "",
) -> None:
    """The wheel's place in the dwell, its play in motion and its entry, from [tolerance].

    Worst case, root sum of squares and Monte Carlo, in degrees and arc seconds. How much each
    dimension contributes, and the clearances with which every machine still turns.

    Options:
      --samples N  Number of machines to draw.
      --seed K     The same seed, the same machines.
      --radius MM  Show micrometres too, at this radius.

    Examples:
      geneva tolerance spec.toml --set tolerance.slot_angle_deg=0.01
    """
    from geneva_cli.output import is_for_people, show_answer
    from geneva_cli.study.summary.report_summary import of_tolerance

    table = design.tolerance(samples, seed, radius)
    show_answer(of_tolerance(design, table), output, format, design.spec.files)
    # the warnings of tolerances only
    if output != "-" or not is_for_people(output, format):
        say(design.spec.path, design.motion_warnings)
    if output != "-":
        say(design.spec.path, table.to_dict()["warnings"])
