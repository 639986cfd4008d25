"""Designs under their loads: values of cycle, parts and roller for strength and life."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads.cycle import cycle_of
from geneva_cli.loads.cycle_quantities import FORCE, PV
from geneva_cli.loads.impacts.impacts import Impacts, reversal_impacts
from geneva_cli.loads.impacts.shock_force import forces_N
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.loads.strength import lock, shaft_stress
from geneva_cli.loads.strength import pin as pins
from geneva_cli.loads.strength.pin import PinSize
from geneva_cli.motion.records import thing
from geneva_cli.numerics.arrays import Array, Number, library, parameter
from geneva_cli.parts.outlines.outline_sizes import Layout, sized
from geneva_cli.spec.materials import roller_material
from geneva_cli.verdict.part_sizes import (
    LockSizes,
    batched,
    design_lock_sizes,
    layouts_lock_sizes,
    stressed_parts,
)
from geneva_cli.verdict.quantities.horns import Horns

if TYPE_CHECKING:
    from geneva_cli.loads.strength.lock import LockUnderTorque
    from geneva_cli.loads.strength.part_loads import PartLoads
    from geneva_cli.parts.sizes.stressed import Stressed
    from geneva_cli.verdict.quantities.batch_designs import Designs


class UnderLoad:
    """The m designs of a machine under their loads: (m,) each, computed once."""

    def __init__(self, of: Designs) -> None:
        self.machine, self.designs = of.machine, of
        self.loaded = of.loaded

    @cached_property
    def force_N(self) -> Array:
        """The greatest force on a roller, along the wall's normal."""
        if self.designs.single and not np.isnan(self.loaded[0]):
            return np.array([self.part_loads.pin_N])  # its cached loads have it
        return self._peak(FORCE)

    @cached_property
    def roller_N(self) -> Array:
        """The greatest force on a roller, with its friction along the wall; (m, 1)."""
        return self.force_N[:, None] * self.rubbed

    @property
    def rubbed(self) -> float:
        """The force on a roller over that along the wall's normal, (m, 1)."""
        friction = self.designs.load_case.friction
        return parameter(library(friction).hypot(1.0, friction))

    @cached_property
    def pv_W_m2(self) -> Array:
        """The greatest contact pressure times sliding speed; it needs a face width."""
        if self.designs.single and not np.isnan(self.loaded[0]):
            return np.array([cycle_of(self.machine).extremes[PV].max])
        return self._peak(PV)

    def _peak(self, name: str) -> Array:
        """The greatest size of a load; NaN without a load."""
        if np.isnan(self.loaded).all():
            return self.loaded
        return load_peaks(self.machine, [name])[name].max * self.loaded

    @cached_property
    def lock_sizes(self) -> LockSizes | None:
        """The sizes of horn and lock, (m, 1); None if no design has a lock."""
        if self.designs.are_built:
            return layouts_lock_sizes(self.layouts)
        return design_lock_sizes(self.machine)

    @cached_property
    def horns(self) -> Horns | None:
        """The horns of the designs; None where no part is cut."""
        of_kind: Callable[[Designs], Horns | None] | None
        of_kind = thing(self.machine.spec.wheel.NAME, "horns")
        if of_kind:
            return of_kind(self.designs)
        sizes = self.lock_sizes
        return Horns(self.designs, (sizes.half_width, sizes.lock.recess)) if sizes else None

    @property
    def has_horns(self) -> bool:
        """True if a design has horns: a locking disc and its recesses."""
        return bool(self.horns and self.horns.exist)

    @cached_property
    def layouts(self) -> Sequence[Layout | None]:
        """Assembly and sizes of each design; None for one without flat parts."""
        each = self.designs.each
        if self.designs.are_built or not self.machine.spec.is_loaded:
            return [sized(one) for one in each]
        return [sized(one, self.sizing_loads.of(i)) for i, one in enumerate(each)]

    @cached_property
    def sizing_loads(self) -> PartLoads:
        """The loads for which the parts are sized: the greatest of all directions."""
        from geneva_cli.loads.strength.part_loads import sizing_loads

        return sizing_loads(self.machine, self.part_loads)

    @cached_property
    def lock(self) -> LockUnderTorque | None:
        """The lock under the torque that it holds in the dwell; None if no design has one."""
        sizes, width = self.lock_sizes, self.contact_mm
        if sizes is None or width is None:
            return None
        return lock.loaded_locks(self.machine, sizes.half_width, sizes.lock, width)

    @cached_property
    def parts(self) -> Stressed | None:
        """The dimensions of stressed parts, (m,); None if no design has parts, or a load."""
        if not self.machine.spec.is_loaded:
            return None
        each = zip(self.designs.each, self.layouts, strict=True)
        return batched([stressed_parts(*one) for one in each])

    @property
    def contact_mm(self) -> float | None:
        """Length of the contact line, (m, 1): by default the thickness of the loaded wheel."""
        width = self.machine.spec.size.face_width_mm
        if width is not None or self.parts is None:
            return width
        return parameter(np.reshape(self.parts.contact, (-1, 1)))

    @cached_property
    def reversals(self) -> Impacts:
        """The impacts at a change of sides, without their forces."""
        return reversal_impacts(self.machine)

    def pin_N(self, pin: PinSize) -> Array:
        """The greatest force on a roller, with its friction, in the cycle or by an impact; (m, 1).

        A pin of another size is struck by another force.
        """
        jump = self.reversals.jump[:, None]
        if np.isnan(jump).all():
            return self.roller_N
        struck = forces_N(self.machine, jump, pin)[:, None]
        return np.maximum(self.roller_N, np.nan_to_num(struck * self.rubbed))

    @cached_property
    def pin_mm(self) -> Number:
        """The diameter of the roller's pin, (m, 1): of the spec, or as its machine is drawn."""
        size, width = self.machine.spec.size, self.contact_mm
        usual = pins.pin_diameter_mm(self.machine)
        if size.pin_mm is not None or width is None:
            return usual
        force = self.pin_N(PinSize(usual, width))
        stress = pins.pin(size, width, usual).under(force).equivalent
        # where the usual pin holds, it is drawn
        holds = ~(stress > roller_material(self.machine.spec).allowed_MPa)
        parts = None if np.all(holds) else self.parts
        if parts is None:
            return usual
        return np.where(np.isnan(parts.pin), np.ravel(usual), parts.pin)[:, None]

    @cached_property
    def part_loads(self) -> PartLoads:
        """The greatest loads on arm, keys and shafts."""
        from geneva_cli.loads.strength.part_loads import own_loads, part_loads

        return (own_loads if self.designs.single else part_loads)(self.machine)

    @cached_property
    def held(self) -> shaft_stress.Held | None:
        """What the lock holds in the dwell; None without a torque there."""
        torque = lock.dwell_torque_Nm(self.machine)
        if not torque.any():
            return None
        sizes = self.lock_sizes  # without a disc something else holds the wheel, by a couple
        force = lock.held_force_N(torque[:, None], sizes.lock) if sizes else 0.0 * torque
        return shaft_stress.Held(np.nan_to_num(np.ravel(force)), torque)


def under_load(of: Designs) -> UnderLoad:
    """The designs under their loads."""
    return of.once(UnderLoad)


def drawn_pin(of: Designs) -> PinSize | None:
    """The pin that an impact bends, and its contact; None where nothing has a width."""
    width = under_load(of).contact_mm
    return None if width is None else PinSize(under_load(of).pin_mm, width)
