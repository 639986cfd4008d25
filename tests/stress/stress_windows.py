"""Every command of the manual and its help on real pseudo-terminals: nothing wider than the window.

60 columns on a terminal with colours, on a dumb one and with NO_COLOR; 80, 120 and 200 on one of
them each. Half an hour of processor time.
"""

import fcntl
import itertools
import os
import pty
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import termios

import repo
from repo import GENEVA

from geneva_cli.cli.app import COMMANDS
from geneva_cli.manual import TOPICS

COLUMNS = (60, 80, 120, 200)
LOOKS = ({"TERM": "xterm-256color"}, {"TERM": "dumb"}, {"TERM": "xterm", "NO_COLOR": "1"})
ESCAPE = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
# every look in the narrowest window, where lines break; one look in each of the others
WINDOWS = (*itertools.product(COLUMNS[:1], LOOKS), *zip(COLUMNS[1:], LOOKS, strict=True))
LONGEST = 120  # seconds of one run
UNBROKEN = re.compile(r"\S+")  # a single word, which is longer than the window


def steps(page):
    """The files and commands of a page, in its order: a file's name and text, or a command."""
    text = page.read_text(encoding="utf-8").replace("\\\n", " ")
    for kind, block in re.findall(r"```([a-z]+)\n(.*?)```", text, re.DOTALL):
        name = re.match(r"# (?:add to )?(\S+\.\w+)\n", block)
        if name and kind != "python":
            yield name[1], block
        elif kind in ("console", "sh"):
            for line in re.findall(r"^(?:\$ )?geneva (.*)$", block, re.MULTILINE):
                yield "", line


def seen(words, columns, look):
    """The lines that a terminal is given, and the exit status."""
    master, slave = pty.openpty()
    fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    kept = {k: v for k, v in os.environ.items() if k not in ("COLUMNS", "NO_COLOR", "TERM")}
    with subprocess.Popen(
        ["timeout", str(LONGEST), GENEVA, *words], stdout=slave, stderr=slave, env=kept | look
    ) as process:
        os.close(slave)
        text = repo.read_terminal(master).decode()
    return ESCAPE.sub("", text).replace("\r\n", "\n").split("\n"), process.returncode


def screens(line):
    """The command on each terminal; files of all runs but the last are removed, as `new` keeps any.

    Yields what is wrong: the terminal, the exit status, and lines that are too wide.
    """
    few = re.sub(r"--random 10000|--samples 1000000", lambda m: m[0][:-2], line)
    words, before = shlex.split(few, comments=True), {*os.listdir()}
    for columns, look in WINDOWS:
        for new in {*os.listdir()} - before:
            shutil.rmtree(new) if os.path.isdir(new) else os.remove(new)
        lines, status = seen(words, columns, look)
        wide = [
            part
            for part in lines
            if len(part.split("\r")[-1]) > columns and not UNBROKEN.fullmatch(part.strip())
        ]
        if wide or status not in (0, 1):
            yield f"{columns} {look['TERM']} geneva {line}: {status}", *wide[:3]


def main(pages):
    wrong = 0
    for page in pages:
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            shutil.copytree(repo.DESIGNS, "designs")
            each = [*steps(page)]
            for design, spec in (("tolerances", "spec.toml"), ("side-crank-z6", "wish.toml")):
                # a page that makes the file begins without it
                if not any(name == spec or f"-o {spec}" in text for name, text in each):
                    shutil.copy(f"designs/{design}.toml", spec)
            for name, text in each:
                if name:
                    with open(name, "a", encoding="utf-8") as file:
                        file.write(text)
                elif not set("$>|") & set(re.sub('"[^"]*"', "", text)):  # no shell is at hand
                    for found in screens(text):
                        wrong += 1
                        print(*found, sep="\n  ", flush=True)
            os.chdir(repo.ROOT)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        helps = [f"{name} --help" for name in COMMANDS] + [f"help {topic}" for topic in TOPICS]
        for line in helps:
            for found in screens(line):
                wrong += 1
                print(*found, sep="\n  ", flush=True)
    print("no line too wide" if not wrong else f"{wrong} screens wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    manual = sorted((repo.ROOT / "geneva_cli" / "manual").glob("*/*.md"))
    main([repo.ROOT / "README.md", *manual])
