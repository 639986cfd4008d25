"""The designs that come with the program: whole specs to start from."""

from __future__ import annotations

import os

import tomli

from geneva_cli.errors import GenevaError, cut, nearest


def names() -> list[str]:
    """Names of the designs, sorted."""
    files = sorted(os.listdir(_folder()))
    return [file.removesuffix(".toml") for file in files if file.endswith(".toml")]


def titles() -> dict[str, str]:
    """Names of the designs, with their titles.

    >>> from geneva_cli.specfile.designs import titles
    >>> titles()["side-crank-z6"]
    'Side-crank, six slots, A = 0.6'
    """
    return {name: str(tomli.loads(_text(f"{name}.toml"))["title"]) for name in names()}


def design(name: str) -> tuple[str, dict[str, str]]:
    """Text of a design's spec, and the texts of the files that it names, by name.

    Raises GenevaError, with the nearest name, for an unknown design.
    """
    known = titles()
    if name not in known:
        raise GenevaError(
            f"--from-design {cut(name)}: no such design{nearest(name, known)}; "
            "`geneva new --list` lists them"
        )
    text = _text(f"{name}.toml")
    points = [file for file in os.listdir(_folder()) if file.endswith(".csv")]
    return text, {file: _text(file) for file in points if f'"{file}"' in text}


def _folder() -> str:
    """The folder of the designs: in the package if installed, else adjacent to it."""
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    inside = os.path.join(package, "designs")
    return inside if os.path.isdir(inside) else os.path.join(os.path.dirname(package), "designs")


def _text(file: str) -> str:
    with open(os.path.join(_folder(), file), encoding="utf-8") as opened:
        return opened.read()
