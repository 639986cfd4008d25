"""Random specs, and what must hold of each: `python tests/fuzz_spec.py --runs 1000000`.

Text goes through the program's own reader, as from standard input: it either makes a machine or is
refused in one printable line that begins with its place. Three kinds of text: specs put together
from the keys that the program knows (mostly within their ranges, often at the very ends of them),
such specs with letters, lines and values mutated, and TOML words thrown together. With atheris
installed, a tenth as many runs are then steered by the coverage of the reader.
"""

import argparse
import contextlib
import importlib.util
import io
import math
import os
import random
import re
import signal
import sys
import tempfile
import time
import warnings
from types import SimpleNamespace
from typing import get_origin

from geneva_cli import drives
from geneva_cli.errors import GenevaError
from geneva_cli.laws import NAMES as LAWS
from geneva_cli.rules import OneOf, Range
from geneva_cli.spec import TABLES, fields, kind_keys, load

SECONDS = 5  # for one spec; one takes about a millisecond
LAW = "".join(f"{i / 10},{(i / 10) ** 2 * (3 - i / 5)}\n" for i in range(11))
PLACE = re.compile(r"(<stdin>|law\.csv)(:(\d+))?: ", re.DOTALL)
# fmt: off
ODD = ["nan", "inf", "-inf", "0", "-0.0", "1e308", "5e-324", "-1", '"x"', "true", "[]", "[1, [2]]",
       "{}", "{a = 1}", "2001-02-03", "1" + "0" * 400, '""', '"\\u001b[31m"', "0x1F", "1_0"]
WORDS = ["[", "]", "[[", "]]", "=", ".", ",", "{", "}", "\n", '"', "'", '"""', "#", "\\", " ", "\t",
         "\0", "\r", "\ufeff", "é", "\u202e", "=\n", "wheel", "z", "6", "[wheel]\n", "z = 6\n"]
# fmt: on


def in_range(rng, rule, whole):
    """A number that the rule allows, often at its very ends."""
    low = rule.low if math.isfinite(rule.low) else -1e300
    high = rule.high if math.isfinite(rule.high) else 1e300
    if whole:
        low, high = int(low), int(high)
        return rng.choice([low, high, min(high, low + rng.randrange(30)), rng.randint(low, high)])
    inside_low = math.nextafter(low, math.inf) if rule.ends[0] == "(" else low
    inside_high = math.nextafter(high, -math.inf) if rule.ends[1] == ")" else high
    nearly = low + (high - low) * 10.0 ** -rng.uniform(0, 15)
    usual = max(inside_low, min(inside_high, 10.0 ** rng.uniform(-3, 3)))
    uniform = low + (high - low) * rng.random()
    value = rng.choice([inside_low, inside_high, 0.0, nearly, usual, usual, usual, uniform])
    return min(max(value, inside_low), inside_high)


def value(rng, field, wild):
    """The text of a value for a key; ``wild`` is how often it is nonsense."""
    if rng.random() < wild:
        return rng.choice(ODD)
    types, rule = field.types, field.rule
    if any(get_origin(t) is tuple for t in types):
        numbers = [in_range(rng, rule, False) for _ in range(rng.randint(1, 4))]
        return "[" + ", ".join(map(repr, numbers)) + "]"
    if int in types or (float in types and not (str in types and rng.random() < 0.3)):
        whole = int in types
        rule = rule if isinstance(rule, Range) else Range(0.0, 1.0)
        return repr(in_range(rng, rule, whole))
    if isinstance(rule, OneOf):
        return f'"{rng.choice(rule)}"'
    words = {"law": LAWS, "kind": tuple(drives.KINDS), "file": ("law.csv", "gone.csv", "")}
    return f'"{rng.choice(words.get(field.key, ("matched", "shockless", "slow")))}"'


def spec_text(rng, wild=0.02):
    """A spec from the program's keys; mostly one that makes a machine, or nearly."""
    lines = []
    if rng.random() < 0.1:
        lines.append(f'title = "{rng.choice(["a wheel", "=1+1", "x" * 300])}"')
    kind = rng.choice(list(drives.KINDS))
    for table, cls in TABLES.items():
        if table not in ("wheel", "drive") and rng.random() < 0.6:
            continue
        lines.append(f"[{table}]")
        own = [*fields(cls), *(fields(kind_keys(kind)) if table == "drive" else [])]
        often = rng.choice([0.1, 0.3, 0.8])
        for field in own:
            if field.key == "kind":
                if kind != "crank" and rng.random() < 0.95:
                    lines.append(f'kind = "{kind}"')
            elif field.key == "z" and rng.random() < 0.8:
                lines.append(f"z = {rng.choice([3, 4, 5, 6, 8, 12, 24])}")
            elif (table, field.key) == ("motion", "law") and rng.random() < 0.9:
                lines.append(f'law = "{rng.choice(LAWS)}"')
            elif field.default is ... or rng.random() < often * (0.2 if table == "wheel" else 1.0):
                lines.append(f"{field.key} = {value(rng, field, wild)}")
    return "\n".join(lines) + "\n"


def mutated(rng, text):
    """Text with a few letters, words or lines changed, doubled, moved or lost."""
    for _ in range(rng.randint(1, 4)):
        i, j = sorted((rng.randrange(len(text) + 1), rng.randrange(len(text) + 1)))
        lines = text.split("\n")
        a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
        how = rng.randrange(6)
        if how == 0:
            text = text[:i] + text[min(j, i + 8) :]
        elif how == 1:
            text = text[:i] + rng.choice([*WORDS, *ODD]) + text[i:]
        elif how == 2:
            lines[a], lines[b] = lines[b], lines[a]
            text = "\n".join(lines)
        elif how == 3:
            text = "\n".join([*lines[:a], lines[b], *lines[a:]])
        elif how == 4:
            text = re.sub(r"= .*", lambda m: "= " + rng.choice(ODD), text, count=1)
        else:
            text = (
                text[:i] + chr(rng.choice([rng.randrange(128), rng.randrange(0xD800)])) + text[i:]
            )
    return text


def garbage(rng):
    """TOML words thrown together."""
    return "".join(rng.choice([*WORDS, *ODD, *LAWS]) for _ in range(rng.randint(0, 40)))


def text_of(rng):
    """One of the three kinds."""
    how = rng.random()
    if how < 0.5:
        return spec_text(rng)
    return mutated(rng, spec_text(rng, 0.1)) if how < 0.85 else garbage(rng)


def read(data):
    """The machine that the bytes describe, or the message that refuses them; anything else raises.

    The folder holds law.csv, which a spec may name.
    """
    stdin, sys.stdin = sys.stdin, SimpleNamespace(buffer=io.BytesIO(data))
    try:
        return load("-")
    except GenevaError as error:
        said = str(error)
        place = PLACE.match(said)
        assert place, f"no place in: {said}"
        # What is shown passes errors.clean; here only its length and its line are looked at.
        assert len(said) < 2000, f"{len(said)} characters: {said[:200]}"
        lines = max(data.count(b"\n"), data.count(b"\r")) + 2
        assert int(place[3] or 0) <= max(lines, 20), said
        return said
    finally:
        sys.stdin = stdin


def consistent(mechanism):
    """What holds of every machine: rest at both ends, a whole step, an ascending window."""
    for station in mechanism.stations:
        assert station.entry_deg < station.exit_deg
        b = station.half_step
        for x, wheel in ((station.entry_deg, -b), (station.exit_deg, b)):
            p = station.motion(x, 3).derivatives()
            assert all(math.isfinite(v) for v in p), f"not finite at {x!r}: {p}"
            # a law given as points ends where its spline does: rounding of sums of such terms
            assert abs(p[0] - wheel) <= 1e-9 * b, f"wheel at {x!r}: {p[0]!r}, not {wheel!r}"
    for i in range(len(mechanism.stations)):
        assert math.isfinite(mechanism.dwell_deg(i))


@contextlib.contextmanager
def in_time(seconds=SECONDS):
    """TimeoutError where something takes longer, of the processor's time: others may be busy."""

    def stop(number, frame):
        raise TimeoutError(f"more than {seconds} s")

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@contextlib.contextmanager
def folder():
    """A temporary working folder with the points of a law, which nothing may harm."""
    with tempfile.TemporaryDirectory() as path, contextlib.chdir(path):
        with open("law.csv", "w") as file:
            file.write(LAW)
        yield
        with open("law.csv") as file:
            assert file.read() == LAW, "law.csv was changed"
        assert os.listdir() == ["law.csv"]


def one(data, deep=True):
    """One spec; True where it made a machine."""
    with in_time(), warnings.catch_warnings():
        warnings.simplefilter("error")
        found = read(data)
        if isinstance(found, str):
            return False
        if deep:
            consistent(found)
        return True


def guided(runs, seed):
    """Bytes steered by coverage; atheris ends the process itself."""
    import atheris

    with atheris.instrument_imports(include=["tomli", "geneva_cli.spec"]):
        for name in [n for n in sys.modules if n.startswith("tomli") or n == "geneva_cli.spec"]:
            del sys.modules[name]
        import geneva_cli.spec as again
    globals()["load"] = again.load
    place = tempfile.mkdtemp()
    os.chdir(place)
    rng = random.Random(seed)
    os.mkdir("corpus")
    for i in range(200):
        with open(f"corpus/{i}", "w") as file:
            file.write(spec_text(rng))
    with open("law.csv", "w") as file:
        file.write(LAW)
    flags = [
        f"-runs={runs}",
        f"-seed={seed}",
        "-max_len=2048",
        f"-timeout={SECONDS}",
        "-verbosity=0",
    ]
    atheris.Setup([sys.argv[0], *flags, "corpus"], lambda data: one(data))
    atheris.Fuzz()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--runs", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--no-guided", action="store_true", help="leave out atheris")
    options = parser.parse_args()
    rng, start, made, failed = random.Random(options.seed), time.perf_counter(), 0, {}
    with folder():
        for n in range(options.runs):
            data = text_of(rng).encode("utf-8", "surrogatepass")
            try:
                made += one(data)
            except Exception as error:
                last = error.__traceback__
                while last.tb_next:
                    last = last.tb_next
                name = os.path.basename(last.tb_frame.f_code.co_filename)
                what = f"{type(error).__name__} in {name}:{last.tb_lineno}"
                if what not in failed:
                    print(f"run {n}: {what}: {error}\n{data!r}\n")
                failed[what] = failed.get(what, 0) + 1
    seconds = time.perf_counter() - start
    print(f"{options.runs} specs, {made} of them machines, {seconds:.0f} s; failures: {failed}")
    if failed:
        sys.exit(1)
    if options.no_guided or importlib.util.find_spec("atheris") is None:
        return
    sys.stdout.flush()
    guided(options.runs // 10, options.seed)


if __name__ == "__main__":
    main()
