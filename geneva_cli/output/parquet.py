"""Parquet, for tables of millions of rows, written from columns by pyarrow (an extra)."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, BinaryIO

from geneva_cli.errors import GenevaError, clean

if TYPE_CHECKING:
    import pyarrow as pa

ROWS = 1 << 17  # of a group of the file: some megabytes


def refuse_without() -> None:
    """Raise GenevaError if pyarrow is not installed."""
    if find_spec("pyarrow") is None:
        raise GenevaError(
            '.parquet needs pyarrow: pip install "geneva-cli[parquet]", or write a .csv'
        )


def block_of(names: Sequence[str], columns: Sequence[Any]) -> bytes:
    """A block of rows, for ``write``.

    Columns are arrays, in which infinity is no value, or lists of cells.
    """
    import pyarrow as pa

    sink = pa.BufferOutputStream()
    batch = pa.record_batch([*map(_array, columns)], [*names])
    with pa.ipc.new_stream(sink, batch.schema) as out:
        out.write_batch(batch)
    return sink.getvalue().to_pybytes()


def write(
    target: BinaryIO, blocks: Callable[[], Iterable[bytes]], texts: Collection[str] = ()
) -> None:
    """Write a file of numbers, truth values or texts, from all blocks that ``blocks`` yields.

    The type of a column follows from all its rows. Columns named in ``texts`` are texts even if all
    their rows are empty.
    """
    import pyarrow as pa
    from pyarrow import parquet

    types: dict[str, set[pa.DataType]] = {}
    for field in (field for block in blocks() for field in pa.ipc.open_stream(block).schema):
        types.setdefault(field.name, set()).add(field.type)
    schema = pa.schema(
        [(name, pa.string() if name in texts else _common(own)) for name, own in types.items()]
    )
    words = [field.name for field in schema if str(field.type) == "string"]
    with parquet.ParquetWriter(target, schema, use_dictionary=words) as out:
        group: list[pa.Table] = []
        for block in blocks():
            group.append(_cast(pa.ipc.open_stream(block).read_all(), schema))
            if sum(map(len, group)) >= ROWS:
                out.write_table(pa.concat_tables(group))
                group = []
        if group:
            out.write_table(pa.concat_tables(group))


def _array(column: Any) -> pa.Array:
    """The cells as numbers, truth values or texts, whichever they are; all None is of no type."""
    import numpy as np
    import pyarrow as pa

    if not isinstance(column, list):
        missing = np.isinf(column)
        return pa.array(column + 0, mask=missing if missing.any() else None)  # no -0.0
    if column.count(None) == len(column):
        return pa.nulls(len(column))
    types = {*map(type, column)} - {type(None)}
    if types <= {int, float}:
        return pa.array(column, pa.float64())
    return pa.array(column if types == {bool} else [*map(_text, column)])


def _text(cell: object) -> str | None:
    if isinstance(cell, bool):
        return "true" if cell else "false"
    return None if cell is None else clean(str(cell)) or None


def _common(types: set[pa.DataType]) -> pa.DataType:
    """The type for cells of all these types: one word among numbers makes all of them texts."""
    import pyarrow as pa

    known = types - {pa.null()}
    if known <= {pa.float64(), pa.int64()}:
        return pa.float64()
    return known.pop() if len(known) == 1 else pa.string()


def _cast(table: pa.Table, schema: pa.Schema) -> pa.Table:
    """The table in another schema; a number or a truth value that becomes a text is as in csv."""
    import pyarrow as pa

    columns = []
    for field, column in zip(schema, table.columns, strict=True):
        is_text = field.type == pa.string()
        if is_text and column.type not in (pa.string(), pa.null()):
            column = pa.array([*map(_text, column.to_pylist())], pa.string())
        if column.type == pa.null():
            column = pa.nulls(len(column), field.type)
        # a cast imports a twentieth of a second of pyarrow
        columns.append(column if column.type == field.type else column.cast(field.type))
    return pa.table(columns, schema=schema)
