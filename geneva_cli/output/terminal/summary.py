"""Summaries for people: a headline with a sign, then lines that fit the window."""

import re
import sys
import textwrap
from collections.abc import Iterable, Iterator

from geneva_cli.answer import FAILS, NO_BREAK, PASSES, RAISED, TIMES, WARNS, Summary
from geneva_cli.errors import clean
from geneva_cli.output.text import WIDTH

LABEL_MAX = 20  # letters; a longer label stands above its text
SIGNS = {PASSES: "✓", WARNS: "!", FAILS: "✗"}
INKS = {PASSES: "\x1b[32m", WARNS: "\x1b[33m", FAILS: "\x1b[31m"}  # green, yellow, red
DIM = "\x1b[2m"
# a unit behind a number, from which it is not separated
UNIT = re.compile(r"(?<=\d) (N m s|N m|N|kg m²|kg|rad/s²?|MPa|J|W|kW|mm|µm|deg|rpm|%)(?!\w)")
ASCII = {"✓": "ok", "✗": "x", "°": " deg", "²": "2", "³": "3", "Ø": "dia."}


def chunks(summaries: Iterable[Summary], output: str, is_seen: bool) -> Iterator[str]:
    """Each summary as text, with empty lines around one that has lines.

    Its look is for a terminal if ``is_seen``, a pipe, or a file, which is always UTF-8.
    """
    columns, styled = WIDTH, False
    shown = "✓✗°²³⁻⁵".encode(sys.stdout.encoding or "ascii", "replace")
    unicode = output != "-" or b"?" not in shown
    if is_seen:
        from geneva_cli.output.terminal.layout import READABLE, window

        terminal = window(False, False)
        columns, styled = min(terminal.columns, READABLE), terminal.styled

    def inked(text: str, ink: str) -> str:
        return f"{ink}{text}\x1b[0m" if styled and ink and text else text

    before: Summary | None = None
    for summary in summaries:
        if before and (before.lines or summary.lines):
            yield "\n"
        before = summary
        sign = SIGNS.get(summary.state, "")
        sign = sign if unicode else ASCII.get(sign, sign)
        indent = " " * (len(sign) + 1) if sign else ""
        text = f"\n{indent}".join(_wrapped(summary.head, columns - len(indent), unicode))
        yield f"{inked(sign, INKS.get(summary.state, ''))} {text}\n" if sign else f"{text}\n"
        yield "\n" if summary.lines else ""
        labels = [len(line.label) for line in summary.lines if len(line.label) <= LABEL_MAX]
        wide = max(labels, default=0)
        margin = " " * (wide + 4)
        for line in summary.lines:
            label = inked(clean(line.label), INKS.get(line.state, ""))
            first = f"  {label}{' ' * (wide - len(line.label))}  "
            if len(line.label) > wide:
                yield f"  {label}\n"
                first = margin
            for words, ink in ((line.text, ""), (line.note, DIM)):
                for text in _wrapped(words, columns - len(margin), unicode):
                    yield f"{first}{inked(text, ink)}".rstrip() + "\n"
                    first = margin


def _wrapped(text: str, width: int, unicode: bool) -> list[str]:
    """A text in lines; a value is not separated from its power of ten or its unit."""
    text = UNIT.sub(lambda match: match[0].replace(" ", NO_BREAK), text)
    text = NO_BREAK.join(map(clean, text.split(NO_BREAK)))
    if not unicode:
        lowered = {raised: plain for plain, raised in RAISED.items()}
        power = f"{TIMES}10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)"
        text = re.sub(power, lambda match: f"e{match[1].translate(lowered)}", text)
        text = text.translate({ord(letter): plain for letter, plain in ASCII.items()})
    lines = textwrap.wrap(text, max(width, 1), break_long_words=False, break_on_hyphens=False)
    return "\n".join(lines).replace(NO_BREAK, " ").split("\n") if lines else []


def markdown(summaries: Iterable[Summary]) -> Iterator[str]:
    """Each summary as a paragraph and a list."""
    from geneva_cli.output.markdown import escaped

    for summary in summaries:
        yield f"**{escaped(summary.head)}**\n\n"
        for line in summary.lines:
            note = f" ({escaped(line.note)})" if line.note else ""
            yield f"- {escaped(line.label)}: {escaped(line.text)}{note}\n"
        yield "\n" if summary.lines else ""
