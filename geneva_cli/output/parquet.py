"""Parquet, for tables of millions of rows: made of the finished csv by pyarrow, an extra."""

from __future__ import annotations

import csv
from collections.abc import Collection
from importlib.util import find_spec

from geneva_cli.errors import GenevaError

BLOCK = 1 << 22  # bytes of csv at a time


def refuse_without() -> None:
    """Raise GenevaError where pyarrow is not installed."""
    if find_spec("pyarrow") is None:
        raise GenevaError(
            '.parquet needs pyarrow: pip install "geneva-cli[parquet]", or write a .csv'
        )


def convert(source: str, target: str, texts: Collection[str] = ()) -> None:
    """Write the rows of a csv file as parquet, block by block: numbers, truth values or texts.

    Columns named in ``texts`` are texts even where all their rows are empty, so that files of
    several shares have one schema.
    """
    import pyarrow as pa
    from pyarrow import csv as arrow
    from pyarrow import parquet

    types = {"number": pa.float64(), "truth": pa.bool_(), "text": pa.string()}
    options = arrow.ConvertOptions(
        column_types={
            name: types["text" if name in texts else kind] for name, kind in _kinds(source).items()
        },
        strings_can_be_null=True,
        quoted_strings_can_be_null=False,
    )
    read = arrow.ReadOptions(block_size=BLOCK)
    with (
        arrow.open_csv(source, read_options=read, convert_options=options) as rows,
        parquet.ParquetWriter(target, rows.schema) as out,
    ):
        for batch in rows:
            out.write_batch(batch)


def _kinds(source: str) -> dict[str, str]:
    """What every column holds, of all its rows: one word among numbers makes them texts."""
    with open(source, encoding="utf-8", newline="") as file:
        lines = csv.reader(file)
        names = next(lines)
        kinds: list[set[str]] = [set() for _ in names]
        for fields in lines:
            for kind, text in zip(kinds, fields, strict=True):
                if text:
                    kind.add(_kind(text))
    return {name: _one(kind) for name, kind in zip(names, kinds, strict=True)}


def _one(kinds: set[str]) -> str:
    if not kinds:
        return "number"
    return next(iter(kinds)) if len(kinds) == 1 else "text"


def _kind(text: str) -> str:
    if text in ("true", "false"):
        return "truth"
    try:
        float(text)
    except ValueError:
        return "text"
    return "number"
