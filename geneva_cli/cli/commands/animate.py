"""``geneva animate``."""

import os
from contextlib import suppress
from typing import Annotated

from geneva_cli.cli.options import Reverse, Settings, SpecPath, flag, output_option, warn
from geneva_cli.errors import GenevaError

EXAMPLES = (
    "geneva animate spec.toml -o machine.html",
    "geneva animate spec.toml --reverse -o backwards.html",
    "geneva animate spec.toml --open",
)


def run(
    spec: SpecPath,
    reverse: Reverse = False,
    settings: Settings = None,
    open_: Annotated[bool, flag("--open", "Open the page in the desktop's browser.")] = False,
    output: Annotated[
        str, output_option("FILE", "Write to this .html; - prints it.", default=True)
    ] = "-",
) -> None:
    """Animate the machine on a page that needs no network.

    It shows parts, gears, contact force and curves, and plays or follows a slider.
    --open prints the page's path if there is no browser.
    """
    from geneva_cli.design import load
    from geneva_cli.output import animate
    from geneva_cli.spec.load_named import load_extra
    from geneva_cli.study.animation.turning_scene import scene

    if open_ and output != "-" and not output.endswith(".html"):
        raise GenevaError(f'-o "{output}": --open opens a page: it must end in .html')
    design = load(spec, settings or (), reverse)
    place = os.path.join(_folder(), "machine.html") if open_ and output == "-" else output
    shown = load_extra("outline", "scene")(design) if design.is_drawn else scene(design)
    animate(shown, place, design.spec.files)
    warn(design)
    if open_:
        _open(os.path.abspath(place))


def _open(place: str) -> None:
    """Open a page in the desktop's browser, and print its path."""
    import webbrowser
    from pathlib import Path

    has_display = "DISPLAY" in os.environ or "WAYLAND_DISPLAY" in os.environ or os.name != "posix"
    has_display = has_display or os.uname().sysname == "Darwin"
    opened = has_display and webbrowser.open(Path(place).as_uri())
    print(place if opened else f"{place}\nno browser was opened: open this page in one")


def _folder() -> str:
    """The user's own folder for the page, which the next run replaces so that no pages pile up."""
    import stat
    import tempfile

    try:
        user = os.getuid()
    except AttributeError:
        user = 0  # Windows has no number of a user, and a temporary folder for each user
    folder = os.path.join(tempfile.gettempdir(), f"geneva-{user}")
    with suppress(FileExistsError):
        os.mkdir(folder, 0o700)
    status = os.lstat(folder)
    if stat.S_ISDIR(status.st_mode) and status.st_uid == user:
        return folder
    return tempfile.mkdtemp(prefix="geneva-")  # another user has taken the name in a shared folder
