"""A check: a value, its limit, and whether the value keeps it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.numerics.tolerances import keeps

# The reason why a failing check has no advice.
NONE = "no single change that was tried passes all checks"
STOPPED = "no single change passed all checks within the limit of trials"


class Check(NamedTuple):
    """One check of one design.

    ``passes`` is None if it is not known. ``why`` is the reason for an unknown value, or for
    missing advice on a failing check; of a check that passes it says what is proved. ``at_deg`` is
    the input angle of the value, None if it is not a value at one angle. ``nearest`` is one change
    of the spec with which all checks pass, or one for each failing check: "a = 1 and b = 2".
    ``anew`` are the sizes that the load chooses anew with that change.
    """

    name: str
    value: float | None
    must_be: str
    limit: float | None
    passes: bool | None
    why: str = ""
    at_deg: float | None = None
    nearest: str = ""
    anew: str = ""
    # makes ``why`` of a failing check, which an adviser's trials do not need
    reason: Callable[[], str] | None = None

    @property
    def with_reason(self) -> Check:
        """This check, with its reason in words."""
        return self._replace(why=self.reason(), reason=None) if self.reason else self

    @property
    def remark(self) -> str:
        """The reason, and the sizes that ``nearest`` changes."""
        anew = f"sizes chosen anew with {self.nearest}: {self.anew}" if self.anew else ""
        return "; ".join(text for text in (self.why, anew) if text)

    @property
    def where(self) -> str:
        """Input angle of the value in words, with a space before it."""
        return "" if self.at_deg is None else f" at input angle {self.at_deg:.6g}°"

    @property
    def spare(self) -> float:
        """The margin to the limit, negative if the check fails; infinite without a value."""
        if self.value is None or self.limit is None:
            return -math.inf if self.passes is False else math.inf
        left = self.limit - self.value
        left = left if self.must_be == "at most" else -left
        return min(left, -5e-324) if self.passes is False else max(left, 0.0)

    @property
    def is_proof(self) -> bool:
        """True if it passes by a proof."""
        return bool(self.passes and self.why)

    @property
    def not_computed(self) -> str:
        """The reason why there is no value, in words; empty if there is one."""
        return f"{self.name} is not computed: {self.why}" if self.value is None else ""


def compared(
    name: str,
    value: float,
    must_be: str,
    limit: float,
    at_deg: float | None = None,
    noise: float = 0.0,
) -> Check:
    """The check that a value is "at least", "at most" or "above" a limit.

    ``noise`` is the rounding error of the value, if it is larger than the limit's.

    >>> compared("jerk_max", 31.4, "at most", 30.0).passes
    False
    """
    passes = keeps(value, must_be, limit, noise)
    return Check(name, value, must_be, limit, passes, at_deg=at_deg)


def refused(name: str, error: GenevaError) -> Check:
    """A failing check for parts that cannot be built, with the reason."""
    return Check(name, 0.0, "at least", 1.0, False, str(error))


def at_least(
    name: str, measure: Callable[[], float | None], limit: float, noise: float = 0.0
) -> Check | None:
    """The check that a value, if there is one, is at least a limit.

    It fails if parts cannot be built.
    """
    try:
        value = measure()
    except GenevaError as error:
        return Check(name, None, "at least", limit, False, str(error))
    return None if value is None else compared(name, value, "at least", limit, None, noise)


def gap(name: str, gaps: Callable[[], Iterable[float]], L: float) -> Check | None:
    """The least of the gaps at shafts, mm, if there is one; it fails if parts cannot be built."""
    # A gap is rounded to 1e-12 of the centre distance, or of the sphere's radius.
    return at_least(name, lambda: min(gaps(), default=None), 0.0, 1e-12 * L)


def all_pass(rows: Iterable[Check]) -> bool:
    """Return True if no check fails; a check without a proof does not fail."""
    return all(check.passes is not False for check in rows)
