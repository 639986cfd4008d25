"""``geneva profile``."""

from geneva_cli.cli.command import Design, require_written, say
from geneva_cli.drawings.catalogue import is_sheet, require_tolerance
from geneva_cli.errors import GenevaError
from geneva_cli.output import DRAWN, SHEETS, chosen, draw, draw_sheet, named, show, usual


def run(
    design: Design,
    part: str = "slot",
    tolerance: float | None = None,
    samples: int | None = None,
    curves: str | None = None,
    kerf: float | None = None,
    cutter: float | None = None,
    dxf_version: str | None = None,
    force: bool = False,
    output: str = "-",
    format: str = "",
) -> None:
    """Write a part as a table of points, or as a drawing to cut: csv, dxf, svg, step or pdf.

    A drawing is written only if its machine completes a whole turn. All parts, frames of
    reference and layers: `geneva help parts`.

    Options:
      --part PART      slot, wheel, crank, arm, assembly, parts, sheet or another.
      --tolerance MM   Greatest distance from the true curve.  [default: 0.001; of meshes 0.01]
      --samples N      Number of rows of a table, evenly spaced.
      --force          Draw even a machine that jams.
      --format FORMAT  table, csv, json, md, dxf, svg, step, stl, 3mf or pdf.

    The drawing:
      --curves KIND          Curved walls as arcs or spline; .step has spline.
      --dxf-version VERSION  Version of .dxf, R12 to R2018.  [default: R2000]

    To cut:
      --kerf MM    Paths for a cut of this width.
      --cutter MM  Diameter of a milling cutter that must fit.

    Examples:
      geneva profile spec.toml --samples 9
      geneva profile spec.toml --part wheel -o wheel.dxf
      geneva profile spec.toml --part sheet -o machine.pdf
    """
    from geneva_cli.design import form_of

    walls, tolerance = usual(output, format, tolerance)
    curves = curves or walls
    form_of(curves)  # refuses another word
    sheet, drawn = is_sheet(part), named(output, format) in DRAWN
    files = design.spec.files
    table = not sheet and design.is_table(part, drawn)
    if (sheet or table) and (kerf is not None or cutter is not None):
        raise GenevaError("--kerf and --cutter are for parts to cut; this is a table, or a sheet")
    if table:
        if dxf_version is not None:
            raise GenevaError("--dxf-version is for drawings; this is a table of points")
        show(design.part_table(part, tolerance, samples), output, format, files)
        say(design.spec.path, design.motion_warnings)
        return
    if samples is not None:
        raise GenevaError("--samples is for tables of points; drawings take --tolerance")
    chosen(output, format, SHEETS if sheet else DRAWN)  # refused before the machine is turned
    require_tolerance(design.mechanism, tolerance)
    if design.spec.is_turned:
        require_written(design, design.judge(part), force)
    if sheet:
        draw_sheet(design.sheet(tolerance, curves), output, format, files, dxf_version or "")
    else:
        if cutter is not None:
            require_written(design, design.cutter(part, cutter), force)
        drawing = design.drawing(part, tolerance, curves, kerf)
        shown = drawing if kerf is not None else design.drawing_over(drawing)
        draw(shown, output, format, files, dxf_version or "")
    say(design.spec.path, design.motion_warnings)
