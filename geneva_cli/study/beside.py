"""Specs for a comparison: several files, or one spec with keys varied."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Sequence

from geneva_cli.errors import GenevaError, cut
from geneva_cli.specfile.reader import Text, read, shown_name
from geneva_cli.specfile.settings import setting
from geneva_cli.study.names import short_name
from geneva_cli.study.sweep.values import axis, refuse_twice

MOST = 100  # designs in one comparison


def beside(
    paths: Sequence[str],
    given: Sequence[str] = (),
    vary: Sequence[str] = (),
    taken: Collection[str] = (),
) -> dict[str, Text]:
    """The specs' texts by a short name each; ``taken`` are names that may not be used.

    With ``vary``, texts ``KEY=VALUES``, there is one spec, and a text for each combination of
    values. Raises GenevaError for a spec that cannot be read, or is given twice.
    """
    if vary:
        if len(paths) > 1:
            raise GenevaError("--vary is for one SPEC; set several side by side without it")
        return _varied(read(paths[0], given), vary)
    twice = next((p for p in paths if list(paths).count(p) > 1), None)
    if twice:
        raise GenevaError(
            f"{cut(shown_name(twice))}: given twice; --vary shows changes of one spec"
        )
    if len(paths) > MOST:
        raise GenevaError(f"{len(paths)} designs side by side; at most {MOST}")
    return {short_name(p, paths, taken): read(p, given) for p in paths}


def _varied(text: Text, vary: Sequence[str]) -> dict[str, Text]:
    """One spec with each combination of the values."""
    axes = [axis(v) for v in vary]
    refuse_twice(axes, text.set_keys)
    out: dict[str, Text] = {}
    for some in itertools.product(*[a.values for a in axes]):
        said = [f"{a.key}={v}" for a, v in zip(axes, some, strict=True)]
        changes = tuple(setting(s, "--vary") for s in said)
        out[" ".join(said)] = text._replace(set_keys=(*text.set_keys, *changes))
        if len(out) > MOST:
            raise GenevaError(
                f"more than {MOST} designs side by side: `geneva sweep` has a row for each"
            )
    return out
