"""``geneva loads``."""

from geneva_cli.cli.command import Reversible, say
from geneva_cli.errors import is_warning


def run(
    design: Reversible,
    samples: int | None = None,
    certify: bool = False,
    verbose: bool = False,
    output: str = "-",
    format: str = "",
) -> None:
    """Loads of the motion: torque, forces, stress and power over a cycle.

    The recommended motor comes first, then the greatest loads and the warnings. With -v each
    quantity follows: its greatest and least value over the motions, with their input angles. Mean
    and root mean square are over the whole period. As csv, or with --samples, the cycle is printed
    in rows, evenly spaced in the input angle from entry. json and md always have everything.

    The pin force is a size; in rows it is negative on the wall that holds the wheel back. Torque
    and power of the input are negative where the wheel drives it; the greatest torque is a size. In
    a dwell all values are 0. Where clearances make play, a change of sides is an impact.

    Links are rigid and have no mass, and the motor exerts a torque alone. The force guide_force_N
    acts on what guides the roller besides its shaft: a rocker, slider, groove or fixed gear, or
    what pushes the crank. A coulisse's block or a first wheel's roller needs a length in [drive].
    Without it the crank's bearings are shown without that force. pv_W_m2 is the greatest Hertz
    pressure times the sliding speed, for a roller fixed to its pin.

    With --certify, the torques and the pin force are each proved to lie between two bounds, or
    called not proved. It needs geneva-cli[certify]. More: `geneva help accuracy`.

    Options:
      --samples N    The cycle in N rows instead (csv: 361).
      --certify      Prove the greatest loads instead.
      -v, --verbose  Powers, all loads, sizing and life too.

    Examples:
      geneva loads spec.toml
      geneva loads spec.toml -v
      geneva loads spec.toml -o cycle.csv
      geneva loads spec.toml --set load.inertia_kgm2=0.8 --format json
      geneva loads spec.toml --certify
    """
    from geneva_cli.output import choice, chosen, is_for_people, show, show_answer
    from geneva_cli.study.summary.load_lines import of_loads

    if certify:
        certificates = design.certified_loads(is_for_people(output, format))
        show(certificates, output, format, design.spec.files)
        say(design.spec.path, design.ideal_notes)
        return
    name = chosen(output, format)
    by_rows = name == "csv" or (samples is not None and name != "json")
    # before any output: a cycle whose loads are refused has no rows either
    warnings = design.loads_table.to_dict()["warnings"] if by_rows or output != "-" else ()
    if by_rows:
        table = design.load_cycle(361 if samples is None else samples)
        show(table, output, format, design.spec.files)
    else:
        answer = of_loads(design, name != "table" or verbose or bool(choice.columns))
        show_answer(answer, output, format, design.spec.files)
    say(design.spec.path, filter(is_warning, warnings))
