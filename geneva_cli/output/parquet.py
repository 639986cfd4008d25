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
    """A block of rows, for ``write_blocks``.

    Columns are arrays, in which infinity is no value, or lists of cells.
    """
    import pyarrow as pa

    sink = pa.BufferOutputStream()
    batch = pa.record_batch([*map(_array, columns)], [*names])
    with pa.ipc.new_stream(sink, batch.schema) as out:
        out.write_batch(batch)
    return sink.getvalue().to_pybytes()


class Writer:
    """A parquet file of numbers, truth values or texts, from blocks of rows.

    The type of a column follows from all its rows: where a block changes it, the file is written
    again, from all that ``blocks`` yields. Columns named in ``texts`` are texts even if all their
    rows are empty.
    """

    def __init__(
        self,
        target: BinaryIO,
        blocks: Callable[[], Iterable[bytes]],
        texts: Collection[str] = (),
    ) -> None:
        self.target, self.blocks, self.texts = target, blocks, texts
        self._types: dict[str, set[pa.DataType]] = {}
        self._group: list[pa.Table] = []  # of rows that are not written yet
        self._out: Any = None

    def append(self, block: bytes) -> None:
        """Write a block, the last one of ``blocks``."""
        if self._changes(block):
            self.rewrite()
        else:
            self._write(block)

    def rewrite(self) -> None:
        """Write all blocks, from the beginning of the file."""
        import pyarrow as pa
        from pyarrow import parquet

        for block in self.blocks():
            self._changes(block)
        self.close()
        self.target.seek(0)
        self.target.truncate()
        types = {
            name: pa.string() if name in self.texts else _common(own)
            for name, own in self._types.items()
        }
        words = [name for name, own in types.items() if own == pa.string()]
        self._out = parquet.ParquetWriter(self.target, pa.schema(types), use_dictionary=words)
        for block in self.blocks():
            self._write(block)

    def close(self) -> None:
        """Write what is left, and the end of the file."""
        self._flush()
        if self._out:
            self._out.close()

    def _changes(self, block: bytes) -> bool:
        """Return True if a column of the block has a type that none had before."""
        import pyarrow as pa

        before = sum(map(len, self._types.values()))
        for field in pa.ipc.open_stream(block).schema:
            self._types.setdefault(field.name, set()).add(field.type)
        return sum(map(len, self._types.values())) > before

    def _write(self, block: bytes) -> None:
        import pyarrow as pa

        self._group.append(_cast(pa.ipc.open_stream(block).read_all(), self._out.schema))
        if sum(map(len, self._group)) >= ROWS:
            self._flush()

    def _flush(self) -> None:
        import pyarrow as pa

        if self._group:
            self._out.write_table(pa.concat_tables(self._group))
            self._group = []


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
