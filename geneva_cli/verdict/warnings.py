"""All warnings about a design: one list, which every command and format shows."""

from __future__ import annotations

from geneva_cli.analysis.loads.cycle import cycle_of
from geneva_cli.analysis.loads.summary import summaries
from geneva_cli.errors import Caution
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.wheel_inertia import known_wheel_body
from geneva_cli.verdict.carried_cautions import carried_cautions
from geneva_cli.verdict.cautions import cautions
from geneva_cli.verdict.cycle_cautions import cycle_cautions
from geneva_cli.verdict.load_cautions import load_cautions
from geneva_cli.verdict.strength import strength
from geneva_cli.verdict.turn_cautions import turn_cautions


def warnings(proof: Proof) -> list[Caution]:
    """Warnings about the motion, the loads and the parts of a machine, in this order."""
    mechanism = proof.mechanism
    of_strength = strength(mechanism).cautions()
    return [*cautions(mechanism), *under_load(mechanism), *of_strength, *turn_cautions(proof)]


def under_load(mechanism: Mechanism) -> list[Caution]:
    """Warnings about the loads of a machine, and about what it carries."""
    cycle = cycle_of(mechanism)
    return [
        *load_cautions(mechanism),
        *cycle_cautions(cycle, summaries(cycle)),
        *carried_cautions(mechanism, known_wheel_body(mechanism)),
    ]
