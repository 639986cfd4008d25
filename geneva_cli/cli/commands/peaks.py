"""``geneva peaks``."""

from geneva_cli.cli.command import Reversible, say


def run(design: Reversible, certify: bool = False, output: str = "-", format: str = "") -> None:
    """Greatest velocity, acceleration, jerk and power of a design, as invariants.

    Angles are signed input angles from mid-motion. If engagements differ, each peak is the
    greatest of all.

    With --certify each peak is proved to lie between two bounds, or is called not proved. It needs
    the extra geneva-cli[certify]. More: `geneva help accuracy`.

    Options:
      --certify  Prove each peak between two bounds.

    Examples:
      geneva peaks spec.toml
      geneva peaks spec.toml --set wheel.z=5 --format json
      geneva peaks spec.toml --certify
    """
    from geneva_cli.output import is_for_people, show

    table = design.peaks_table
    if certify:
        table = design.certified_peaks(is_for_people(output, format))
        say(design.spec.path, design.ideal_notes)
    show(table, output, format, design.spec.files)
    say(design.spec.path, design.motion_warnings)
