"""Specs to compare: several files, or one spec with keys varied."""

from __future__ import annotations

import itertools
import os
from collections.abc import Collection, Mapping, Sequence

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError, cut
from geneva_cli.specfile.reader import Text, read, shown_name
from geneva_cli.specfile.settings import setting
from geneva_cli.study.sweep.values import axis, refuse_twice

DESIGNS_MAX = 100  # in one comparison


def spec_texts(
    paths: Sequence[str],
    settings: Sequence[str] = (),
    vary: Sequence[str] = (),
    taken: Collection[str] = (),
) -> dict[str, Text]:
    """The texts of specs, by a short name each that is not one of ``taken``.

    ``settings``, texts ``KEY=VALUE``, replace keys of each spec. With ``vary``, texts
    ``KEY=VALUES``, there is one spec, and a text for each combination of values. Raises GenevaError
    for a spec that cannot be read, or that stands twice in ``paths``.
    """
    if vary:
        if len(paths) > 1:
            raise GenevaError("--vary is for one SPEC; leave it out to compare several")
        return _varied(read(paths[0], settings), vary)
    paths = list(paths)
    twice = next((p for p in paths if paths.count(p) > 1), None)
    if twice:
        raise GenevaError(
            f"{cut(shown_name(twice))}: given twice; use --vary to compare changes of one spec"
        )
    if len(paths) > DESIGNS_MAX:
        raise GenevaError(f"{len(paths)} designs; at most {DESIGNS_MAX} can be compared")
    # a file's name without folder and ending, if no other file shares it
    stems = [os.path.splitext(os.path.basename(path))[0] for path in paths]
    is_short = [stems.count(stem) == 1 and stem not in taken for stem in stems]
    names = [s if short else p for s, short, p in zip(stems, is_short, paths, strict=True)]
    return {name: read(path, settings) for name, path in zip(names, paths, strict=True)}


def designs_of(texts: Mapping[str, Text], reverse: bool) -> dict[str, Design]:
    """The designs of texts by their names; with ``reverse`` each also turns the other way."""
    out: dict[str, Design] = {}
    for name, text in texts.items():
        out[name] = Design.of(text.spec(), text)
        if reverse:
            out[f"{name} backwards"] = out[name].backwards
    return out


def _varied(text: Text, vary: Sequence[str]) -> dict[str, Text]:
    axes = [axis(v) for v in vary]
    refuse_twice(axes, text.set_keys)
    out: dict[str, Text] = {}
    for values in itertools.product(*[a.values for a in axes]):
        texts = [f"{a.key}={v}" for a, v in zip(axes, values, strict=True)]
        changes = tuple(setting(s, "--vary") for s in texts)
        out[" ".join(texts)] = text._replace(set_keys=(*text.set_keys, *changes))
        if len(out) > DESIGNS_MAX:
            raise GenevaError(
                f"--vary makes more than {DESIGNS_MAX} designs: `geneva sweep` has a row for each"
            )
    return out
