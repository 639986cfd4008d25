"""``geneva view``."""

from geneva_cli.commands.options import Given, SpecPath, warn

EXAMPLES = ("geneva view spec.toml",)


def run(spec: SpecPath, given: Given = None) -> None:
    """The page on which the machine turns, opened in the browser of the desktop.

    Where there is none, or no desktop, it says where the page is.
    """
    import os
    import tempfile
    import webbrowser

    from geneva_cli.design import load
    from geneva_cli.output import animate
    from geneva_cli.study.animation.scene import scene

    design = load(spec, given or ())
    made = scene(design)
    place = os.path.join(tempfile.mkdtemp(prefix="geneva-"), "machine.html")
    animate(made, place)
    warn(design)
    seen = "DISPLAY" in os.environ or "WAYLAND_DISPLAY" in os.environ or os.name != "posix"
    opened = (seen or os.uname().sysname == "Darwin") and webbrowser.open(f"file://{place}")
    print(place if opened else f"{place}\nno browser was opened: open this page in one")
