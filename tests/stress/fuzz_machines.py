"""Random machines for the fuzzers, as TOML."""

import math

from geneva_cli.motion.machine_spec import LOADED
from geneva_cli.motion.registry import DRIVES, LAWS, drive
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Size

LOADS = {"inertia_kgm2": 0.05, "torque_Nm": 3.0, "dwell_torque_Nm": 3.0, "friction": 0.1}
BEARS = {"dynamic_capacity_N": 5e3, "stress_max_MPa": 150.0}  # of [material.roller]
LIMITS = {
    "velocity_max": 2.0, "acceleration_max": 4.0, "acceleration_entry_max": 1.0, "jerk_max": 30.0,
    "pin_force_max_N": 100.0, "input_torque_max_Nm": 5.0, "pressure_angle_max_deg": 25.0,
    "contact_stress_max_MPa": 300.0, "pv_max_W_m2": 1e8, "roller_life_min_h": 2e4,
    "lock_stress_max_MPa": 800.0, "lock_deflection_max_deg": 0.05,
    "product_acceleration_max_m_s2": 10.0,
    "entry_velocity_max": 0.02, "dwell_min_s": 0.3, "motion_max_s": 0.5, "cycle_max_s": 1.0,
    "index_play_max_deg": 0.1, "dwell_play_max_deg": 0.1,
}  # fmt: skip
WHEELS_ONLY = (
    *("dwell_torque_Nm", "product_acceleration_max_m_s2", "dwell_position_max_deg"),
    *("index_play_max_deg", "dwell_play_max_deg"),
)
PRODUCT = {"radius_mm": 300.0, "friction": 0.5}


def in_range(rng, rule, whole):
    """A number that the rule allows, often at its very ends."""
    low = rule.low if math.isfinite(rule.low) else -1e300
    high = rule.high if math.isfinite(rule.high) else 1e300
    if whole:
        low, high = int(low), int(high)
        return rng.choice([low, high, min(high, low + rng.randrange(30)), rng.randint(low, high)])
    inside_low = (math.nextafter(low, math.inf) if low else 1e-300) if rule.ends[0] == "(" else low
    inside_high = math.nextafter(high, -math.inf) if rule.ends[1] == ")" else high
    nearly = low + (high - low) * 10.0 ** -rng.uniform(0, 15)
    usual = max(inside_low, min(inside_high, 10.0 ** rng.uniform(-3, 3)))
    uniform = low + (high - low) * rng.random()
    value = rng.choice([inside_low, inside_high, 0.0, nearly, usual, usual, usual, uniform])
    return min(max(value, inside_low), inside_high)


# Drives of an external wheel alone, with one roller; a linkage's centre distance is its own.
LINKAGES = ("four-bar", "slider-crank")
ONE_WAY = ("gear-sector", "geneva-pair", "epicyclic", *LINKAGES)


WORDED = {
    "relief": ("arc", "sector"),
    "process": ("laser", "mill", "print"),
    "pin_held": ("cantilever", "supported", "fixed"),
    "crank_keyway": ("DIN 6885-1",),
    "wheel_keyway": ("DIN 6885-1",),
    "crank_bore": ("round", "D", "hex"),
    "wheel_bore": ("round", "D", "hex"),
}
TAKEN = (
    "center_distance_mm",
    "crank_radius_mm",
    "roller_radius_mm",
    "face_width_mm",
)  # keys of [size] set apart


def near(rng, value, spread=0.3):
    """A value about the one given, rounded as a person would."""
    return float(f"{value * math.exp(rng.gauss(0.0, spread)):.{rng.choice([2, 3, 17])}g}")


def clearance(rng, r):
    """Mostly none or little; now and then as much as the roller."""
    return rng.choice([0.0, 0.0, 0.01, 0.1, near(rng, 0.02 * r), r * rng.random()])


# Usual sizes over the centre distance, the crank's radius or, for all others, the roller's.
OVER_L = {
    **dict.fromkeys(("wheel_bore_mm", "crank_shaft_high_mm", "wheel_shaft_high_mm"), 0.2),
    **dict.fromkeys(("wheel_hub_length_mm", "crank_hub_length_mm"), 0.2),
    **dict.fromkeys(("crank_shaft_low_mm", "wheel_shaft_low_mm"), -0.4),
    **dict.fromkeys(("relief_clearance_mm", "wall_min_mm"), 0.005),
    **dict.fromkeys(("lock_bolt_mm", "dial_bolt_mm", "gear_bolt_mm"), 0.025),
    **dict.fromkeys(("lock_thickness_mm", "arm_thickness_mm"), 0.1),
    **{"wheel_hub_mm": 0.3, "link_thickness_mm": 0.05, "wheel_thickness_mm": 0.25},
    **{"gear_bolt_circle_mm": 0.8, "dial_bolt_circle_mm": 0.5, "wheel_flat_mm": 0.02},
}
OVER_R = {"crank_bore_mm": 0.3, "crank_hub_mm": 0.5, "arm_bore_mm": 0.2, "arm_hub_mm": 0.4}
OVER_R |= {"lock_bolt_circle_mm": 1.0, "crank_flat_mm": 0.02}
OVER_r = {"horn_tip_mm": 0.2, "press_fit_mm": 0.01, "shaft_fit_mm": 0.02, "arm_eye_mm": 2.0}
OVER_r |= {"pin_mm": 1.0, "link_pin_mm": 1.0, "link_width_mm": 3.0, "link_bore_mm": 1.0}
OVER_r |= dict.fromkeys(("mouth_radius_mm", "pin_gap_mm", "washer_mm"), 0.1)


def usual(rng, key, L, R, r, outside):
    """A likely value of a key of ``[size]``, for a centre distance and a crank's radius."""
    if key in ("slot_clearance_mm", "lock_clearance_mm"):
        return clearance(rng, r)
    if key in WORDED:
        return rng.choice(WORDED[key])
    if key in ("lock_bolts", "dial_bolts", "gear_bolts"):
        return rng.choice([0, 1, 2, 3])
    lock = rng.choice([0.0, 0.8 * R, R - r, R])
    of = {
        "wheel_radius_mm": math.sqrt(L * L - R * R if outside and R < L else L * L + R * R),
        "wheel_outer_radius_mm": L + R + 2.0 * r,
        "lock_radius_mm": lock,
        **{name: part * L for name, part in OVER_L.items()},
        **{name: part * R for name, part in OVER_R.items()},
    }
    return near(rng, of.get(key, OVER_r.get(key, 0.05) * r))


def wheel(rng, kind):
    """z, the gearing, and the lines of ``[wheel]``."""
    z = rng.choice([3, 4, 5, 6, 7, 8, 10, 12, 16, 20, 24, rng.randint(3, 100)])
    if kind in ("gear-sector", "geneva-pair"):  # which need coarse steps
        z = rng.choice([3, 4, 5, 6, 8])
    spherical = kind in ("crank", "side-crank") and rng.random() < 0.04
    inside = kind not in ONE_WAY and rng.random() < 0.3
    gearing = "spherical" if spherical else "internal" if inside else "external"
    lines = [f"z = {z}"] + ([f'gearing = "{gearing}"'] if gearing != "external" else [])
    if spherical and rng.random() < 0.5:
        lines.append(f"axes_deg = {near(rng, 90.0)!r}")
    if kind == "crank" and gearing == "external" and rng.random() < 0.2:
        length = rng.choice([n for n in (1, 2, 3, 4, z) if z % n == 0])
        steps = [360.0 / z * (1.0 + rng.choice([0.1, 0.4, 0.9]) * rng.uniform(-1, 1))
                 for _ in range(length - 1)]  # fmt: skip
        steps = [float(f"{s:.{rng.choice([2, 4, 17])}g}") for s in steps]
        lines.append(f"steps_deg = {[*steps, 360.0 * length / z - sum(steps)]!r}")
    return z, gearing, lines


def linkage(rng, kind):
    """A four-bar or a slider-crank near one that drives a wheel."""
    of = {
        "four-bar": rng.choice([
            (40, 90, 100, 100, 161.519, -36.138), (35, 90, 80, 95, 120, 25),
            (20, 100, 100, 60, 30, 100)]),
        "slider-crank": (40, 100, 80, 90),
    }[kind]  # fmt: skip
    names = {
        "four-bar": ("crank", "ground", "coupler", "rocker", "point"),
        "slider-crank": ("crank", "rod", "point"),
    }[kind]
    spread = rng.choice([0.0, 0.01, 0.1])
    lines = [f"{n}_mm = {near(rng, v, spread)!r}" for n, v in zip(names, of, strict=False)]
    lines.append(f"point_deg = {of[-1] + rng.choice([0.0, rng.gauss(0.0, 20.0)])!r}")
    if kind == "slider-crank" and rng.random() < 0.4:
        lines.append(f"height_mm = {rng.gauss(0.0, 10.0)!r}")
    if kind == "four-bar" and rng.random() < 0.2:
        lines.append('branch = "-"')
    if rng.random() < 0.3:
        lines.append(f"entry_deg = {rng.choice([123.3, rng.uniform(-180, 180)])!r}")
    return lines


def own_keys(rng, kind):
    """The lines of the keys that a kind adds to ``[drive]``."""
    part = rng.choice([rng.random(), rng.random(), 1.0 - 10.0 ** -rng.uniform(1, 12)])
    if kind in LINKAGES:
        return linkage(rng, kind)
    if kind == "side-crank":
        return [f"A = {rng.choice([-1, 1]) * part!r}", *length(rng, "input_crank_mm")]
    if kind == "elliptical-gears":
        phase = f'phase = "{rng.choice(["slow", "quick"])}"'
        return [f"eccentricity = {part!r}", phase, *length(rng, "gear_distance_mm")]
    if kind == "epicyclic":
        ratio = rng.choice(['"shockless"', repr(rng.gauss(0.0, 0.04))])
        return [f"planet_ratio = {ratio}", f'fixed = "{rng.choice(["sun", "ring"])}"']
    if kind == "noncircular-gears":
        return [f"A = {rng.uniform(-0.95, 0.95)!r}", f"gear_distance_mm = {near(rng, 100.0)!r}"]
    if kind == "gear-sector":
        return [f"sector_deg = {rng.uniform(1, 200)!r}"]
    if kind == "carousel":
        return [f"wheels = {rng.choice([1, 1, 2, 3, 5])}"]
    if kind == "geneva-pair":
        return [f"first_z = {rng.choice([3, 3, 4, 5])}", *length(rng, "first_distance_mm")]
    return []


def length(rng, key):
    """A length that a drive may go without."""
    return [f"{key} = {near(rng, 80.0)!r}"] if rng.random() < 0.5 else []


def motion(rng, kind, gearing):
    """The lines of ``[motion]``."""
    law = rng.choice(list(LAWS))
    lines = [f'law = "{law}"']
    if law == "sine-group" and rng.random() < 0.9:
        lines.append(f"lambda = {rng.choice([0.1, -0.125, 0.08333, rng.uniform(-0.3, 0.3)])!r}")
    if law == "scca":
        b, d = rng.choice([(0.25, 0.25), (0.0, 1.0), (1.0, 0.0), (0.001, 0.999), (0.4, 0.125)])
        lines += [f"b = {b!r}", f"c = {1.0 - b - d!r}", f"d = {d!r}"]
    if law == "table":
        lines.append('file = "law.csv"')
    if rng.random() < 0.5:
        lines.append(f"alpha0_deg = {rng.choice([-10, 10, 25, rng.uniform(-60, 60)])!r}")
    if kind != "cam" and rng.random() < (0.8 if gearing == "internal" else 0.4):
        ratio = rng.choice(['"matched"', repr(rng.random())])
        lines.append(f"ratio = {ratio}")
    return lines


def sized(rng, L, R, r, outside):
    """The lines of ``[size]``, but for the centre distance."""
    text = ["[size]", f"face_width_mm = {near(rng, 2.0 * r)!r}"]
    if rng.random() < 0.9:
        text.append(f"roller_radius_mm = {r!r}")
    often = rng.choice([0.0, 0.05, 0.3, 0.8])
    for field in fields(Size):
        if field.key not in TAKEN and rng.random() < often:
            value = usual(rng, field.key, L, R, r, outside)
            worded = field.key in WORDED
            if not worded and rng.random() < 0.03:
                value = in_range(rng, field.rule, False)
            text.append(f"{field.key} = " + (f'"{value}"' if worded else repr(value)))
    return text


def loaded(rng):
    """The lines of loads, materials, product and limits."""
    text, given = [], {}
    for about in (LOADS, BEARS, LIMITS, PRODUCT):
        often = rng.choice([0.0, 0.3, 0.8])
        given |= {k: near(rng, v, 0.5) for k, v in about.items() if rng.random() < often}
    if given.keys() & set(LOADED) and rng.random() < 0.95:  # which limit nothing without a load
        given.setdefault("inertia_kgm2", near(rng, LOADS["inertia_kgm2"], 0.5))
    if "roller_life_min_h" in given:
        given.setdefault("dynamic_capacity_N", near(rng, BEARS["dynamic_capacity_N"]))
    if given.keys() & {"product_acceleration_max_m_s2", *PRODUCT}:
        given.setdefault("radius_mm", near(rng, PRODUCT["radius_mm"]))
    tables = (
        ("load", LOADS),
        ("material.roller", BEARS),
        ("product", PRODUCT),
        ("limits", LIMITS),
    )
    for table, about in tables:
        text += [f"[{table}]", *[f"{k} = {v!r}" for k, v in given.items() if k in about]]
        if about is LOADS and rng.random() < 0.3:
            text.append(f'friction_at = "{rng.choice(["pin", "pin", "slot"])}"')
    if rng.random() < 0.2:
        text.append(f"dwell_position_max_deg = {near(rng, 0.5)!r}")
        text += ["[tolerance]", f"lock_radius_mm = {near(rng, 0.02)!r}"]
    return text


def machine_text(rng, kind=None):
    """A machine that a designer might write, or nearly; of any kind of drive, or the one given."""
    # linkages take a hundred times as long to read as others
    kinds = ["crank"] * 14 + [k for k in DRIVES for _ in range(1 + (k not in LINKAGES))]
    kind = kind or rng.choice(kinds)
    z, gearing, lines = wheel(rng, kind)
    L = rng.choice([100.0, 100.0, near(rng, 100.0, 1.0)])
    R = L * math.sin(math.pi / z)
    room = min(R, (L - R) * math.sin(math.pi / z)) if gearing == "external" else R
    r = room * rng.choice([rng.uniform(0.03, 0.5), rng.random() ** 3, 0.3])
    flat = gearing != "spherical" and kind not in ONE_WAY
    curved = kind == "cam" or (flat and rng.random() < 0.3)
    straight = gearing == "external" and not curved and "steps_deg" not in lines[-1]
    if straight and kind not in ONE_WAY and rng.random() < 0.25:
        lines.append(f"offset_mm = {rng.choice([0.1, 0.5, 1.0]) * rng.uniform(-1, 1) * (L - R)!r}")
    text = ["[wheel]", *lines, "[drive]", f'kind = "{kind}"', *own_keys(rng, kind)]
    if rng.random() < 0.5:
        text.append(f"n_rpm = {near(rng, 60.0, 1.0)!r}")
    if kind not in ONE_WAY and gearing == "external" and rng.random() < 0.3:
        text.append(f"rollers = {rng.choice([1, 2, 2, 3, 4, 6])}")
        if rng.random() < 0.3:
            angles = [0.0, *sorted(rng.uniform(0, 360) for _ in range(rng.randint(0, 3)))]
            text[-1] = f"rollers = {len(angles)}\nroller_angles_deg = {angles!r}"
    if curved:
        text += ["[motion]", *motion(rng, kind, gearing)]
    text += sized(rng, L, R, r, gearing == "external")
    if kind not in LINKAGES:
        text.insert(2 + text.index("[size]"), f"center_distance_mm = {L!r}")
    text += loaded(rng)
    # last, so that the random numbers of other machines stay as they are
    skewed = any(line.startswith(("offset_mm", "rollers")) for line in text)
    if kind in ("crank", "side-crank") and straight and not skewed and rng.random() < 0.3:
        text.insert(1, "stop = true")
        text.insert(1 + text.index("[load]"), f"winding_torque_Nm = {near(rng, 2.0)!r}")
        text.append(f"stop_stress_max_MPa = {near(rng, 900.0)!r}")
    if kind == "crank" and rng.random() < 0.06:
        return rack_text(rng)
    if kind == "crank" and straight and not skewed and rng.random() < 0.15:
        steps = [0, *rng.sample(range(1, z), min(z - 1, rng.choice([1, 1, 2, 3])))]
        text.insert(1 + text.index("[drive]"), f"rollers = {len(steps)}\ncrank_steps = {steps}")
        if rng.random() < 0.2:
            ahead = rng.choice([name for name in DRIVES if drive(name).IN_FRONT])
            text += ["[drive.before]", f'kind = "{ahead}"', *own_keys(rng, ahead)]
    if not drive(kind).FIRST and (curved or kind != "crank") and rng.random() < 0.3:
        ahead = rng.choice([name for name in DRIVES if drive(name).IN_FRONT])
        text += ["[drive.before]", f'kind = "{ahead}"', *own_keys(rng, ahead)]
    if rng.random() < (0.6 if kind == "carousel" else 0.1):
        text += bodies(rng, L, kind == "carousel")
        if rng.random() < 0.5:
            stiffness, damping = near(rng, 500.0, 3.0), rng.choice([0.0, 0.02, rng.random()])
            text += ["[shaft]", f"stiffness_Nm_rad = {stiffness!r}", f"damping_ratio = {damping!r}"]
    text = with_radius(rng, text, L, R, flat and not curved)
    if curved or not flat or "stop = true" in text:
        text = [line for line in text if not line.startswith(("mouth_radius", "horn_tip"))]
    return "\n".join(text) + "\n"


def with_radius(rng, text, L, R, straight):
    """The lines with the crank's radius now and then, in place of L or, as built, beside it."""
    distance = f"center_distance_mm = {L!r}"
    if straight and distance in text and rng.random() < 0.1:
        radius = f"crank_radius_mm = {near(rng, R, 1e-3)!r}"
        text[text.index(distance)] = rng.choice([radius, f"{distance}\n{radius}"])
    return text


def bodies(rng, L, orbits):
    """One to three bodies on the wheel, of every shape; on one that orbits they are balanced."""
    text = []
    for _ in range(rng.randint(1, 3)):
        shape = rng.choice(["disc", "ring", "block", "point"])
        text += ["[[mass]]", f'shape = "{shape}"', f"mass_kg = {near(rng, 1.0, 1.0)!r}"]
        across = {"disc": ("diameter",), "ring": ("diameter", "bore"), "block": ("length", "width")}
        sides = zip(across.get(shape, ()), (0.4 * L, 0.2 * L), strict=False)
        text += [f"{side}_mm = {near(rng, size)!r}" for side, size in sides]
        radius = rng.choice([0.0, near(rng, 0.5 * L)])
        if radius or shape == "point":
            text.append(f"radius_mm = {radius or near(rng, L)!r}")
        if orbits or rng.random() < 0.3:
            text.append(f"count = {rng.randint(1 + orbits, 5)}")
    return text


def rack_text(rng):
    """A rack that a crank pushes, the crank's shaft perhaps behind another drive."""
    R = rng.choice([30.0, 100.0, near(rng, 50.0, 1.0)])
    r = R * rng.choice([rng.uniform(0.03, 0.4), 0.1, 0.15])
    kind = rng.choice(["crank", "crank", *(name for name in DRIVES if drive(name).IN_FRONT)])
    text = ["[wheel]", f"z = {rng.choice([3, 4, 6, 8, 12, 24])}", 'gearing = "linear"']
    text += ["[drive]", f'kind = "{kind}"', *own_keys(rng, kind)]
    if rng.random() < 0.5:
        text.append(f"n_rpm = {near(rng, 60.0, 1.0)!r}")
    if rng.random() < 0.03:
        text.append("rollers = 2")  # which jam
    slots = rng.choice([1.5 * R, 2.0 * R])
    text += sized(rng, slots, R, r, True)
    text.insert(2 + text.index("[size]"), f"center_distance_mm = {R!r}")
    table, pushed = "", {"inertia_kgm2": "mass_kg", "torque_Nm": "force_N"}
    for line in loaded(rng):
        key, _, value = line.partition(" = ")
        table = line if line.startswith("[") else table
        if table not in ("[product]", "[tolerance]") and key not in WHEELS_ONLY:
            # a wheel's loads, as a mass and a force at the crank's radius, of about the same size
            text.append(f"{pushed[key]} = {float(value) * 100.0!r}" if key in pushed else line)
    if kind == "crank" and rng.random() < 0.5:
        text.insert(1 + text.index("[load]"), f"guide_friction = {near(rng, 0.2, 1.0)!r}")
    if rng.random() < 0.2:
        keys = {"crank_diameter_mm": 0.2 * R, "crank_overhang_mm": 0.4 * R, "crank_span_mm": R}
        text += ["[shaft]", *(f"{key} = {near(rng, size)!r}" for key, size in keys.items())]
    return "\n".join(text) + "\n"
