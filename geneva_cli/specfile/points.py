"""Reader of CSV files of number pairs that a spec names; errors name the file and line."""

from __future__ import annotations

import re
from collections.abc import Iterable

from geneva_cli.errors import GenevaError, cut
from geneva_cli.spec.rules import Csv


def read_pairs(path: str, rule: Csv, key: tuple[str, ...]) -> list[tuple[float, float]]:
    """Pairs in a file, the first number of each ascending; a header and ``#`` lines are skipped.

    Raises GenevaError naming the file's line or, if the file cannot be read, the spec's key.
    """
    points: list[tuple[float, float]] = []
    for number, line in enumerate(_text(path, key).split("\n"), 1):
        row = [re.sub(r'^"(.*)"$', r"\1", cell.strip()) for cell in line.split(",")]
        if row == [""] or row[0].startswith("#") or row == [rule.x, rule.y]:
            continue
        where = f"{path}:{number}"
        try:
            x, y = (float(cell) for cell in row)
        except ValueError:
            shown = cut(",".join(row))
            raise GenevaError(f'{where}: "{shown}" is not two numbers {rule.x},{rule.y}') from None
        points.append((x, y))
        fault = rule.fault(points, len(points) - 1)
        if fault:
            raise GenevaError(f"{where}: {fault}")
    if len(points) < rule.points_min:
        raise GenevaError(f"{path}: {len(points)} points; at least {rule.points_min} are needed")
    return points


def digest(paths: Iterable[str]) -> str:
    """Hash of the bytes of some files, which need not exist."""
    import hashlib  # loads OpenSSL, which most runs do not need

    total = hashlib.sha256()
    for path in paths:
        try:
            with open(path, "rb") as file:
                total.update(hashlib.file_digest(file, "sha256").digest())
        except (OSError, ValueError) as error:  # ValueError: a NUL in the name
            total.update(type(error).__name__.encode())
    return total.hexdigest()


def _text(path: str, key: tuple[str, ...]) -> str:
    bytes_max = 1 << 24  # some hundred thousand points, all in memory
    try:
        with open(path, "rb") as file:
            data = file.read(bytes_max + 1)
    except OSError as error:
        raise GenevaError(
            f"cannot read the points in {cut(path, 300)}: {error.strerror}", key
        ) from None
    except ValueError as error:  # a NUL in the name
        raise GenevaError(f"cannot read the points in {cut(path, 300)}: {error}", key) from None
    if len(data) > bytes_max:
        raise GenevaError(f"{path}: larger than {bytes_max} bytes: use fewer points")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise GenevaError(f"{path}: not UTF-8 text; save the file as UTF-8") from None
