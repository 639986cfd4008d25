"""Machines under test, built as a spec would build them."""

import pytest
from words import Drive, Keys, Motion, Spec, Wheel

from geneva_cli.machine.mechanism import build


@pytest.fixture(scope="session")
def machine():
    """A function to build a mechanism; A = 0 is a plain crank, other keywords are ``[motion]``."""

    def make(z, gearing="external", A=0.0, rollers=1, path="", **motion):
        kind, keys = ("side-crank", Keys("side-crank", A)) if A else ("crank", None)
        drive = Drive(kind, 60.0, rollers)
        return build(Spec(Wheel(z, gearing), drive, keys, motion=Motion(**motion), path=path))

    return make


@pytest.fixture(scope="session")
def engagement(machine):
    """A function to build a mechanism and take its first engagement."""
    return lambda *args, **keys: machine(*args, **keys).engagements[0]
