"""Meanings of words: a check, a quantity, a kind, a law, a warning, a part, or a key of a spec."""

import inspect
import textwrap
from functools import cache
from itertools import product
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.kept import load_named
from geneva_cli.manual import ENTRIES, TOPICS, Entry, entries
from geneva_cli.motion import registry
from geneva_cli.names import SHORT_UNITS, UNITS, capital, described, heading, spoken, unit_of
from geneva_cli.specfile.keys import Key, all_keys

UNIT_WORDS = {*UNITS.values(), *SHORT_UNITS.values(), "°"}  # behind a heading's comma
BEGINNINGS = {"checks": "check", "inputs": "key"}  # of a report's names, and their groups


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

    @property
    def sentence(self) -> str:
        """The first sentence of the meaning."""
        return self.meaning.partition(". ")[0].rstrip(".") + "."


@cache
def everything() -> tuple[Meaning, ...]:
    """The meanings of all names that are explained, then those of the keys."""
    explained = (_of_entry(entry, name) for entry in entries() for name in entry.names)
    return (*explained, *map(_of_key, all_keys()))


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
    wanted, known = _words(word), [one.name for one in everything()]
    printed = [name for name in known if wanted in _printed(name)]
    if not printed:  # a quantity with an ending, as pin force max
        ends = [(end, words) for end in known if end.startswith(".") for words in _printed(end)]
        for (end, words), name in product(ends, known):
            if words <= wanted and any(own | words == wanted for own in _printed(name)):
                printed.append(name + end)
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
    """Group, name and a sentence of everything that a word is part of.

    The word may be a group, such as ``checks``. Names and headings come before texts.
    """
    group = {**ENTRIES, "keys": "key"}.get(word.casefold())
    wanted = _words(word.replace("_", " "))
    named, told = list[Meaning](), list[Meaning]()
    for one in everything():
        if one.group == group or (not group and all(w in heading(one.name) for w in wanted)):
            named.append(one)
        elif not group and all(w in f"{one.name} {one.sentence}".casefold() for w in wanted):
            told.append(one)
    return list(dict.fromkeys((one.group, one.name, one.sentence) for one in named + told))


def unknown(word: str) -> GenevaError:
    """The error for a word that stands nowhere, with the nearest name."""
    known = [one.name for one in everything()]
    among = dict.fromkeys([*known, *(name.rpartition(".")[2] for name in known)])
    advice = "`geneva explain` lists what is explained"
    return GenevaError(f'"{cut(word)}" is not explained{nearest(word, among)}; {advice}')


def groups() -> list[tuple[str, int, str, str]]:
    """Each group of words: its name, how many they are, what they are, and three of them."""
    out = []
    for page, group in ENTRIES.items():
        own = [one.name for one in everything() if one.group == group]
        some = dict.fromkeys(own[i * len(own) // 3] for i in range(3))
        out.append((page, len(own), TOPICS[page], ", ".join(some)))
    return out


def as_markdown(known_meanings: list[Meaning]) -> str:
    """Meanings as a Markdown page."""
    lines: list[str] = []
    for one in known_meanings:
        lines += [f"## {one.name} ({one.group})", "", *_wrapped(one.meaning), ""]
        for name, text in one._asdict().items():
            if text and name not in ("group", "name", "meaning"):
                lines += _wrapped(f"- {name.capitalize().replace('_', ' ')}: {text}")
        lines.append("")
    return "\n".join(lines)


def _wrapped(text: str) -> list[str]:
    indent = "  " if text.startswith("- ") else ""
    return textwrap.wrap(
        text, 90, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    )


def _lookup(word: str) -> list[Meaning]:
    known, (beginning, _, bare) = everything(), word.partition(".")
    own = [one for one in known if one.group == BEGINNINGS.get(beginning)]
    if own := [one for one in own if f".{one.name}".endswith(f".{bare}")]:
        return own
    last = [one for one in known if f".{one.name}".endswith(f".{word}")]
    keys = [one for one in last if one.group == "key"]
    if exact := [one for one in known if one.name.removeprefix(".") == word]:
        return [*dict.fromkeys(exact + keys)]
    # a quantity with an ending such as .rms: the ending's meaning, then the quantity's
    base, _, end = word.rpartition(".")
    ending = next((one for one in known if base and one.name == f".{end}"), None)
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
    # several names of one thing have one meaning
    return [*{(one.group, one.meaning): one for one in reversed(last)}.values()][::-1]


def _of_entry(entry: Entry, name: str) -> Meaning:
    """Meaning of an entry; for a kind or law, its class's own summary comes first."""
    about, kinds = "", registry.GEARINGS | registry.DRIVES
    if entry.group == "law":
        text = capital(registry.law(name).ABOUT)
        about = text if text.endswith(".") else f"{text}."
    elif entry.group == "kind" and name in kinds:
        about = str(inspect.getdoc(load_named(kinds[name]))).partition("\n")[0]
    return Meaning(
        entry.group,
        name,
        f"{about} {entry.meaning}".strip(),
        entry.unit or next((u for n in (name, *entry.names) if (u := unit_of(n))), None),
        entry.formula or None,
        entry.source or None,
        entry.to_do or None,
        ", ".join(f"geneva help {topic}" for topic in entry.topics),
    )


def _of_key(key: Key) -> Meaning:
    """Meaning of a key of a spec, as in ``geneva keys``."""
    default = "required" if key.required else f"default {key.default}" if key.default else None
    texts = (key.type, key.range, key.goes_with, default, f"a key of [{key.table}]")
    words = f"{key.meaning} ({'; '.join(text for text in texts if text)})."
    return Meaning("key", key.name, words, key.unit, manual="geneva help keys")
