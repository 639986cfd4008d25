"""Export of rows of six numbers with every digit."""

from __future__ import annotations

import csv
import importlib.util
import io
from collections.abc import Callable
from typing import Any

import numpy as np

from bench.method import Method, Subject, Task
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.motion_table import motion_table
from geneva_cli.motion.wheels.external import External
from geneva_cli.output import delimited
from geneva_cli.table import Table

COUNTS = (1_000, 100_000, 1_000_000)  # rows


class Sink(io.TextIOBase):
    """Text stream that keeps its text on request."""

    def __init__(self, keep: bool = False) -> None:
        self.parts: list[str] | None = [] if keep else None

    def write(self, text: str) -> int:
        """Write a text; return its length."""
        if self.parts is not None:
            self.parts.append(text)
        return len(text)


def with_csv(table: Table, out: Sink) -> None:
    """Write by the csv module from Python's numbers."""
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(table.names)
    writer.writerows(zip(*[c.tolist() for c in table.columns], strict=True))


def savetxt(table: Table, out: Sink) -> None:
    """Write by np.savetxt with 17 digits (with %r, NumPy 2 writes ``np.float64(...)``)."""
    header = ",".join(table.names)
    np.savetxt(out, np.column_stack(table.columns), "%.17g", ",", header=header, comments="")


def with_polars(table: Table, out: Sink) -> None:
    """Write by Polars from NumPy's columns."""
    import polars

    out.write(polars.DataFrame(dict(zip(table.names, table.columns, strict=True))).write_csv())


def with_pyarrow(table: Table, out: Sink) -> None:
    """Write by Apache Arrow's csv from NumPy's columns."""
    import pyarrow
    from pyarrow import csv as arrow

    text = io.BytesIO()
    columns = [pyarrow.array(c) for c in table.columns]
    arrow.write_csv(pyarrow.Table.from_arrays(columns, names=list(table.names)), text)
    out.write(text.getvalue().decode())


def with_orjson(table: Table, out: Sink) -> None:
    """Write by orjson: the rows of a JSON array with brackets replaced by line ends are csv."""
    import orjson

    rows = orjson.dumps(np.column_stack(table.columns), option=orjson.OPT_SERIALIZE_NUMPY)
    out.write(",".join(table.names) + "\n")
    out.write(rows[2:-2].replace(b"],[", b"\n").decode() + "\n")


def ours(table: Table, out: Sink) -> None:
    """Write the program's own csv."""
    out.writelines(delimited.chunks(table))


# Libraries that take part if they are installed.
LIBRARIES = {"orjson": with_orjson, "polars": with_polars, "pyarrow": with_pyarrow}


def subject(quick: bool) -> Subject:
    """Every writer at every number of rows."""
    mechanism = build(Spec(External(6)))
    numpy_s = "np.savetxt, %.17g"
    writers: list[tuple[str, Callable[[Table, Sink], None], bool]] = [
        ("csv module", with_csv, False),
        (numpy_s, savetxt, False),
        ("ours", ours, True),
    ]
    absent = [name for name in LIBRARIES if importlib.util.find_spec(name) is None]
    libraries = [(name, run, False) for name, run in LIBRARIES.items() if name not in absent]
    tasks = []
    for count in COUNTS[:1] if quick else COUNTS:
        # whole arrays for all writers, as the program makes its own columns while writing
        columns = motion_table(mechanism, count).to_dict()
        table = Table(tuple(columns), list(columns.values()))
        methods = [
            Method(name, count, _call(run, table), is_ours)
            for name, run, is_ours in (*libraries, *writers)
        ]
        base = _call(savetxt, table)
        tasks.append(Task(f"{count} rows x 6", numpy_s, base, _error(table), methods))
    return Subject(
        "Export with every digit", "numbers that read back differently", tasks, absent=absent
    )


def _call(run: Callable[[Table, Sink], None], table: Table) -> Callable[[], Any]:
    def call() -> Callable[[Table, Sink], None]:
        run(table, Sink())
        return run

    return call


def _error(table: Table) -> Callable[[Any], float]:
    def mismatches(run: Any) -> float:
        sink = Sink(keep=True)
        run(table, sink)
        _, *rows = csv.reader(io.StringIO("".join(sink.parts or ())))
        values = np.array(rows, dtype=float)
        return float((values != np.column_stack(table.columns)).sum())

    return mismatches
