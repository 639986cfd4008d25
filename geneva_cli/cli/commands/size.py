"""``geneva size``."""

import os

from geneva_cli.cli.command import Design, tell


def run(design: Design, output: str = "", format: str = "") -> None:
    """The sizes that a rule or the load chose; with -o the spec that has them, so that they stay.

    What is written in a spec stays. A size that it leaves out is chosen anew in every run: by a
    rule, as a pin as thick as the roller's radius, or as large as the load of that run needs. So
    ask of a machine that is built "does it also run at 90?" with the spec that has its sizes.

    The written spec gives the same values as its origin, to the last digit, and has its comments.
    What needs a written thickness, as the wheel's own inertia, is known there besides. FILE as csv,
    json or md has the table instead.

    Options:
      -o, --output FILE  Write the spec with all its sizes.

    Examples:
      geneva size spec.toml
      geneva size spec.toml -o sized.toml
      geneva size spec.toml --set drive.n_rpm=90 -o fast.toml
    """
    from geneva_cli.output import FORMATS, chosen, named, require_spec, show_answer, show_text
    from geneva_cli.study.export import of_sizes, sized_text

    if not output or format or named(output, "") in FORMATS:
        output = output or "-"
        answer = of_sizes(design, chosen(output, format) == "json")
        show_answer(answer, output, format, design.spec.files)
        return
    require_spec(output)
    text, lost = sized_text(design)
    show_text(text, output, design.spec.files)
    if lost:
        tell(f"{output}: note: {lost}")
    beside = [os.path.basename(name) for name in design.spec.files[1:]]
    if beside and os.path.dirname(output) != os.path.dirname(design.spec.path):
        tell(f"{output}: warning: it needs {', '.join(beside)} in its folder")
