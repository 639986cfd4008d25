"""Output longer than the window goes through a pager, as git's does."""

import os
import re
import shutil
import sys
from collections.abc import Iterable
from contextlib import suppress
from itertools import chain

import geneva_cli.progress as progress

is_wanted = True  # False after --no-pager

ESCAPE = re.compile(r"\x1b\[[0-9;]*m")


def write(chunks: Iterable[str]) -> None:
    """Write text to a terminal: as it is if the window holds it, else through the pager."""
    command = _command()
    if not command:
        sys.stdout.writelines(chunks)
        return
    rest, first = iter(chunks), list[str]()
    columns, lines = shutil.get_terminal_size()
    for chunk in rest:
        first.append(chunk)
        for line in ESCAPE.sub("", chunk).splitlines():
            lines -= 1 + max(len(line) - 1, 0) // columns
        if lines <= 0:  # the shell's prompt takes a line too
            _through(command, chain(first, rest))
            return
    sys.stdout.writelines(first)


def _command() -> str:
    """The pager's command line; empty if output is to be printed directly."""
    chosen, term = os.environ.get("PAGER"), os.environ.get("TERM", "")
    if not is_wanted or term == "dumb" or not (term or chosen):
        return ""
    if chosen is None:
        return next(filter(shutil.which, ("less", "more")), "")
    # as for git, cat or an empty text means no pager
    program = next((word for word in chosen.split() if "=" not in word), "cat")
    return chosen if chosen.strip() != "cat" and shutil.which(program) else ""


def _through(command: str, chunks: Iterable[str]) -> None:
    """Write to the pager and wait until the reader leaves it, which may be before the end."""
    import signal
    import subprocess

    sys.stdout.flush()
    progress.maker = None  # a bar would be drawn over the pager's page
    pager = subprocess.Popen(
        command,
        shell=True,
        stdin=subprocess.PIPE,
        env={"LESS": "FRX"} | os.environ,
        encoding=sys.stdout.encoding,
        errors="backslashreplace",
    )
    # Ctrl-C is for the pager, in which it stops a search; the run goes on.
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    has_left = OSError if os.name == "nt" else BrokenPipeError
    try:
        with suppress(has_left), pager:  # its end waits for the reader
            assert pager.stdin
            pager.stdin.writelines(chunks)
    finally:
        signal.signal(signal.SIGINT, before)
