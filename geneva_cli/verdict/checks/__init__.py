"""The checks of a design, each with its value and its limit."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.spec.load_named import load_extra
from geneva_cli.verdict.checks.all_checks import (
    BEFORE_TURN,
    LIMITS,
    MOTION,
    OF_TURN,
    PLAYS,
    PROOFS,
    PUSHED,
    TURNING,
    applicable,
    check_named,
    standing,
    without_reasons,
)
from geneva_cli.verdict.checks.check import Check as Check
from geneva_cli.verdict.checks.check import all_pass as all_pass
from geneva_cli.verdict.checks.check import refused

if TYPE_CHECKING:
    from geneva_cli.parts.parts import Parts
    from geneva_cli.verdict.quantities.batch_designs import Values


def checks(
    mechanism: Mechanism, machine: Parts | None = None, parts: bool = True, turned: bool = True
) -> list[Check]:
    """Every check of one design: its motion, its parts unless left out, its own ``[limits]``.

    Without ``turned`` those of the whole turn are left out, which take the longest.
    """
    shown = of_parts(mechanism, machine, turned) if parts else ()
    return [*applicable(MOTION, mechanism), *shown, *applicable(LIMITS, mechanism)]


def quick_first(
    mechanism: Mechanism, machine: Parts | None = None, parts: bool = True
) -> Iterator[Check]:
    """The same checks in the order of their cost, for those who stop at one that fails.

    Those of loads have no reason in words, which may take longer than the check.
    """
    yield from without_reasons(MOTION, mechanism)
    yield from without_reasons(LIMITS, mechanism)
    if parts:
        yield from of_parts(mechanism, machine)


def single_check(mechanism: Mechanism, name: str, machine: Parts | None = None) -> Check | None:
    """The check with this name, without the others; None if there is no such check.

    Raises GenevaError if its parts cannot be built, or turned if it is of the turn.
    """
    check = check_named(MOTION, name, mechanism) or check_named(LIMITS, name, mechanism)
    if check or name in (*MOTION, *LIMITS) or not mechanism.spec.is_turned:
        return check
    if name in PUSHED:
        pushed = pushed_round(mechanism) if mechanism.no_turn else []
        return next((one for one in pushed if one.name == name), None)
    from geneva_cli.parts.parts import parts_of

    machine = machine or parts_of(mechanism)
    if name in OF_TURN:
        return check_named(TURNING, name, machine, machine.turned.turn)
    if name == "parts":
        _ = machine.turned
    return (
        check_named(standing(mechanism), name, machine.built) if mechanism.spec.has_parts else None
    )


def of_parts(
    mechanism: Mechanism, machine: Parts | None = None, turned: bool = True
) -> Iterator[Check]:
    """Walls, shafts and, if ``turned``, the full turn of a machine whose parts are drawn.

    If wheel or crank cannot be built, or turned, a single check says so instead. A rack can be
    turned although some of its machine's parts are not built.
    """
    spec, none = mechanism.spec, list[Check]()
    if not spec.has_parts:
        none = [Check("parts", None, "proved", None, None, spec.no_parts)]
    if not spec.is_turned:
        yield from none
        for name in PLAYS:
            if (limit := spec.limits.as_dict()[name]) is not None:
                why = "not computed, because the parts of this machine are not turned"
                yield Check(name, None, "at most", limit, None, why)
        return
    from geneva_cli.parts.parts import parts_of
    from geneva_cli.parts.turn.turned_parts import WorkLimit

    machine = machine or parts_of(mechanism)
    try:
        rows = none or list(applicable(standing(mechanism), machine.built))
        _ = machine.turned
    except GenevaError as error:
        yield refused("parts", error)
        return
    yield from rows
    if turned and mechanism.no_turn:
        yield from pushed_round(mechanism)
    elif turned:
        try:
            turn = machine.turn
        except WorkLimit as error:
            yield refused("full_turn", error)
            return
        yield from applicable(TURNING, machine, turn)


def pushed_round(mechanism: Mechanism) -> list[Check]:
    """Whether parts turn that do not follow the formulas, and how hard they are struck.

    Without that extra, or where it cannot turn them, there is no verdict.
    """
    try:
        rows: list[Check] = load_extra("outline", "as_built")(mechanism)
    except GenevaError:
        return [Check("full_turn", None, "proved", None, None, mechanism.no_turn)]
    return rows


def proofs(parts: Parts, to_mm: float | None = None) -> list[Check]:
    """The proof that no parts collide in a whole turn; none if they cannot be made or turned.

    ``to_mm`` is the tolerance of the proof, by default ``certificate.tolerance_mm``.
    """
    if not parts.mechanism.spec.is_turned or parts.mechanism.no_turn:
        return []
    try:
        return list(applicable(PROOFS, parts, to_mm))
    except GenevaError:
        return []  # the checks of the parts report the error


# Quantities of a study: values of checks by their names.


def values_before_turn(parts: Parts) -> Values:
    """The value of each check but those of the turn."""
    rows = checks(parts.mechanism, parts, turned=False)
    return {c.name: c.value for c in rows if c.name in BEFORE_TURN}


def check_values(parts: Parts) -> Values:
    """The value of each check of the turn, and whether all checks pass."""
    rows = checks(parts.mechanism, parts)
    failed = [c.name for c in rows if c.passes is False]
    values: Values = {c.name: c.value for c in rows if c.name in OF_TURN}
    return values | {"passes": not failed, "failed": " ".join(failed) or None}


def passed(parts: Parts) -> Values:
    """Whether no check fails, computed until the first that does."""
    return {"passes": all_pass(quick_first(parts.mechanism, parts))}


def proved(parts: Parts) -> Values:
    """The gap that is proved."""
    return {c.name: c.value for c in proofs(parts)}
