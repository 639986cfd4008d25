"""``geneva motion``."""

import typer

from geneva_cli.cli.command import Reversible, say, tell
from geneva_cli.errors import GenevaError
from geneva_cli.output import CAMS, CONTROLLERS, show, show_text


def run(
    design: Reversible,
    samples: int | None = None,
    at: str = "",
    turns: int | None = None,
    for_: str | None = None,
    tolerance: float | None = None,
    output: str = "-",
    format: str = "",
) -> None:
    """Position, velocity, acceleration and jerk over a cycle from entry.

    If the engagements differ, it covers a whole period of the machine. velocity, acceleration and
    jerk are relative to the input; omega_rad_s and alpha_rad_s2 are at the spec's speed.

    --format cam writes an electronic cam: polynomials of degree five as csv, or CODESYS points
    (XYVA). Standard error has the number of rows and the greatest error. The exit status is 1 if
    that is more than a --tolerance that was given.

    Options:
      --samples N      Rows, both ends included.  [default: 361]
      --at DEG,...     Rows at these input angles from mid-motion: 30,45, -60..60:5.
      --turns N        Turns of the input, with a row at each entry and jump.
      --format FORMAT  table, csv, json, md or cam.

    An electronic cam:
      --for CONTROLLER  polynomial or codesys.  [default: polynomial]
      --tolerance DEG   Greatest error of the wheel's angle.  [default: 0.0001]

    Examples:
      geneva motion spec.toml --samples 13
      geneva motion spec.toml --at 30,45
      geneva motion spec.toml -o motion.csv
      geneva motion spec.toml --turns 8 -o revolution.csv
      geneva motion spec.toml --format cam --for codesys -o cam.st
    """
    files = design.spec.files
    if format not in CAMS:
        if for_ is not None or tolerance is not None:
            raise GenevaError("--for and --tolerance are for electronic cams: --format cam")
        angles = None
        if at:
            from geneva_cli.study.sweep.values import numbers

            if samples is not None or turns is not None:
                raise GenevaError("--at sets the rows: leave out --samples and --turns")
            angles = numbers(at, "--at")
        rows = 361 if samples is None else samples
        show(design.motion(rows, turns, angles), output, format, files)
        say(design.spec.path, design.motion_warnings)
        return
    from geneva_cli.kept import load_extra

    if samples is not None or at:
        raise GenevaError("--at, --samples: a cam has the points that its --tolerance needs")
    most = 1e-4 if tolerance is None else tolerance
    content, rows, error_deg = load_extra("servo", "cam")(
        design, for_ or CONTROLLERS[0], turns, most
    )
    if isinstance(content, str):
        show_text(content, output, files)
    else:
        show(content, output, "csv", files)
    text, is_met = load_extra("servo", "cam_words")(rows, error_deg, tolerance)
    tell(f"{design.spec.path}: {text}")
    say(design.spec.path, design.motion_warnings)
    if not is_met:
        raise typer.Exit(1)
