"""NamedTuple against that of ``typing``: a class with each, used in the same ways."""

from __future__ import annotations

import copy
import pickle
import typing
from typing import Generic, TypeVar

import pytest

from geneva_cli.named_tuple import NamedTuple

V = TypeVar("V")


class Ours(NamedTuple, Generic[V]):
    """Three fields."""

    first: V
    second: NotImported  # noqa: F821 - a name for type checkers alone
    third: float = 3.0

    @property
    def last_two(self):
        return self[1:]


class Theirs(typing.NamedTuple, Generic[V]):
    first: V
    second: NotImported  # noqa: F821
    third: float = 3.0

    @property
    def last_two(self):
        return self[1:]


class Derived(Ours):
    """A class above has the fields; this one adds a method."""

    note: str = "no field"

    def total(self):
        return sum(self)


class Empty(NamedTuple):
    pass


USES = [
    lambda kind: kind(1, 2),
    lambda kind: kind(1, 2, 4.0),
    lambda kind: kind(1, third=5, second=2),
    lambda kind: kind[int](first=1, second=2),
    lambda kind: kind._make([1, 2, 3]),
    lambda kind: kind(1, 2)._replace(first=7, third=8),
    lambda kind: kind(1, 2)._asdict(),
    lambda kind: kind._fields,
    lambda kind: kind._field_defaults,
    lambda kind: kind.__match_args__,
    lambda kind: kind(1, 2).last_two,
    lambda kind: (kind(1, 2).first, kind(1, 2).second, kind(1, 2).third),
    lambda kind: repr(kind("a", 2)).removeprefix(kind.__name__),
    lambda kind: hash(kind(1, 2)),
    lambda kind: pickle.loads(pickle.dumps(kind(1, 2))),
    lambda kind: copy.deepcopy(kind(1, [2])),
]
REFUSED = [
    lambda kind: kind(1),
    lambda kind: kind(1, 2, 3, 4),
    lambda kind: kind(1, 2, first=1),
    lambda kind: kind(1, 2, fourth=1),
    lambda kind: kind(1, 2, 3, third=3),
    lambda kind: kind._make([1]),
    lambda kind: kind(1, 2)._replace(fourth=1),
    lambda kind: setattr(kind(1, 2), "first", 2),
    lambda kind: setattr(kind(1, 2), "other", 2),
    lambda kind: delattr(kind(1, 2), "first"),
]


@pytest.mark.parametrize("use", USES)
def test_it_is_that_of_typing(use):
    assert use(Ours) == use(Theirs)


@pytest.mark.parametrize("use", REFUSED)
def test_it_refuses_what_that_of_typing_refuses(use):
    for kind in (Ours, Theirs):
        with pytest.raises((TypeError, AttributeError, ValueError)):
            use(kind)


@pytest.mark.parametrize(
    ("use", "message"),
    [
        (lambda: Ours(1), r"Ours\(\) needs second"),
        (lambda: Ours(1, 2, first=3), "has first already"),
        (lambda: Ours(1, 2, thrd=2), "has no field thrd"),
        (lambda: Ours(1, 2, 3, 4), "has 3 fields, not 4"),
        (lambda: Ours(1, 2)._replace(thrd=2), "has no field thrd"),
    ],
)
def test_a_message_says_what_is_wrong(use, message):
    with pytest.raises((TypeError, ValueError), match=message):
        use()


def test_a_class_may_add_methods_or_have_no_field():
    assert Derived(1, 2).total() == 6.0
    assert Derived._fields == Ours._fields
    assert Empty() == ()
    match Derived(1, 2):
        case Derived(first, second):
            assert (first, second) == (1, 2)


def test_a_copy_has_its_class_and_no_dictionary():
    assert type(copy.copy(Derived(1, 2))) is Derived
    assert not hasattr(Ours(1, 2), "__dict__")
