"""The examples in docstrings, run; and what is offered at the top of the package."""

import ast
import doctest
import importlib
import os

import pytest

import geneva_cli

ROOT = os.path.dirname(geneva_cli.__file__)


def with_examples():
    for folder, _, files in os.walk(ROOT):
        for file in sorted(files):
            path = os.path.join(folder, file)
            if file.endswith(".py"):
                with open(path, encoding="utf-8") as text:
                    if ">>> " in text.read():
                        name = os.path.relpath(path, ROOT).removesuffix(".py").replace(os.sep, ".")
                        yield f"geneva_cli.{name}"


@pytest.mark.parametrize("module", sorted(with_examples()))
def test_examples_of(module):
    result = doctest.testmod(importlib.import_module(module), optionflags=doctest.ELLIPSIS)
    assert result.attempted
    assert not result.failed


def test_what_is_offered_is_there_and_typed():
    """What a type checker sees is what runs: each name once in either list, and the same thing."""
    with open(geneva_cli.__file__, encoding="utf-8") as text:
        tree = ast.parse(text.read())
    block = next(node for node in tree.body if isinstance(node, ast.If))
    typed = {alias.name: node.module for node in block.body for alias in node.names}
    offered = [name for name in geneva_cli.__all__ if name != "__version__"]
    assert sorted(typed) == sorted(offered)
    for name, module in typed.items():
        assert getattr(geneva_cli, name) is getattr(importlib.import_module(module), name)
    with pytest.raises(AttributeError, match="no attribute 'Wheel'"):
        geneva_cli.Wheel  # noqa: B018
