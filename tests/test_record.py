"""Our named tuples against those of the standard library."""

from __future__ import annotations

import copy
import pickle
import typing
from typing import Generic, TypeVar

import pytest

from geneva_cli import record

K = TypeVar("K")


class Own(record.NamedTuple):
    x: float
    y: float = 0.5

    @property
    def total(self):
        return self.x + self.y


class Usual(typing.NamedTuple):
    x: float
    y: float = 0.5


class Kind(record.NamedTuple, Generic[K]):
    value: K


class Empty(record.NamedTuple):
    pass


USES = [
    lambda kind: kind(1.0),
    lambda kind: kind(1.0, 2.0),
    lambda kind: kind(y=2.0, x=1.0),
    lambda kind: kind._make([1.0, 2.0]),
    lambda kind: kind(1.0)._replace(y=3.0),
    lambda kind: kind(1.0)._asdict(),
    lambda kind: (kind(1.0).x, kind(1.0).y, *kind(4.0)),
    lambda kind: (kind._fields, kind._field_defaults, kind.__match_args__),
    lambda kind: (hash(kind(1.0)), kind(1.0) < kind(2.0), kind(1.0) == (1.0, 0.5)),
    lambda kind: copy.deepcopy(kind(1.0)),
    lambda kind: pickle.loads(pickle.dumps(kind(1.0, 2.0))),
]
WRONG = [
    lambda kind: kind(),
    lambda kind: kind(1.0, 2.0, 3.0),
    lambda kind: kind(1.0, z=2.0),
    lambda kind: kind._make([1.0]),
    lambda kind: kind(1.0)._replace(z=2.0),
    lambda kind: setattr(kind(1.0), "x", 2.0),
    lambda kind: setattr(kind(1.0), "z", 2.0),
]


@pytest.mark.parametrize("use", USES)
def test_does_as_the_standard_librarys(use):
    assert repr(use(Own)).replace("Own", "Usual") == repr(use(Usual))


@pytest.mark.parametrize("use", WRONG)
def test_refuses_what_the_standard_librarys_refuses(use):
    with pytest.raises((TypeError, ValueError, AttributeError)):
        use(Usual)
    with pytest.raises((TypeError, AttributeError)):
        use(Own)


def test_an_error_names_the_record():
    with pytest.raises(TypeError, match=r"Own\.__new__"):
        Own()


def test_has_methods_and_parameters():
    assert Own(1.0).total == 1.5
    assert Kind[int](3).value == 3 and Empty() == ()
    assert Own(1.0).__class__ is Own and isinstance(Own(1.0), tuple)
