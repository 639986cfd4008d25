"""Parquet, for tables of millions of rows, converted from csv by pyarrow (an extra)."""

from __future__ import annotations

import csv
import os
from collections.abc import Collection, Iterable
from importlib.util import find_spec
from tempfile import TemporaryFile
from typing import BinaryIO

from geneva_cli.errors import GenevaError


def refuse_without() -> None:
    """Raise GenevaError if pyarrow is not installed."""
    if find_spec("pyarrow") is None:
        raise GenevaError(
            '.parquet needs pyarrow: pip install "geneva-cli[parquet]", or write a .csv'
        )


def convert(lines: Iterable[bytes], target: BinaryIO, texts: Collection[str] = ()) -> None:
    """Write the lines of a csv file as parquet, block by block: numbers, truth values or texts.

    Columns named in ``texts`` are texts even if all their rows are empty, so that the files of
    several shards have one schema.
    """
    import pyarrow as pa
    from pyarrow import csv as arrow
    from pyarrow import parquet

    types = {"number": pa.float64(), "truth": pa.bool_(), "text": pa.string()}
    # The lines are read twice, so they go to a file without a name, in the folder of the result.
    with TemporaryFile(dir=os.path.dirname(target.name)) as source:
        source.writelines(lines)
        kinds = _kinds(source)
        options = arrow.ConvertOptions(
            column_types={
                name: types["text" if name in texts else kind] for name, kind in kinds.items()
            },
            strings_can_be_null=True,
            quoted_strings_can_be_null=False,
        )
        source.seek(0)
        read = arrow.ReadOptions(block_size=1 << 22)  # bytes of csv at a time
        with (
            arrow.open_csv(source, read_options=read, convert_options=options) as rows,
            parquet.ParquetWriter(target, rows.schema) as out,
        ):
            for batch in rows:
                out.write_batch(batch)


def _kinds(source: BinaryIO) -> dict[str, str]:
    """The type of every column from all its rows: one word among numbers makes it text."""
    source.seek(0)
    lines = csv.reader(line.decode() for line in source)
    names = next(lines)
    kinds: list[set[str]] = [set() for _ in names]
    for fields in lines:
        for kind, text in zip(kinds, fields, strict=True):
            if text:
                kind.add(_kind(text))
    return {
        name: (kind or {"number"}).pop() if len(kind) < 2 else "text"
        for name, kind in zip(names, kinds, strict=True)
    }


def _kind(text: str) -> str:
    if text in ("true", "false"):
        return "truth"
    try:
        float(text)
    except ValueError:
        return "text"
    return "number"
