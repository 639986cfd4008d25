"""A run imports only what it shows; a new command adds one row to ``ROWS``."""

import os
import select
import subprocess
import sys
from contextlib import ExitStack
from typing import NamedTuple

import pytest
import repo

from geneva_cli.cli.app import COMMANDS

DESIGNS = str(repo.DESIGNS)
# What costs: a run may import only what its row allows of these.
HEAVY = {"numpy", "scipy", "rich", "pydantic", "matplotlib", "ezdxf", "tomli", "tomllib", "json"}
HEAVY |= {"ssl", "numpy.ma"}  # those of xml.sax.saxutils and of np.unique, for a line of code
# The whole program, through its real entry point, which ends the process by os._exit.
PROBE = """
import os, sys
end = os._exit
def leave(status):
    print(*sys.modules, sep="\\n", file=sys.stderr, flush=True)
    end(status)
os._exit = leave
sys.argv[0] = "geneva"
from geneva_cli.cli.app import main
main()
"""
# The same, a run a line of standard input: each in a fork of a process that has imported what every
# run does, the program's own entry.
FORKS = (
    PROBE.removesuffix("main()\n")
    + """
for line in sys.stdin:
    child = os.fork()
    if not child:
        sys.argv = ["geneva", *line.rstrip("\\n").split("\\t")]
        main()
    os.waitpid(child, 0)
    print("done", file=sys.stderr, flush=True)
"""
)


class Row(NamedTuple):
    """A run, and the heavy modules that it may import."""

    line: str
    may: str = ""

    @property
    def words(self):
        return [os.path.join(DESIGNS, w) if w.endswith(".toml") else w for w in self.line.split()]


ROWS = [
    Row("--help"),
    Row("--version"),
    Row("help"),
    Row("help cycle"),
    Row("schema", "json"),
    Row("table --z 6"),
    Row("table --z 6 --format json", "json"),
    Row("table --z 6 --A 0.6", "numpy"),  # its peaks are searched for
    Row("peaks press-straight.toml", "tomli"),
    Row("peaks side-crank-z6.toml", "tomli numpy"),
    Row("peaks press-straight.toml --format json", "tomli json"),
    Row("peaks press-straight.toml --certify", "tomli numpy"),
    Row("peaks press-curved.toml", "tomli numpy"),  # whether its slot drives positively
    Row("motion press-curved.toml --samples 9", "tomli numpy"),
    Row("loads press-curved.toml --format csv", "tomli numpy"),
    Row("loads cam-geneva.toml --format json", "tomli numpy json"),
    Row("plot press-curved.toml press-345.toml --format svg", "tomli numpy"),
    Row("animate press-straight.toml", "tomli numpy json"),
    Row("profile press-curved.toml", "tomli numpy"),
    Row("profile press-curved.toml --part wheel --format svg", "tomli numpy"),
    Row("profile press-straight.toml --part wheel --format dxf", "tomli numpy ezdxf json"),
    Row("profile press-straight.toml --part sheet --format pdf", "tomli numpy"),
    Row("profile press-straight.toml --part sheet --format dxf", "tomli numpy ezdxf json"),
    Row("export --help", "numpy"),
    Row("size turret.toml", "tomli numpy"),
    Row("report press-straight.toml", "tomli numpy"),
    Row("report spherical-z6.toml", "tomli numpy"),  # its loads
    Row("report press-straight.toml --format html", "tomli numpy"),
    Row("report press-straight.toml --format pdf", "tomli numpy"),
    Row("report spherical-z6.toml --format md", "tomli numpy"),
    # SciPy: the normal distribution's quantiles, which bring json and numpy.ma
    Row("tolerance tolerances.toml --samples 9", "tomli numpy scipy json numpy.ma"),
    Row("check spherical-z6.toml", "tomli numpy"),
    Row("check press-curved.toml", "tomli numpy"),
    Row("vibration press-straight.toml --period-ratio 10", "tomli numpy"),
    Row("compare side-crank-z6.toml internal-z6.toml", "tomli numpy"),
    Row("sweep side-crank-z6.toml --vary drive.A=0,0.3", "tomli numpy"),
    Row("sweep side-crank-z6.toml --vary drive.A=0..0.3 --random 9", "tomli numpy"),
    Row("keys"),
    Row("explain"),
    Row("explain horn_mm"),
    Row("laws", "numpy"),
    # NumPy: each row of synth says whether its parts can be built, for which they are laid out
    Row("synth --tau 1/3 --z 6 --check 1", "numpy numpy.ma"),
    Row("synth --subject-to acceleration_max<=0.5 --z 6 --check 1", "numpy numpy.ma"),
    Row("synth --motion-deg 180 --z 6 --write 1", "tomli numpy numpy.ma"),
    Row("new external", "tomli"),  # the keys of a design
]

# The quick ones may import this much of the program, and no more.
OWN = {
    "--help": "cli cli.app cli.command errors progress streams manual",
    "--version": "cli cli.app cli.command errors progress streams",
    # no spec, no registry of kinds, no record of either: of the wheels their closed forms alone
    "table --z 6": "cli cli.app cli.command errors progress streams table cli.commands "
    "motion motion.wheels cli.commands.table motion.wheels.classic motion.timing "
    "kept extras output study output.text study.survey "
    "numerics motion.timing numerics.angles numerics.arrays spec spec.rules",
}

# Modules of the program that a run of an unloaded wheel imports, at most: a few more than today.
# A module costs a fifth of a millisecond, and most branches of a large program are of no use for a
# given machine. Where a number is exceeded, see which branch imported too much.
STRAIGHT, CURVED = "[wheel]\nz = 6\n", '[wheel]\nz = 6\n[motion]\nlaw = "modified-sine"\n'
MOST = {
    "peaks -": (80, 100),
    "motion -": (83, 102),
    "loads - --set load.inertia_kgm2=0.05": (250, 269),
    "vibration - --period-ratio 5": (131, 136),
    "check -": (136, 200),
    "report -": (195, 230),
    "compare - --vary drive.n_rpm=60,90": (220, 226),
    "profile -": (92, 111),
    "profile - --part wheel --format svg": (205, 281),
    "profile - --part wheel --format dxf": (199, 275),
    "profile - --part sheet --format svg": (223, 298),
    "plot - --format svg": (132, 139),
}


def loaded(words, **settings):
    settings = {"stdout": subprocess.PIPE} | settings
    found = subprocess.run(
        [sys.executable, "-c", PROBE, *words],
        stderr=subprocess.PIPE,
        encoding="utf-8",
        timeout=60,
        **settings,
    )
    assert "geneva_cli.cli.app" in found.stderr.split()
    return set(found.stderr.split())


@pytest.fixture(scope="module")
def forks():
    """A process that runs lines; and one that had imported NumPy before, for runs that may."""
    with ExitStack() as stack:
        yield [
            stack.enter_context(
                subprocess.Popen(
                    [sys.executable, "-c", before + FORKS],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.PIPE,
                )
            )
            for before in ("", "import numpy\n")
        ]


def loaded_in(process, words):
    process.stdin.write("\t".join(words).encode() + b"\n")
    process.stdin.flush()
    said = b""
    while not said.endswith(b"\ndone\n"):
        assert select.select([process.stderr], [], [], 60)[0], said
        more = os.read(process.stderr.fileno(), 1 << 16)
        assert more, said
        said += more
    *found, _ = said.decode().split()
    assert "geneva_cli.cli.app" in found, found
    return set(found)


def own(modules):
    return {name.removeprefix("geneva_cli.") for name in modules if name.startswith("geneva_cli.")}


def test_every_command_has_a_row():
    assert {row.line.split()[0] for row in ROWS} >= set(COMMANDS)


@repo.posix("fork, without which each run takes a second; the imports are the same everywhere")
@pytest.mark.sampled(12)
@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.line)
def test_heavy_modules(forks, row):
    may = set(row.may.split())
    assert loaded_in(forks["numpy" in may], row.words) & HEAVY <= may


@pytest.mark.parametrize("line", OWN)
def test_own_modules(line):
    assert own(loaded(line.split())) <= set(OWN[line].split())


@pytest.mark.parametrize("line", MOST)
@pytest.mark.sampled(12)
def test_few_own_modules(line):
    for text, most in zip((STRAIGHT, CURVED), MOST[line], strict=True):
        modules = own(loaded(line.split(), input=text, stdout=subprocess.DEVNULL))
        assert len(modules) <= most


@pytest.mark.sampled(4)
@pytest.mark.parametrize("words", ["geneva ", "geneva ta", "geneva table --", "geneva motion --s"])
def test_completion(words):
    count = len(words.split(" ")) - 1
    settings = {"_GENEVA_COMPLETE": "complete_bash", "COMP_WORDS": words, "COMP_CWORD": str(count)}
    modules = loaded([], env=os.environ | settings)
    assert not modules & HEAVY
    if count == 1:  # a command's name: no command is imported
        assert own(modules) == {"cli", "cli.app", "cli.command", "errors", "progress", "streams"}


# Counts each function, class body and comprehension of the program once, and the frames of the
# deepest stack. A generator's frame is left and entered again with each value.
COUNTER = """
import sys
from geneva_cli.cli.app import app
functions, depth, deepest = set(), 0, 0
def count(frame, event, _):
    global depth, deepest
    code = frame.f_code
    if "geneva_cli" not in code.co_filename:
        return
    if event == "call":
        depth += 1
        deepest = max(deepest, depth)
        if not code.co_name.startswith("<module"):
            functions.add((code.co_filename, code.co_qualname))
    elif event == "return":
        depth -= 1
sys.setprofile(count)
try:
    app(prog_name="geneva")
except SystemExit:
    pass
sys.setprofile(None)
print(len(functions), len({file for file, _ in functions}), deepest, file=sys.stderr)
"""
# A reader of a number follows these: how many functions of the program a run calls, in how many
# files, and how deep. Who exceeds one finds a shorter way, or names the reason where he raises it.
BOUNDS = {
    "peaks": (199, 35, 14),
    "check": (766, 88, 24),
}


@pytest.mark.parametrize("command", BOUNDS)
def test_a_run_calls_few_functions_and_not_deep(command):
    run = subprocess.run(
        [sys.executable, "-c", COUNTER, command, str(repo.DESIGNS / "turret.toml")],
        capture_output=True,
        encoding="utf-8",
    )
    counts = tuple(map(int, run.stderr.split()))
    assert all(one <= most for one, most in zip(counts, BOUNDS[command], strict=True)), counts
