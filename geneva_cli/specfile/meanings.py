"""Meanings of words: a check, a quantity, a kind, a law, a warning, a part, or a key of a spec."""

import inspect
import textwrap
from functools import cache
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.manual import TOPICS
from geneva_cli.manual.explained import GROUPS, Entry, entries
from geneva_cli.motion import registry
from geneva_cli.names import SHORT_UNITS, UNITS, described, heading, spoken, unit_of
from geneva_cli.specfile.keys import Key, all_keys

TEXTS = ("formula", "source", "to_do")  # of an entry, as it has them
UNIT_WORDS = {*UNITS.values(), *SHORT_UNITS.values(), "°"}  # behind a heading's comma
CHECKS, INPUTS = "checks.", "inputs."  # beginnings of a report's names of checks and of keys


class Meaning(NamedTuple):
    """Meaning of one word; None for what does not apply to it."""

    group: str
    name: str
    meaning: str
    unit: str | None = None
    formula: str | None = None
    source: str | None = None
    to_do: str | None = None
    manual: str | None = None  # the commands that show its pages


def meanings(word: str) -> list[Meaning]:
    """All meanings of a word, full (``timing.dwell_s``) or shortened (``dwell_s``).

    It may be the words in which any output prints a name. Empty for an unknown word.

    >>> [(m.group, m.unit) for m in meanings("loads.pin_force_N.rms")]
    [('quantity', 'N')]
    >>> [m.group for m in meanings("jerk_max")], [m.name for m in meanings("flywheel")]
    (['check', 'quantity', 'key'], ['sizing.flywheel_kgm2'])
    """
    exact = _lookup(word) or _lookup(word.casefold().replace(" ", "-"))
    if exact:
        return exact
    wanted, known = _words(word), names()
    printed = [name for name in known if wanted in _printed(name)]
    if not printed:  # a quantity with an ending, as pin force max
        ends = [name for name in known if name.startswith(".")]
        parts = {end: [words for words in _printed(end) if words <= wanted] for end in ends}
        printed = [
            name + end
            for end, some in parts.items()
            if some
            for name in known
            if any(own | words == wanted for own in _printed(name) for words in some)
        ]
    return list(dict.fromkeys(one for name in printed for one in _lookup(name)))


def _words(text: str) -> frozenset[str]:
    """The words of a heading without its unit, in any order: torque on the input, input torque."""
    words, _, unit = text.rpartition(", ")
    text = words if words and unit in UNIT_WORDS else text
    whole = frozenset(text.casefold().replace("'s", "").replace(",", " ").split())
    return whole - {"at", "in", "inputs", "of", "on", "the", "to"} or whole


@cache
def _printed(name: str) -> frozenset[frozenset[str]]:
    """The words in which tables and documents print a name, whole or its last part."""
    last = name.rpartition(".")[2]
    texts = spoken(name)[0], spoken(last)[0], described(last)[0]
    return frozenset(filter(None, map(_words, texts)))


def related(word: str) -> list[tuple[str, str, str]]:
    """Group, name and a sentence of everything that a word is part of, as ``listed`` has them.

    The word may be a group, such as ``checks``. Names and headings come before texts.
    """
    everything = [*listed(), *(("key", key.name, key.meaning) for key in all_keys())]
    if group := {**GROUPS, "keys": "key"}.get(word.casefold()):
        return [one for one in everything if one[0] == group]
    wanted = _words(word.replace("_", " "))
    texts = {one: (heading(one[1]), f"{one[1]} {one[2]}".casefold()) for one in everything}
    found = [
        one for place in (0, 1) for one in texts if all(w in texts[one][place] for w in wanted)
    ]
    return list(dict.fromkeys(found))


def unknown(word: str) -> GenevaError:
    """The error for a word that stands nowhere, with the nearest name."""
    known = names()
    known += [CHECKS + n for e in entries() if e.group == "check" for n in e.names]
    among = dict.fromkeys([*known, *(name.rpartition(".")[2] for name in known)])
    advice = "`geneva explain` lists what is explained"
    return GenevaError(f'"{cut(word)}" is not explained{nearest(word, among)}; {advice}')


def groups() -> list[tuple[str, int, str, str]]:
    """Each group of words: its name, how many they are, what they are, and three of them."""
    out = []
    for page, group in GROUPS.items():
        own = [name for entry in entries() if entry.group == group for name in entry.names]
        some = dict.fromkeys(own[i * len(own) // 3] for i in range(3))
        out.append((page, len(own), TOPICS[page], ", ".join(some)))
    return out


def listed() -> list[tuple[str, str, str]]:
    """Everything that is explained: group, name, and a sentence."""
    out = []
    for entry in entries():
        sentence = _of_entry(entry, entry.names[0]).meaning.partition(". ")[0].rstrip(".") + "."
        out += [(entry.group, name, sentence) for name in entry.names]
    return out


def names() -> list[str]:
    """Names of everything that is explained, and of the keys."""
    return [name for e in entries() for name in e.names] + [key.name for key in all_keys()]


def as_markdown(known_meanings: list[Meaning]) -> str:
    """Meanings as a Markdown page."""
    lines: list[str] = []
    for one in known_meanings:
        lines += [f"## {one.name} ({one.group})", "", *_wrapped(one.meaning), ""]
        start = len(lines)
        for name, text in one._asdict().items():
            if text and name not in ("group", "name", "meaning"):
                lines += _wrapped(f"- {name.capitalize().replace('_', ' ')}: {text}")
        lines += [""] if len(lines) > start else []
    return "\n".join(lines)


def _wrapped(text: str) -> list[str]:
    indent = "  " if text.startswith("- ") else ""
    return textwrap.wrap(
        text, 90, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    )


def _lookup(word: str) -> list[Meaning]:
    some = entries()
    if word.startswith(CHECKS):
        bare = word.removeprefix(CHECKS)
        if own := [e for e in some if e.group == "check" and bare in e.names]:
            return [_of_entry(entry, word) for entry in own]
    key = word.removeprefix(INPUTS)
    keys = [_of_key(k) for k in all_keys() if key in (k.key, k.name)]
    if word.startswith(INPUTS):
        return keys
    if exact := [e for e in some if word in e.names or f".{word}" in e.names]:
        return [_of_entry(entry, word) for entry in exact] + keys
    # a quantity with an ending such as .rms: the ending's meaning, then the quantity's
    base, dot, end = word.rpartition(".")
    ending = next((e for e in some if dot and f".{end}" in e.names), None)
    if ending and (of := [m for m in _lookup(base) if m.group == "quantity"]):
        return [
            one._replace(
                name=word,
                meaning=f"{ending.meaning} The quantity: {one.meaning}",
                unit=ending.unit or unit_of(word) or one.unit,
                formula="; ".join(t for t in (ending.formula, one.formula) if t) or None,
            )
            for one in of
        ]
    by_end = {e: [name for name in e.names if name.endswith(f".{word}")] for e in some}
    return [_of_entry(entry, named[0]) for entry, named in by_end.items() if named] + keys


def _of_entry(entry: Entry, name: str) -> Meaning:
    """Meaning of an entry; for a kind or law, its class's own summary comes first."""
    about = ""
    if entry.group == "law":
        text = registry.law(name).ABOUT
        about = f"{text[:1].upper()}{text[1:]}{'' if text.endswith('.') else '.'}"
    kinds = ((registry.GEARINGS, registry.gearing), (registry.DRIVES, registry.drive))
    for known, cls in kinds if entry.group == "kind" else ():
        if name in known:
            about = inspect.cleandoc(cls(name).__doc__ or "").partition("\n")[0]
    return Meaning(
        entry.group,
        name,
        " ".join(text for text in (about, entry.meaning) if text),
        unit=entry.unit or next((u for n in (name, *entry.names) if (u := unit_of(n))), None),
        manual=", ".join(f"geneva help {topic}" for topic in entry.topics),
        **{field: getattr(entry, field) or None for field in TEXTS},
    )


def _of_key(key: Key) -> Meaning:
    """Meaning of a key of a spec, as in ``geneva keys``."""
    default = "required" if key.required else f"default {key.default}" if key.default else None
    texts = (key.meaning, key.type, key.range, key.goes_with, default)
    words = f"A key of the spec's [{key.table}]: " + "; ".join(text for text in texts if text) + "."
    return Meaning("key", key.name, words, unit=key.unit, manual="geneva help keys")
