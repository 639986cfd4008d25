"""`geneva export`: the files of each trade, all or none, and no file of a person replaced."""

import csv

import ezdxf
import pytest
import repo
import trimesh
from typer.testing import CliRunner

from geneva_cli import load
from geneva_cli.cli.app import app
from geneva_cli.study import export

WHEEL = "[wheel]\nz = 4\n[size]\ncenter_distance_mm = 30\n"


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text(WHEEL)
    return path


def run(*arguments):
    return CliRunner().invoke(app, ["export", *map(str, arguments)])


def bytes_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.long
def test_the_files_of_a_laser(spec, tmp_path):
    result = run(spec, "--for", "laser", "-o", tmp_path / "out")
    assert result.exit_code == 0
    assert "size.process is not set" in result.stderr
    cut = ["arm", "frame", "locking-disc", "wheel"]
    names = {f"{name}-1x-3mm.dxf" for name in cut}
    written = bytes_of(tmp_path / "out")
    assert set(written) == {*names, "sheet.pdf", "parts.csv", "spec.toml", "contents.csv"}
    with (tmp_path / "out" / "contents.csv").open(encoding="utf-8", newline="") as file:
        listed = {row["file"] for row in csv.DictReader(file)}
    assert listed == set(written) - {"contents.csv"}
    assert all(name in result.stdout for name in listed)
    for name in names:
        drawn = ezdxf.readfile(tmp_path / "out" / name)
        assert {one.dxf.layer for one in drawn.modelspace()} <= {
            *("WHEEL", "CRANK", "ARM", "FRAME", "BORE")
        }


@pytest.mark.long
def test_gears_without_teeth_are_a_warning(tmp_path):
    source, folder = repo.DESIGNS / "gear-sector.toml", tmp_path / "out"
    result = run(source, "--for", "laser", "-o", folder)
    assert result.exit_code == 0
    assert result.stderr.count("[gears-without-teeth]") == 1
    assert not any("gear" in path.name and path.suffix == ".dxf" for path in folder.iterdir())


def test_what_is_printed_is_as_large_as_the_list_says(spec, tmp_path):
    """Files alone: mass over density of parts.csv, and the volume that trimesh has."""
    folder = tmp_path / "out"
    settings = "--set", "size.process=print", "--set", "size.center_distance_mm=100"
    result = run(spec, "--for", "print", *settings, "-o", folder)
    assert (result.exit_code, result.stderr) == (0, "")
    with (folder / "parts.csv").open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["row"] == "part"]
    meshes = [path for path in folder.iterdir() if path.suffix == ".stl"]
    assert len(meshes) == len(rows)
    for row in rows:
        (path,) = (
            m
            for m in meshes
            if m.name.startswith(row["name"].replace("'", "").replace(" ", "-") + "-")
        )
        volume = 1e9 * float(row["mass_kg"]) / float(row["density_kgm3"])
        mesh = trimesh.load(path)
        assert mesh.is_watertight
        # chords take 2 x 0.005 mm / 2.5 mm of the thinnest pin's volume at most
        assert mesh.volume == pytest.approx(volume, rel=0.02)


@pytest.mark.long
def test_what_a_person_adds_or_changes_meanwhile_stays(spec, tmp_path, monkeypatch):
    folder = tmp_path / "out"
    assert run(spec, "--for", "laser", "-o", folder).exit_code == 0
    original = export.draw_sheet

    def slowly(*arguments):
        (folder / "notes.txt").write_text("work")
        (folder / "parts.csv").write_text("work")
        original(*arguments)

    monkeypatch.setattr(export, "draw_sheet", slowly)
    before = bytes_of(folder)
    result = run(spec, "--for", "laser", "-o", folder)
    assert result.exit_code == 2 and "parts.csv" in result.stderr
    work = {"notes.txt": b"work", "parts.csv": b"work"}
    assert bytes_of(folder) == before | work
    (folder / "parts.csv").write_bytes(before["parts.csv"])
    monkeypatch.undo()
    assert run(spec, "--for", "laser", "-o", folder).exit_code == 0
    assert bytes_of(folder) == before | {"notes.txt": b"work"}


@pytest.mark.usefixtures("no_advice")
def test_refused(spec, tmp_path):
    unknown = run(spec, "--for", "loom", "-o", tmp_path / "out")
    assert "must be one of laser, mill, print" in unknown.stderr
    assert "this is a file" in run(spec, "-o", spec).stderr
    assert "give -o FOLDER" in run(spec).stderr
    # so small a machine jams with a printer's clearances
    jams = run(spec, "--for", "print", "--set", "size.process=print", "-o", tmp_path / "out")
    assert jams.exit_code == 1
    assert "--force writes it anyway" in jams.stderr
    assert not (tmp_path / "out").exists()


def test_points_go_with_the_spec():
    files = export._spec_files(load(str(repo.DESIGNS / "table-law.toml")))
    assert [file.name for file in files] == ["points-1.csv", "spec.toml"]
