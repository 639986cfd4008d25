"""Sections of a report that a batch does not compute, and the words above it."""

import math
from contextlib import suppress

from geneva_cli.errors import GenevaError
from geneva_cli.loads.cycle import cycle_of
from geneva_cli.loads.load_peaks import greatest_pressure
from geneva_cli.loads.load_tables import reversals_deg
from geneva_cli.motion.timing import timings
from geneva_cli.parts.parts import Parts
from geneva_cli.table import Reading, rows_table
from geneva_cli.verdict.checks.load_checks import BOUNDS
from geneva_cli.verdict.quantities.groups import GROUP_OF, Numbers, Values, only, single
from geneva_cli.verdict.quantities.motion_quantities import peaks_among, shared_timing
from geneva_cli.verdict.strength import OF_LIFE, strength

SAMPLES = 65536  # random machines, as ``geneva tolerance`` draws by default


def machine(parts: Parts) -> Values:
    """The kind of machine."""
    spec = parts.mechanism.spec
    return {
        "wheel.z": spec.wheel.z,
        "wheel.gearing": spec.wheel.NAME,
        "drive.kind": spec.drive.NAME,
        "drive.rollers": spec.drive.rollers,
        "drive.before.kind": spec.drive_before.NAME if spec.drive_before else None,
        "motion.law": spec.motion.law.NAME if spec.motion else None,
    }


def inputs(parts: Parts) -> Values:
    """The values of the keys that the numbers of a report depend on."""
    spec = parts.mechanism.spec
    known = {"size": spec.size.allowances._asdict()}  # if a key is left out
    values: Values = {}
    for name in GROUP_OF["inputs.drive.n_rpm"].own:
        table, _, key = name.rpartition(".")
        values[name] = (spec.table(table) | known.get(table, {}))[key]
    return values


def stations(parts: Parts) -> Values:
    """A row for each engagement, if they differ: its timing and peaks."""
    mechanism, each = parts.mechanism, list[Numbers]()
    if len(mechanism.engagements) == 1:
        return {"stations": None}
    names = GROUP_OF["velocity.max"].names
    of = single(mechanism).requesting(names)
    for timing, engagement in zip(timings(mechanism), mechanism.engagements, strict=True):
        row = {f"timing.{name}": only(own) for name, own in shared_timing([timing]).items()}
        own = peaks_among(of, [engagement])
        each.append(row | {name: only(own.get(name)) for name in names})
    return {"stations": rows_table(tuple(each[0]), [tuple(e.values()) for e in each])}


def wheels(parts: Parts) -> Values:
    """A row for each of several wheels: where it stands, and when it moves."""
    mechanism = parts.mechanism
    places = mechanism.wheel_places
    if len(places) < 2:
        return {"wheels": None}
    (one,) = mechanism.engagements  # one finger, which all wheels meet alike
    names = ("wheel", "behind_deg", "entry_deg", "exit_deg", "entry_s")
    rows = []
    for place in places:
        behind = place.behind_deg
        after_s = behind / (6.0 * mechanism.spec.drive.n_rpm)  # n rpm is 6 n degrees a second
        rows.append((place.number, behind, behind + one.entry_deg, behind + one.exit_deg, after_s))
    return {"wheels": rows_table(names, rows)}


def cranks(parts: Parts) -> Values:
    """A row for each of several cranks; None for a single one.

    Input angles are from the middle of the first crank's motion. Slots count counterclockwise from
    that which the first crank then enters. In step n a crank enters slot k - n from place k.
    """
    mechanism = parts.mechanism
    places = mechanism.crank_places
    if len(places) < 2:
        return {"cranks": None}
    spec = mechanism.spec
    each = mechanism.engagements  # one of each crank, if they differ
    every = math.gcd(len(places), spec.wheel.z)
    names = ("crank", "place_deg", "behind_deg", "entry_deg", "exit_deg", "entry_s", "slot")
    rows = []
    for k, (place, step) in enumerate(zip(places, spec.drive.cranks, strict=True)):
        number, i = divmod(k, len(each))
        one = each[i]
        behind = number * mechanism.period_deg + one.mid_deg - each[0].mid_deg
        ends = behind + one.entry_deg, behind + one.exit_deg
        # n rpm is 6 n degrees a second
        after_s = (ends[0] - each[0].entry_deg) / (6.0 * spec.drive.n_rpm)
        after_s += k * spec.drive.stop_s
        slot = (int(step) - place.number + 1) % every
        place_deg = 360.0 * step / spec.wheel.z
        rows.append((place.number, place_deg, behind, *ends, after_s, slot, every))
    return {"cranks": rows_table((*names, "slot_every"), rows)}


def reversals(parts: Parts) -> Values:
    """Where the wheel's torque changes its sign, input degrees; None without a load."""
    of = cycle_of(parts.mechanism)
    return {"reversals_deg": tuple(reversals_deg(of)) if of.is_loaded else None}


def needs(parts: Parts) -> Values:
    """The keys that unknown values of strength and life need: a line for each set of keys."""
    return {"needs": tuple(strength(parts.mechanism).missing((*BOUNDS, *OF_LIFE)))}


def slot(parts: Parts) -> Values:
    """Whether a wall pushes throughout, which may be cut away; None for straight slots."""
    from geneva_cli.loads.positive_drive import positive_drives

    drive = positive_drives(parts.mechanism)
    return {"positively_driven": not drive.loose_deg if drive else None}


def vibration(parts: Parts) -> Values:
    """The load on its elastic shaft: what an index leaves swinging, and the speeds to avoid."""
    mechanism = parts.mechanism
    none: Values = {"speeds_to_avoid_rpm": None}
    if mechanism.spec.shaft.stiffness_Nm_rad is None:
        return none
    # only for elastic shafts: the modules of vibration take a twentieth of a short report
    from geneva_cli.loads.vibration.vibration import oscillator, values

    try:
        results = values(mechanism, oscillator(mechanism))
    except GenevaError as error:
        return none | {"none": str(error)}
    names = ("speeds_to_avoid_rpm", *GROUP_OF["vibration.none"].own)
    return {name: results[name] for name in results if name in names}


def tolerances(parts: Parts) -> Values:
    """The first lines of ``geneva tolerance``, and its warnings; None without tolerances."""
    mechanism = parts.mechanism
    if not mechanism.spec.tolerance.is_given:
        return {"warnings": None}
    from geneva_cli.verdict.tolerance import tolerance_table

    # micrometres need a radius
    L = mechanism.center_distance_mm
    answers = tolerance_table(mechanism, parts, SAMPLES, 0, L).to_dict()
    names = GROUP_OF["tolerance.entry_jump.mean"].own
    return {name: answers[name] for name in (*names, "warnings")}


def sizes(parts: Parts) -> Values:
    """Sizes of a flat wheel as cut, or of a spherical wheel as turned."""
    mechanism, spec = parts.mechanism, parts.mechanism.spec
    L, r, first = mechanism.center_distance_mm, mechanism.roller_radius_mm, mechanism.engagements[0]
    values: Values = {"roller_radius_mm": r, "rollers_max": mechanism.rollers_max}
    values["clearances_from"] = spec.size.allowances.source
    if not mechanism.axes:  # the slot is a meridian between two polar angles
        mouth, bottom = (first.slot(x, 0)[0].c[0] for x in (first.entry_deg, 0.0))
        values |= spec.wheel.own_sizes
        values |= {"sphere_radius_mm": L, "crank_arm_mm": mechanism.ratio * L}
        values["slot_mouth_polar_deg"] = math.degrees(mouth)
        values["slot_bottom_polar_deg"] = math.degrees(bottom)
        return values
    values |= {"center_distance_mm": L, "crank_radius_mm": mechanism.ratio * L}
    values["ratio"] = mechanism.ratio
    values["slot_width_mm"] = 2.0 * (r + spec.size.allowances.slot_clearance_mm)
    if first.slot.curved:
        values["pressure_angle_max_deg"] = greatest_pressure(mechanism).max.item()
    if spec.is_flat:
        from geneva_cli.parts.assembly import assembly
        from geneva_cli.parts.machine_sizes import machine_sizes
        from geneva_cli.parts.slots.roller_paths import roller_paths

        where, inside = assembly(mechanism), spec.wheel.SIGN < 0.0
        ends, _, _ = roller_paths(where)
        mouth = max(where.L * float(one.reach(one.entry_deg)) for one in where.kinds)
        values["slot_mouth_radius_mm"] = mouth
        values["slot_bottom_radius_mm"] = max(ends) if inside else min(ends)
        with suppress(GenevaError):  # ``parts.none`` gives the reason
            rim = machine_sizes(mechanism)[1].rim
            values["rim_radius_mm" if inside else "wheel_radius_mm"] = rim
    return values


def parts(of: Parts) -> Values:
    """Sizes of the parts, or the reason in ``none`` why there are none."""
    spec = of.mechanism.spec
    if spec.no_parts:
        return {}
    try:
        values: Values = {"horn_mm": of.built.horn_mm}
        if not spec.is_flat:
            return values
        outlines = of.outlines
    except GenevaError as error:
        return {"none": str(error)}
    size, locked = outlines.sizes, bool(outlines.crank)
    return values | {
        "rim_radius_mm": size.rim,
        "slot_end_radius_mm": size.slot_end,
        "lock_radius_mm": size.lock,
        "recess_radius_mm": size.recess if locked else None,
        "relief": outlines.relief if locked else None,
        "wheel_bore_mm": 2.0 * size.wheel_bore,
        "crank_bore_mm": 2.0 * size.crank_bore,
    }


def turned(parts: Parts) -> Values:
    """Results of the parts' whole turn, or the reason in ``none`` why there is no turn."""
    if not parts.mechanism.spec.is_turned:
        return {}
    if parts.mechanism.no_turn:
        return {"none": parts.mechanism.no_turn}
    try:
        turn, output = parts.built.turn, parts.mechanism.output
    except GenevaError as error:
        return {"none": str(error)}
    gap = turn.smallest
    values: Values = {"smallest_gap_mm": gap.mm if abs(gap.mm) > parts.contact else 0.0}
    if parts.locked:  # the lock's play, in the unit of what the machine gives out
        values[f"dwell_play_{output.unit}"] = output.from_deg(turn.dwell.deg)
    return values | {"smallest_gap_at_deg": gap.at_deg}


def parts_list_tables(parts: Parts) -> Values:
    """The three tables; None for one without rows, such as the pivots of a spherical wheel."""
    from geneva_cli.drawings.parts_list import FIRST, KINDS, parts_list

    rows = parts_list(parts).to_rows()
    values: Values = {}
    for kind, names in KINDS.items():
        own = [[row[name] for name in names] for row in rows if row["row"] == kind]
        table = rows_table(names, own, mixed=True).replaced(reading=Reading(FIRST))
        values[kind] = table if own else None
    return values
