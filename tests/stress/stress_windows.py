"""Every command of the manual and its help on real pseudo-terminals: nothing wider than the window.

60, 80, 120 and 200 columns, a terminal with colours, a dumb one and NO_COLOR; some minutes.
"""

import fcntl
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

from geneva_cli.app import COMMANDS
from geneva_cli.manual import TOPICS

COLUMNS = (60, 80, 120, 200)
LOOKS = ({"TERM": "xterm-256color"}, {"TERM": "dumb"}, {"TERM": "xterm", "NO_COLOR": "1"})
ESCAPE = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
LONGEST = 120  # seconds of one run
UNBROKEN = re.compile(r"\S+")  # a single word, which is longer than the window


def examples():
    """The commands of the README and the manual, and the help of every command and topic."""
    pages = [repo.ROOT / "README.md", *(repo.ROOT / "geneva_cli" / "manual").glob("*/*.md")]
    lines = "\n".join(page.read_text(encoding="utf-8") for page in pages).replace("\\\n", " ")
    found = re.findall(r"^(?:\$ )?geneva (.*)$", lines, re.MULTILINE)
    yield from dict.fromkeys(line for line in found if not set("$>|") & set(line))
    yield from (f"{name} --help" for name in COMMANDS)
    yield from (f"help {topic}" for topic in TOPICS)


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


def main():
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        shutil.copytree(repo.DESIGNS, "designs")
        shutil.copy("designs/tolerances.toml", "spec.toml")
        shutil.copy("designs/side-crank-z6.toml", "wish.toml")
        for line in examples():
            few = re.sub(r"--random 10000|--samples 1000000", lambda m: m[0][:-2], line)
            words = shlex.split(few, comments=True)
            for columns in COLUMNS:
                for look in LOOKS:
                    lines, status = seen(words, columns, look)
                    wide = [
                        part
                        for part in lines
                        if len(part.split("\r")[-1]) > columns
                        and not UNBROKEN.fullmatch(part.strip())
                    ]
                    if wide or status not in (0, 1):
                        wrong += 1
                        print(
                            f"{columns} {look['TERM']} geneva {line}: {status}",
                            *wide[:3],
                            sep="\n  ",
                        )
    print("no line too wide" if not wrong else f"{wrong} screens wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
