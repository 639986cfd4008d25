"""Designs under their loads: values of cycle, parts and roller for strength and life."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from typing import Any

import numpy as np

from geneva_cli.errors import GenevaError, marking
from geneva_cli.kept import cached_property
from geneva_cli.loads.strength import lock, pin_arm_key
from geneva_cli.loads.strength.horn import HornStress, Sides, Sizes, greatest_stress, horns
from geneva_cli.loads.strength.part_loads import PartLoads, part_loads, pin_forces_N, single_loads
from geneva_cli.loads.strength.pin_arm_key import PinSize
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.motion.batch import designs_in, taken
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import thing
from geneva_cli.numerics import arrays
from geneva_cli.numerics.arrays import Array, Number, Record, mapped, parameter
from geneva_cli.parts import sized_by_load
from geneva_cli.parts.assembly import is_bridged
from geneva_cli.parts.machine_sizes import fits, of_batch, sized, unloaded_alike
from geneva_cli.parts.outlines.cut_outlines import cut_lock
from geneva_cli.parts.shafts.bores import has_shape
from geneva_cli.parts.sized_by_load import Stressed
from geneva_cli.parts.sizes import Layout
from geneva_cli.verdict.quantities.groups import Designs, single


class UnderLoad:
    """The m designs of a machine under their loads: (m,) each, computed once."""

    def __init__(self, of: Designs) -> None:
        self.machine, self.designs = of.machine, of
        self.loaded = of.loaded
        # the function that returns the horns: those of a flat wheel for most kinds
        self.sides: Sides = thing(of.spec.wheel.NAME, "horns") or horns

    @cached_property
    def force_N(self) -> Array:
        """The greatest force on a roller, along the wall's normal."""
        return self.part_loads.pin_N * self.loaded

    @cached_property
    def _each(self) -> list[Layout | None]:
        """The parts of each design, or of all, without loads; None for one without flat parts."""
        spec = self.machine.spec
        if self.designs.are_built:
            return [*map(partial(sized, loaded=False), self.designs.each)]
        # designs that differ in speed and loads have the same
        is_one = self._moves_alike and designs_in((spec.size, spec.shaft)) == 1
        count = 1 if is_one else self.machine.designs
        return [sized(taken(self.machine, i), loaded=False) for i in range(count)]

    @cached_property
    def _moves_alike(self) -> bool:
        """True if the designs have one motion by the input's angle."""
        of = self.machine.spec
        with marking():  # the values of the designs are checked
            own = of.wheel, of.drive.replace(n_rpm=1.0), of.drive_before, of.motion
        return designs_in((own, self.machine.engagements)) == 1

    @property
    def _alike(self) -> bool:
        """True if designs that are not built yet move alike, and differ in plain sizes at most."""
        differ = self.designs.are_built or self._shaped or not self._moves_alike
        return not differ and self.machine.spec.is_flat

    @cached_property
    def _shaped(self) -> bool:
        """True if sizes differ, and a bore is not merely round."""
        size = self.machine.spec.size
        return (has_shape(size, "wheel") or has_shape(size, "crank")) and designs_in(size) > 1

    @cached_property
    def _unloaded(self) -> Layout | None:
        """The parts of the designs without loads, NaN for one without flat parts; None for none."""
        if not self.designs.single and self._alike:
            with suppress(GenevaError):
                return unloaded_alike(self.machine)
            return None
        of = next(filter(None, self._each), None)
        if of is None or len(self._each) == 1:
            return of
        sizes = batched([one and one[1] for one in self._each], as_numbers)
        assert sizes
        return of_batch(of[0], self.machine), sizes

    @cached_property
    def lock_sizes(self) -> tuple[float, Lock] | None:
        """Half the slot's width, and the lock in its narrowest sector, mm (m, 1)."""
        each = list[tuple[float, Lock] | None]()
        for of in self._each:
            locked = of and of[1].lock
            each.append((of[1].half_width, cut_lock(*of)) if of and locked else None)
        return batched(each, as_numbers) if len(each) > 1 else each[0]

    @cached_property
    def horn_sizes(self) -> Sizes | None:
        """Half the slot's width, the recess and more for a sphere, (m, 1); None without parts."""
        of_kind: Callable[[Mechanism], Sizes | None] | None
        of_kind = thing(self.machine.spec.wheel.NAME, "horn_sizes")
        if of_kind:
            return batched([of_kind(one) for one in self.designs.each], as_numbers)
        sizes = self._unloaded and self._unloaded[1]
        if sizes is None or not np.max(np.nan_to_num(sizes.lock)) > 0.0:
            return None
        return arrays.choose(sizes.lock > 0.0, sizes.half_width, np.nan), sizes.recess

    @property
    def has_horns(self) -> bool:
        """True if a design has horns: a locking disc and its recesses."""
        return self.horn_sizes is not None and bool(np.any(np.asarray(self.horn_sizes[1]) > 0.0))

    def horn_stress(self, width: float) -> HornStress:
        """The greatest stress in the horns under the roller, for a width of its contact."""
        if self.sides is horns:
            bent = self._flat_horns
            return bent._replace(stress_MPa=parameter(bent.stress_MPa / np.ravel(width)))
        assert self.horn_sizes
        wide = np.ravel(width).item() if self.designs.single else width  # to be hashed
        return greatest_stress(self.sides, self.machine, (*self.horn_sizes, wide))

    @cached_property
    def _flat_horns(self) -> HornStress:
        """The greatest stress in flat horns for 1 mm of contact, as the parts are sized."""
        assert self.horn_sizes
        return greatest_stress(horns, self.machine, self.horn_sizes)

    @cached_property
    def parts(self) -> Stressed | None:
        """The dimensions of stressed parts, (m,); None if no design has parts, or a load."""
        machine, size = self.machine, self.machine.spec.size
        if not machine.spec.is_loaded:
            return None
        of_kind = thing(machine.spec.wheel.NAME, "stressed") is not None
        is_own = self.designs.are_built or of_kind or bool(machine.first_wheel) or self._shaped
        of = None if is_own else self._unloaded
        # links, gears and a groove, which may be in the way of shafts
        if of and sized_by_load.planes_below(of[0].full) and not self._alike:
            every = [one[0].full for one in self._each if one]
            is_own = len({(sized_by_load.planes_below(one), is_bridged(one)) for one in every}) > 1
        if is_own or of is None:
            return batched([*map(_stressed, self.designs.each)]) if is_own else None
        locks, bent = self.lock_sizes if sized_by_load.needs_lock(machine.spec) else None, None
        if locks and size.wheel_thickness_mm is size.face_width_mm is None:
            bent = lock.horn_MPa(machine, *locks, self._flat_horns)
        sizes = sized_by_load.load_sizes(*of, locks and locks[1], machine, self.part_loads, bent)
        parts = sized_by_load.stressed(of[0], sizes, machine.spec)
        fit = np.where(np.ravel(fits(of[0], sizes)), np.ones(machine.designs), np.nan)
        return mapped(lambda row: np.ravel(row) * fit, parts)

    @property
    def contact_mm(self) -> float | None:
        """Length of the contact line, (m, 1): by default the thickness of the loaded wheel."""
        width = self.machine.spec.size.face_width_mm
        if width is not None or self.parts is None:
            return width
        return parameter(np.reshape(self.parts.contact, (-1, 1)))

    def pin_stresses(self, pin: PinSize) -> tuple[Number, Number, Number]:
        """Bending, shear and equivalent stress of a roller's pin, (m, 1), MPa."""
        force = pin_forces_N(self.machine, self.part_loads, pin) * self.loaded[:, None]
        return pin_arm_key.pin_stress_MPa(
            self.machine.spec.size, pin.contact_mm, pin.diameter_mm, force
        )

    @cached_property
    def pin(self) -> PinSize | None:
        """The roller's pin of the spec, or as its machine is drawn, (m, 1); None without a width.

        Its diameter and the length of its contact line.
        """
        size, width = self.machine.spec.size, self.contact_mm
        if width is None:
            return None
        usual = PinSize(pin_arm_key.pin_diameter_mm(self.machine), width)
        if size.pin_mm is not None or self.parts is None:
            return usual
        drawn = self.parts.pin
        diameter = np.where(np.isnan(drawn), np.ravel(usual.diameter_mm), drawn)[:, None]
        return PinSize(diameter, width)

    @cached_property
    def part_loads(self) -> PartLoads:
        """The greatest loads on arm, keys and shafts; NaN without a load."""
        if np.isnan(self.loaded).all():
            return PartLoads(*[math.nan] * len(PartLoads._fields))
        return single_loads(self.machine) if self.designs.single else part_loads(self.machine)


def _stressed(one: Mechanism) -> Stressed | None:
    """The dimensions of a machine's stressed parts; None without parts."""
    of_kind: Callable[[Mechanism], Stressed | None] | None
    of_kind = thing(one.spec.wheel.NAME, "stressed")
    if one.spec.no_parts:
        return None
    if of_kind is None:
        flat = sized(one)
        return flat and sized_by_load.stressed(*flat)
    with suppress(GenevaError):  # the check of the parts reports the error
        return of_kind(one)
    return None


def batched(
    records: Sequence[Record | None], column: Callable[[Array], object] = np.asarray
) -> Record | None:
    """The records of m designs as one; None if no design has one.

    Each number of it is ``column`` of the (m,) numbers of the designs, NaN for those without.
    """
    like = next(filter(None, records), None)
    if like is None:
        return None
    fields = list[object]()
    for k, field in enumerate(like):
        each: list[Any] = [one and one[k] for one in records]
        # None is NaN
        own = batched(each, column) if isinstance(field, tuple) else column(np.array(each, float))
        fields.append(own)
    return arrays.record_of(like, fields)


def as_numbers(values: Array) -> float:
    """Numbers (m,) as those of a machine: (m, 1), or one number."""
    return parameter(values[:, None]) if len(values) > 1 else values.item()


def share(batch: Mechanism, machines: Sequence[Mechanism]) -> None:
    """Let the machines of a batch's designs take from it what their checks and parts need."""
    designs = Designs(batch, None, machines)

    def loads_of(i: int) -> PartLoads | None:
        with suppress(GenevaError):  # which one of the designs raises again
            return designs.once(UnderLoad).part_loads.of(i)
        return None

    for i, machine in enumerate(machines):
        single.put(machine, partial(Designs, machine, batch=(designs, i)))
        single_loads.put(machine, partial(loads_of, i))
