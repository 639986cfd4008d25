"""From a table to text, on standard output or in a file; one file a format."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Iterable, Iterator
from typing import Protocol, cast

from geneva_cli.errors import GenevaError
from geneva_cli.table import Table

# --format -> module; the extension of a file names a format too
FORMATS = {"table": "text", "csv": "delimited", "json": "jsonfile", "md": "markdown"}
EXTENSIONS = {"txt": "table", "csv": "csv", "json": "json", "md": "md"}


class Format(Protocol):
    """What a format's module offers."""

    def chunks(self, table: Table, terminal: bool) -> Iterator[str]:
        """The text, in pieces; ``terminal`` is true where a person looks."""


def show(table: Table, output: str = "-", format: str = "", inputs: Iterable[str] = ()) -> None:
    """Print the table, or write it to the file ``output``; ``inputs`` are never overwritten."""
    name = format or format_of(output)
    if name not in FORMATS:
        raise GenevaError(f"--format {name}: it must be one of {', '.join(FORMATS)}")
    module = cast(Format, importlib.import_module(f"geneva_cli.output.{FORMATS[name]}"))
    if output == "-":
        for chunk in module.chunks(table, sys.stdout.isatty()):
            sys.stdout.write(chunk)
        return
    from geneva_cli.output.files import write

    write(output, module.chunks(table, False), inputs)


def show_text(text: str, output: str = "-") -> None:
    """Print a text as it is, or write it to a file."""
    if output == "-":
        sys.stdout.write(text)
        return
    from geneva_cli.output.files import write

    write(output, [text])


def format_of(output: str) -> str:
    """The format that a file's extension names; for standard output, the one for people."""
    if output == "-":
        return "table"
    extension = os.path.splitext(output)[1].lower().lstrip(".")
    if extension not in EXTENSIONS:
        known = ", ".join(f".{e}" for e in EXTENSIONS)
        raise GenevaError(
            f'-o "{output}": the extension names no format ({known}); add one, or --format'
        )
    return EXTENSIONS[extension]
