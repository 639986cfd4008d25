"""The examples in docstrings, run: everything public has one. And what the package offers."""

import ast
import doctest
import importlib
import inspect
import os
from functools import cached_property

import pytest
import repo

import geneva_cli
from geneva_cli import Design, Motion
from geneva_cli.spec.schema import SpecTable

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


OFFERED = {name: getattr(geneva_cli, name) for name in geneva_cli.__all__ if name != "__version__"}
# Classes whose methods are for a user to call, besides what is offered. The methods of drives and
# wheels are what the machine asks of them.
CALLED = (Design, Motion, SpecTable)


def public():
    """What a Python user sees, by name: what is offered, and its methods."""
    yield from OFFERED.items()
    for cls in CALLED:
        for name, made in vars(cls).items():
            # a field's default is no method, and has no text of its own
            if not name.startswith("_") and (callable(made) or hasattr(made, "__get__")):
                yield f"{cls.__name__}.{name}", made


PUBLIC = dict(public())


@pytest.mark.parametrize("module", sorted(with_examples()))
def test_examples_of(module, monkeypatch):
    monkeypatch.chdir(repo.ROOT)
    found = importlib.import_module(module)
    taken = {**OFFERED, **vars(found)}
    result = doctest.testmod(found, globs=taken, optionflags=doctest.ELLIPSIS)
    assert result.attempted
    assert not result.failed


@pytest.mark.parametrize("name", PUBLIC)
def test_everything_public_has_an_example(name, monkeypatch):
    text = inspect.getdoc(PUBLIC[name])
    example = doctest.DocTestParser().get_doctest(text, dict(OFFERED), name, None, None)
    assert example.examples
    if isinstance(PUBLIC[name], cached_property):  # which doctest finds in later Pythons only
        monkeypatch.chdir(repo.ROOT)
        assert not doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(example).failed


def test_what_is_offered_is_there_and_typed():
    """What a type checker sees is what runs: each name once in either list, and the same thing."""
    with open(f"{geneva_cli.__file__}i", encoding="utf-8") as text:
        nodes = [node for node in ast.parse(text.read()).body if isinstance(node, ast.ImportFrom)]
    typed = {alias.name: node.module for node in nodes for alias in node.names}
    offered = [name for name in geneva_cli.__all__ if name != "__version__"]
    assert sorted(typed) == sorted(offered)
    for name, module in typed.items():
        assert getattr(geneva_cli, name) is getattr(importlib.import_module(module), name)
    with pytest.raises(AttributeError, match="no attribute 'Wheel'"):
        geneva_cli.Wheel  # noqa: B018
