"""``geneva animate``."""

import os

from geneva_cli.cli.command import Reversible, say


def run(design: Reversible, open_: bool = False, output: str = "-") -> None:
    """Animate the machine on a page that needs no network.

    It shows parts, gears, contact force and curves, and plays or follows a slider.
    --open also prints the page's path.

    Options:
      --open             Open the page in the desktop's browser.
      -o, --output FILE  Write to this .html; - prints it.  [default: -]

    Examples:
      geneva animate spec.toml -o machine.html
      geneva animate spec.toml --reverse -o backwards.html
      geneva animate spec.toml --open
    """
    from geneva_cli.kept import load_extra
    from geneva_cli.output import animate
    from geneva_cli.study.animation.turning_scene import scene

    place = output
    if open_ and output == "-":
        import tempfile

        place = os.path.join(tempfile.mkdtemp(prefix="geneva-"), "machine.html")
    shown = load_extra("outline", "scene")(design) if design.is_drawn else scene(design)
    animate(shown, place, design.spec.files)
    say(design.spec.path, design.motion_warnings)
    if open_:
        import webbrowser
        from pathlib import Path

        page = os.path.abspath(place)
        print(page)
        if not webbrowser.open(Path(page).as_uri()):
            print("no browser was opened: open this page in one")
