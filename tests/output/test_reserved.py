"""Names that Windows does not give to a file, tried on any system."""

import ntpath
import os
from functools import partial

import pytest

from geneva_cli.errors import GenevaError
from geneva_cli.output import files
from geneva_cli.output.files import fault, require_possible
from geneva_cli.output.folder import Row, filling_folder
from geneva_cli.output.growing import GrowingFile

# as Microsoft lists them, "Naming Files, Paths, and Namespaces"
RESERVED = "nul nul.csv AUX.txt con prn.tar.gz Com1 LPT9.dxf com¹.csv CONIN$ ab:c.csv a. ... a* a?"
RESERVED = [*RESERVED.split(), "nul .csv", "bad:name", "a ", 'a"b', "a|b", "a\tb"]
TAKEN = "null.csv console aux-1.csv com0 com10.csv lpt.dxf .nul a.nul größe.csv .. . -1 wheel-1x-8"


@pytest.mark.parametrize("name", RESERVED)
def test_reserved(name):
    assert fault(name)


@pytest.mark.parametrize("name", TAKEN.split())
def test_taken(name):
    assert not fault(name)


@pytest.mark.skipif(not hasattr(ntpath, "isreserved"), reason="Python 3.13's own answer")
@pytest.mark.parametrize("name", [*RESERVED, *TAKEN.split()])
def test_as_python_has_it(name):
    assert bool(fault(name)) == ntpath.isreserved(name)


WRONG = {
    "shop/nul.csv": '"nul" for a device',
    r"C:\shop\aux\a.csv": '"aux" for a device',
    "a/bad:name.csv": "takes no ':' in a name",
    "shop./a.csv": "drops a dot or a space",
}


@pytest.mark.parametrize("path", WRONG)
def test_a_path_is_refused_on_windows_alone(path):
    with pytest.raises(GenevaError, match="Windows") as error:
        require_possible(path, "win32")
    assert WRONG[path] in str(error.value) and "give another name" in str(error.value)
    require_possible(path, "linux")
    require_possible(path, "darwin")


@pytest.mark.parametrize("path", [r"C:\shop\a.csv", "../a.csv", r"\\server\share\a.csv", "C:a.csv"])
def test_drives_and_servers_are_no_names(path):
    require_possible(path, "win32")


@pytest.mark.skipif(os.name == "nt", reason="here the name itself is refused")
def test_elsewhere_only_a_folder_for_others_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert files.real_path("aux.csv") == os.path.realpath("aux.csv")
    wrong = pytest.raises(GenevaError, match=r'"aux\.csv": Windows reserves the name "aux"')
    with wrong, filling_folder("shop", [Row("aux.csv", "points")]):
        pass
    assert not os.path.exists("shop")


def test_every_file_and_folder_is_asked_for(tmp_path, monkeypatch):
    """A file, one that grows, and a folder of an export, as on Windows."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(files, "require_possible", partial(require_possible, platform="win32"))
    with pytest.raises(GenevaError, match='"nul" for a device'):
        files.write("nul.csv", ["a text"])
    with pytest.raises(GenevaError, match='"aux" for a device'):
        GrowingFile("aux.csv", "a,b\n", "request", True)
    with pytest.raises(GenevaError, match='"con" for a device'), filling_folder("con", []):
        pass
    assert os.listdir() == []
