"""The load on its elastic shaft: what an index leaves swinging, and the speeds to avoid."""

from __future__ import annotations

from geneva_cli.analysis.vibration.answers import NUMBERS, values
from geneva_cli.analysis.vibration.oscillator import oscillator
from geneva_cli.parts.proof import Proof
from geneva_cli.verdict.report.values import Values


def vibration(proof: Proof) -> Values:
    """None without a stiffness; bands, stations and warnings are ``geneva vibration``'s."""
    mechanism = proof.mechanism
    stiff = mechanism.spec.shaft.stiffness_Nm_rad is not None
    found = values(mechanism, oscillator(mechanism) if stiff else None)
    return {f"vibration.{name}": found[name] if stiff else None for name in NUMBERS}
