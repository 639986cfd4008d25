"""``geneva check``."""

import os

import typer

from geneva_cli.cli.command import say, tell
from geneva_cli.errors import open_warnings


def run(
    specs: tuple[str, ...],
    strict: bool = False,
    verbose: bool = False,
    reverse: bool = False,
    certify: float | None = None,
    wheel: str | None = None,
    crank: str | None = None,
    slack: float | None = None,
    settings: tuple[str, ...] = (),
    output: str = "-",
    format: str = "",
) -> None:
    """Check designs: failures with their remedies, warnings, and the tightest check.

    It checks the motion, the parts and the spec's own [limits]. With -v, or as csv, json or md,
    there is a row for each check. The exit status is 1 if a check fails. If one spec cannot be
    read, the others are still checked.

    Options:
      --strict       Exit 1 on a warning too.
      -v, --verbose  Every check, a row each.
      --certify MM   Prove that no parts overlap by more.

    A drawing from elsewhere:
      --wheel FILE  The wheel as somebody drew it: .dxf or .svg.
      --crank FILE  The crank: .dxf or .svg.
      --slack MM    Overlap that counts as touching.  [default: 1e-6, or 0.001]

    Examples:
      geneva check spec.toml
      geneva check spec.toml --set size.slot_clearance_mm=0.05
    """
    from geneva_cli.output import chosen, show_answer
    from geneva_cli.study.verdicts import of_checks, verdicts

    name, changes = chosen(output, format), list(settings)
    for part, path in (("wheel", wheel), ("crank", crank)):  # files of this folder
        if path is not None:
            changes.append(f"outline.{part}={os.path.abspath(path)}")
    if slack is not None:
        changes.append(f"outline.slack_mm={slack}")
    results, files, unread = list(verdicts(specs, changes, certify, reverse)), list[str](), 0
    for v in results:
        files += v.files
        unread += bool(v.error)
    if unread < len(results) or name == "json":
        answer = of_checks(results, verbose or name != "table", name == "json")
        show_answer(answer, output, format, files)
    fails = False
    for v in results:
        if v.error:
            tell(v.error)
        elif output != "-" or name == "csv":
            say(v.path, v.warnings)
        fails = fails or not v.passes or (strict and bool(open_warnings(v.warnings)))
    raise typer.Exit(2 if unread else int(fails))
