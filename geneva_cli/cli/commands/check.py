"""``geneva check``."""

import os
from typing import Annotated

import typer

from geneva_cli.cli.command import Format, Output, Reverse, Settings, option, say, tell
from geneva_cli.errors import open_warnings

EXAMPLES = ("geneva check spec.toml", "geneva check spec.toml --set size.slot_clearance_mm=0.05")
DRAWN = "A drawing from elsewhere"


def run(
    specs: Annotated[list[str], typer.Argument(metavar="SPEC...", help="Specs, TOML files.")],
    strict: Annotated[bool, typer.Option("--strict", help="Exit 1 on a warning too.")] = False,
    verbose: Annotated[
        bool, typer.Option("-v", "--verbose", help="Every check, a row each.")
    ] = False,
    reverse: Reverse = False,
    certify: Annotated[float | None, option("MM", "Prove that no parts overlap by more.")] = None,
    wheel: Annotated[
        str | None, option("FILE", "The wheel as somebody drew it: .dxf or .svg.", DRAWN)
    ] = None,
    crank: Annotated[str | None, option("FILE", "The crank: .dxf or .svg.", DRAWN)] = None,
    slack: Annotated[
        float | None,
        option("MM", "Overlap that counts as touching.  [default: 1e-6, or 0.001]", DRAWN),
    ] = None,
    settings: Settings = None,
    output: Output = "-",
    format: Format = "",
) -> None:
    """Check designs: failures with their remedies, warnings, and the tightest check.

    It checks the motion, the parts and the spec's own [limits]. With -v, or as csv, json or md,
    there is a row for each check. The exit status is 1 if a check fails. If one spec cannot be
    read, the others are still checked.
    """
    from geneva_cli.output import chosen, show_answer
    from geneva_cli.study.verdicts import of_checks, verdicts

    name, changes = chosen(output, format), list(settings or ())
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
    if unread:
        raise typer.Exit(2)
    if fails:
        raise typer.Exit(1)
