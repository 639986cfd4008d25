"""Random texts for the fuzzers: specs of any keys, mutated specs, and TOML words."""

import re
from functools import cache
from typing import get_origin

from fuzz_machines import in_range, machine_text

from geneva_cli.motion import registry
from geneva_cli.motion.registry import DRIVES, GEARINGS, LAWS
from geneva_cli.spec.rules import OneOf
from geneva_cli.spec.schema import REQUIRED, fields
from geneva_cli.spec.tables import LISTS
from geneva_cli.specfile.writer import keys_of

# fmt: off
ODD = ["nan", "inf", "-inf", "0", "-0.0", "1e308", "1e-300", "-1", '"x"', "true", "[]", "[1, [2]]",
       "{}", "{a = 1}", "2001-02-03", "1" + "0" * 400, '""', '"\\u001b[31m"', "0x1F", "1_0"]
WORDS = ["[", "]", "[[", "]]", "=", ".", ",", "{", "}", "\n", '"', "'", '"""', "#", "\\", " ", "\t",
         "\0", "\r", "\ufeff", "é", "\u202e", "=\n", "wheel", "z", "6", "[wheel]\n", "z = 6\n"]
# fmt: on


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
        return repr(in_range(rng, rule, whole))
    if isinstance(rule, OneOf):
        return f'"{rng.choice(rule)}"'
    words = {
        "law": tuple(LAWS),
        "kind": tuple(DRIVES),
        "file": ("law.csv", "gone.csv", ""),
    }
    return f'"{rng.choice(words.get(field.key, ("matched", "shockless", "slow")))}"'


@cache
def known_keys(kind):
    """Every key of a spec with this drive, table by table; of all wheels and all laws."""
    wheels = [registry.gearing(name) for name in GEARINGS]
    laws = [field for name in LAWS for field in fields(registry.law(name))]
    tables = keys_of(wheels[0], registry.drive(kind), laws)
    named = {field.key for field in tables["wheel"]}
    foreign = {f.key: f for wheel in wheels for f in fields(wheel) if f.key not in named}
    return tables | {"wheel": [*tables["wheel"], *foreign.values()]}


def spec_text(rng, wild=0.02):
    """A spec from the program's keys, those of all wheels and laws: few of them are machines."""
    lines = []
    if rng.random() < 0.1:
        lines.append(f'title = "{rng.choice(["a wheel", "=1+1", "x" * 300])}"')
    kind = rng.choice(list(DRIVES))
    for table, own in known_keys(kind).items():
        # a product has few keys, most pairs of which are refused
        left_out = 0.9 if table == "product" else 0.6
        if table not in ("wheel", "drive") and rng.random() < left_out:
            continue
        lines.append(f"[[{table}]]" if table in LISTS else f"[{table}]")
        share = rng.choice([0.1, 0.3, 0.8]) * (0.2 if table == "wheel" else 1.0)
        for field in own:
            if field.key == "kind":
                if kind != "crank" and rng.random() < 0.95:
                    lines.append(f'kind = "{kind}"')
            elif field.key == "z" and rng.random() < 0.8:
                lines.append(f"z = {rng.choice([3, 4, 5, 6, 8, 12, 24])}")
            elif (table, field.key) == ("motion", "law") and rng.random() < 0.9:
                lines.append(f'law = "{rng.choice(list(LAWS))}"')
            elif (field.default is REQUIRED and table != "motion") or rng.random() < share:
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
    """One of the four kinds."""
    how = rng.random()
    if how < 0.4:
        return machine_text(rng)
    if how < 0.7:
        return spec_text(rng)
    return mutated(rng, spec_text(rng, 0.1)) if how < 0.95 else garbage(rng)
