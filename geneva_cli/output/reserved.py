"""Names that Windows does not give to a file: it would write to a device or elsewhere.

A device is meant whatever the extension: ``nul.csv`` is no file. After a colon stands the name of
a hidden stream of a file.
"""

from __future__ import annotations

import ntpath
import os
import sys

from geneva_cli.errors import GenevaError, cut

FORBIDDEN = {*'"*:<>?|/\\', *map(chr, range(32))}
NUMBERS = "123456789\N{SUPERSCRIPT ONE}\N{SUPERSCRIPT TWO}\N{SUPERSCRIPT THREE}"
DEVICES = {"CON", "PRN", "AUX", "NUL", "CONIN$", "CONOUT$"}
DEVICES |= {port + number for port in ("COM", "LPT") for number in NUMBERS}


def fault(name: str) -> str:
    """Why Windows takes no file or folder of this name; empty if it does.

    >>> fault("nul.csv"), fault("null.csv")
    ('Windows reserves the name "nul" for a device', '')
    """
    if name in ("", ".", ".."):
        return ""
    if signs := sorted(FORBIDDEN & {*name}):
        return f"Windows takes no {signs[0]!r} in a name"
    if name[-1] in ". ":
        return "Windows drops a dot or a space at the end of a name"
    stem = name.partition(".")[0].rstrip(" ")
    return f'Windows reserves the name "{stem}" for a device' if stem.upper() in DEVICES else ""


def require_possible(path: str, platform: str = sys.platform) -> None:
    """Raise GenevaError for a path with a name that this platform does not give to a file."""
    if platform == "win32":
        _, rest = ntpath.splitdrive(path)
        _require(path, rest.replace("/", "\\").split("\\"))


def require_shareable(path: str) -> None:
    """Raise GenevaError for a file of a folder for others, who may have Windows."""
    _require(path, [os.path.basename(path)])


def _require(path: str, names: list[str]) -> None:
    for name in names:
        if why := fault(name):
            raise GenevaError(f'"{cut(path, 300)}": {why}; give another name')
