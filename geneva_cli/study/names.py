"""Short names of designs that are shown side by side, and the usual names of quantities."""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence


def short_name(path: str, paths: Sequence[str], taken: Collection[str] = ()) -> str:
    """A file's name without folder and ending, where that tells it from the others.

    >>> short_name("a/slow.toml", ["a/slow.toml", "b/quick.toml"])
    'slow'
    """
    stems = [os.path.splitext(os.path.basename(p))[0] for p in paths]
    stem = stems[list(paths).index(path)]
    return stem if stems.count(stem) == 1 and stem not in taken else path


def usual_fields() -> list[str]:
    """The names of the quantities of a loaded wheel with straight slots, as ``velocity.max``.

    They are used where there is no design yet, as in a shell's completion.
    """
    from geneva_cli.machine.mechanism import build
    from geneva_cli.machine.spec import Spec
    from geneva_cli.machine.wheels.external import External
    from geneva_cli.parts.proof import Proof
    from geneva_cli.spec.tables import Load, Size
    from geneva_cli.study.fields import ALL, values

    load = Load(inertia_kgm2=1.0, torque_Nm=1.0)
    machine = build(Spec(External(6), size=Size(face_width_mm=10.0), load=load))
    return list(values(Proof(machine), (s for s in ALL if not s.makes_parts)))
