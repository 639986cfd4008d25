"""The motion law that a spec names."""

from __future__ import annotations

from geneva_cli.errors import GenevaError, cut
from geneva_cli.machine.laws.standard import Law, named
from geneva_cli.spec.tables import Spec


def law_of(spec: Spec) -> Law:
    """The motion law that a spec names; GenevaError, naming the key, for one that is not known."""
    motion = spec.motion
    if motion.lambda_ and motion.law != "sine-group":
        raise GenevaError(
            f'lambda shapes only the law "sine-group", not "{cut(motion.law or "")}"',
            ("motion", "lambda"),
        )
    if motion.law == "table":
        from geneva_cli.machine.laws.table import read_law

        return read_law(spec)
    if motion.file is not None:
        raise GenevaError(
            'file goes with law = "table"; remove it or change the law', ("motion", "file")
        )
    try:
        return named(motion.law or "", motion.lambda_)
    except GenevaError as error:
        raise GenevaError(str(error), ("motion", "law")) from None
