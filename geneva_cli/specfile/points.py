"""Reading a CSV of number pairs that a spec names; complaints name its file and line."""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut

POINTS_MAX = 100_000
BYTES_MAX = 1 << 24


class Pairs(NamedTuple):
    """What the pairs are: their names, the least step of the first, the largest second."""

    x: str
    y: str
    step_min: float
    y_max: float
    points_min: int


def read_pairs(path: str, kind: Pairs, key: tuple[str, ...]) -> list[tuple[float, float]]:
    """The pairs in a file, the first of each ascending; a header and ``#`` lines are passed over.

    Raises GenevaError naming the file's line or, where the file cannot be read, the spec's key.
    """
    points: list[tuple[float, float]] = []
    for number, line in enumerate(_text(path, key).split("\n"), 1):
        row = [re.sub(r'^"(.*)"$', r"\1", cell.strip()) for cell in line.split(",")]
        if row == [""] or row[0].startswith("#") or row == [kind.x, kind.y]:
            continue
        where = f"{path}:{number}"
        try:
            x, y = (float(cell) for cell in row)
        except ValueError:
            shown = cut(",".join(row))
            raise GenevaError(f'{where}: "{shown}" is not two numbers {kind.x},{kind.y}') from None
        if not (math.isfinite(x) and abs(y) <= kind.y_max):
            raise GenevaError(
                f"{where}: {kind.x} and {kind.y} must be finite, {kind.y} from -{kind.y_max:g} to "
                f"{kind.y_max:g}"
            )
        if points and x < points[-1][0] + kind.step_min:
            raise GenevaError(
                f"{where}: {kind.x} = {x:.12g} must be above the one before it, by "
                f"{kind.step_min:g} or more: of closer points the derivatives are rounding; thin "
                "them out"
            )
        points.append((x, y))
        if len(points) > POINTS_MAX:
            raise GenevaError(f"{where}: more than {POINTS_MAX} points; thin them out")
    if len(points) < kind.points_min:
        raise GenevaError(f"{path}: {len(points)} points; at least {kind.points_min} are needed")
    return points


def _text(path: str, key: tuple[str, ...]) -> str:
    try:
        with open(path, "rb") as file:
            data = file.read(BYTES_MAX + 1)
    except OSError as error:
        raise GenevaError(
            f"cannot read the points in {cut(path, 300)}: {error.strerror}", key
        ) from None
    except ValueError as error:  # a NUL in the name
        raise GenevaError(f"cannot read the points in {cut(path, 300)}: {error}", key) from None
    if len(data) > BYTES_MAX:
        raise GenevaError(f"{path}: larger than {BYTES_MAX} bytes; thin the points out")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise GenevaError(f"{path}: not UTF-8 text; save the file as UTF-8") from None
