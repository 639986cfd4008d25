"""``geneva view``."""

from geneva_cli.commands.options import Given, SpecPath, warn

EXAMPLES = ("geneva view spec.toml",)


def run(spec: SpecPath, given: Given = None) -> None:
    """The page on which the machine turns, opened in the browser of the desktop.

    Where there is none, or no desktop, it says where the page is.
    """
    import os
    import webbrowser

    from geneva_cli.design import load
    from geneva_cli.output import animate
    from geneva_cli.study.animation.scene import scene

    design = load(spec, given or ())
    made = scene(design)
    place = os.path.join(_folder(), "machine.html")
    animate(made, place)
    warn(design)
    seen = "DISPLAY" in os.environ or "WAYLAND_DISPLAY" in os.environ or os.name != "posix"
    opened = (seen or os.uname().sysname == "Darwin") and webbrowser.open(f"file://{place}")
    print(place if opened else f"{place}\nno browser was opened: open this page in one")


def _folder() -> str:
    """The user's own folder for the page: the next run replaces it, so that none pile up."""
    import os
    import stat
    import tempfile
    from contextlib import suppress

    folder = os.path.join(tempfile.gettempdir(), f"geneva-{os.getuid()}")
    with suppress(FileExistsError):
        os.mkdir(folder, 0o700)
    status = os.lstat(folder)
    if stat.S_ISDIR(status.st_mode) and status.st_uid == os.getuid():
        return folder
    return tempfile.mkdtemp(prefix="geneva-")  # somebody else took the name in a shared folder
