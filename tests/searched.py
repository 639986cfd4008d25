"""Machines that `synth` finds for requirements, searched for once in all tests of a process."""

import functools

from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search


@functools.cache
def _searched(options):
    target = read_target(**dict(options))
    return target, search(target)


def searched(**options):
    """A target, and the ranking of the machines for it."""
    said = {k: tuple(v) if isinstance(v, list) else v for k, v in options.items()}
    return _searched(tuple(sorted(said.items())))
