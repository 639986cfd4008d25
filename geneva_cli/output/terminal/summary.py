"""Summaries for people: a headline with a sign, then lines that fit the window."""

from __future__ import annotations

import re
import sys
import textwrap
from collections.abc import Iterable, Iterator

from geneva_cli.answer import FAILS, NO_BREAK, PASSES, RAISED, TIMES, WARNS, Summary, SummaryLine
from geneva_cli.errors import clean
from geneva_cli.output.terminal.layout import DIM, Window, styled, window
from geneva_cli.output.text import WIDTH

SIGNS = {PASSES: "✓", WARNS: "!", FAILS: "✗"}
INKS = {PASSES: "\x1b[32m", WARNS: "\x1b[33m", FAILS: "\x1b[31m"}  # green, yellow, red


def style_of(output: str, is_seen: bool) -> Window:
    """The look for a terminal if ``is_seen``, a pipe, or a file, which is always UTF-8."""
    if output != "-":
        return Window(WIDTH)
    try:
        "✓✗°²³⁻⁵".encode(sys.stdout.encoding or "ascii")
        unicode = True
    except (UnicodeEncodeError, LookupError):
        unicode = False
    if not is_seen:
        return Window(WIDTH, unicode=unicode)
    terminal = window(False, False)
    # Lines of more than 100 letters are hard to read.
    return terminal._replace(columns=min(terminal.columns, 100), unicode=unicode)


def chunks(summaries: Iterable[Summary], look: Window) -> Iterator[str]:
    """Each summary as text, with empty lines around one that has lines."""
    before: Summary | None = None
    for summary in summaries:
        if before and (before.lines or summary.lines):
            yield "\n"
        yield _head(summary, look)
        if summary.lines:
            yield "\n"
            yield from _lines(summary.lines, look)
        before = summary


def _head(summary: Summary, look: Window) -> str:
    sign = _letters(SIGNS.get(summary.state, ""), look)
    indent = " " * (len(sign) + 1) if sign else ""
    text = "\n".join(_wrapped(summary.head, look.columns - len(indent), look))
    text = text.replace("\n", f"\n{indent}")
    sign = styled(sign, INKS.get(summary.state, ""), look.styled)
    return f"{sign} {text}\n" if sign else f"{text}\n"


def _lines(lines: Iterable[SummaryLine], look: Window) -> Iterator[str]:
    lines = list(lines)
    label_max = 20  # letters; a longer label stands above its text
    wide = max((len(line.label) for line in lines if len(line.label) <= label_max), default=0)
    width = look.columns - wide - 4
    for line in lines:
        label = styled(clean(line.label), INKS.get(line.state, ""), look.styled)
        texts = _wrapped(line.text, width, look)
        notes = [styled(note, DIM, look.styled) for note in _wrapped(line.note, width, look)]
        first = f"  {label}{' ' * (wide - len(line.label))}  "
        if len(line.label) > wide:
            yield f"  {label}\n"
            first = " " * (wide + 4)
        for number, text in enumerate([*texts, *notes]):
            yield f"{' ' * (wide + 4) if number else first}{text}".rstrip() + "\n"


def _wrapped(text: str, width: int, look: Window) -> list[str]:
    """A text in lines; a value is not separated from its power of ten or its unit."""
    text = re.sub(
        r"(?<=\d) (N m s|N m|N|kg m²|kg|rad/s²?|MPa|J|W|kW|mm|µm|deg|rpm|%)(?!\w)",
        lambda unit: NO_BREAK + unit[1].replace(" ", NO_BREAK),
        text,
    )
    text = _letters(NO_BREAK.join(map(clean, text.split(NO_BREAK))), look)
    lines = textwrap.wrap(text, max(width, 1), break_long_words=False, break_on_hyphens=False)
    return [line.replace(NO_BREAK, " ") for line in lines]


def _letters(text: str, look: Window) -> str:
    if look.unicode:
        return text
    lowered = {raised: plain for plain, raised in RAISED.items()}
    power = f"{TIMES}10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)"
    text = re.sub(power, lambda match: f"e{match[1].translate(lowered)}", text)
    ascii_letters = {"✓": "ok", "✗": "x", "°": " deg", "²": "2", "³": "3", "Ø": "dia."}
    return "".join(ascii_letters.get(letter, letter) for letter in text)


def markdown(summaries: Iterable[Summary]) -> Iterator[str]:
    """Each summary as a paragraph and a list."""
    from geneva_cli.output.markdown import escaped

    for summary in summaries:
        yield f"**{escaped(summary.head)}**\n\n"
        for line in summary.lines:
            note = f" ({escaped(line.note)})" if line.note else ""
            yield f"- {escaped(line.label)}: {escaped(line.text)}{note}\n"
        yield "\n" if summary.lines else ""
