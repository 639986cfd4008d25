"""What a terminal of any width must hold: no line too wide, no word and no number broken."""

import itertools
import re
import unicodedata
from contextlib import contextmanager

import pytest

from geneva_cli.output import text
from geneva_cli.output.terminal import page_reader
from geneva_cli.output.terminal import terminal_tables as terminal
from geneva_cli.output.terminal.layout import Window

COLUMNS = (60, 80, 120, 200)
STYLED = (True, False)
WIDEST = Window(1_000_000, whole=True, wide=True)
ESCAPE = re.compile(r"\x1b\[[0-9;]*m")
MORE = re.compile(r"\d+ more columns?: --wide(?:, or --columns (\S+))?")
# what the program says between the cells
OWN = {"In", "every", "row", "no", "rows", "-"}
LONG = 40  # letters of a path or a list that may be broken behind a sign
MARKS = ".,;:()`*\"'"


def bare(line):
    return ESCAPE.sub("", line)


def width(line):
    """Columns of a line, as the Unicode standard has them."""
    return sum(1 + (unicodedata.east_asian_width(c) in "WF") for c in line)


def words(lines):
    """The words of some lines, of long ones also the parts."""
    found = {word.strip(MARKS) for line in lines for word in bare(line).split()}
    found |= {p.strip(MARKS) for w in found if len(w) > LONG for p in re.split(r"[/,=]|::", w)}
    return found


def require_width(lines, columns):
    for line in map(bare, lines):
        assert width(line) <= columns, f"{width(line)} of {columns}: {line}"
        assert "…" not in line


def require_whole(lines, columns, known):
    """Nothing too wide, and no word that is not ``known``: it would be a piece of one."""
    require_width(lines, columns)
    more = [found[1] for found in map(MORE.match, map(bare, lines)) if found and found[1]]
    own = [line for line in lines if not MORE.match(bare(line))]
    strange = {word for word in words(own) - known - OWN if any(map(str.isalnum, word))}
    strange = {w for w in strange if not any(p in known for p in re.split(r"[/,=]|::", w) if p)}
    assert not strange, (columns, sorted(strange))
    return more


def look_at_table(table, chunks=terminal.chunks):
    """A table in every window: its words are those of the same table without a window."""
    known = words("".join(chunks(table, WIDEST)).splitlines())
    inner = [v for v in next(table.rows(), ()) if hasattr(v, "names")] if table.record else []
    names = {name for one in (table, *inner) for name in one.names}
    title = words([table.title, table.reading.title, table.prose])
    for columns, styled in itertools.product(COLUMNS, STYLED):
        lines = "".join(chunks(table, Window(columns, styled))).splitlines()
        assert styled or lines == [bare(line) for line in lines]
        for said in require_whole(lines, columns, known | title):
            assert set(said.removesuffix(",...").split(",")) <= names


def look_at_page(page):
    """A page of Markdown in every window."""
    both = (WIDEST, WIDEST._replace(styled=True))
    known = {w for one in both for w in words("".join(page_reader.chunks(page, one)).splitlines())}
    for columns, styled in itertools.product(COLUMNS, STYLED):
        lines = "".join(page_reader.chunks(page, Window(columns, styled))).splitlines()
        require_whole(lines, columns, known)


@contextmanager
def looking():
    """Look at every table that is printed meanwhile."""
    tables, fitted = text.chunks, terminal.chunks

    def shown(table):
        look_at_table(table, fitted)
        return tables(table)

    def seen(table, window):
        look_at_table(table, fitted)
        return fitted(table, window)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(text, "chunks", shown)
        patch.setattr(terminal, "chunks", seen)
        yield
