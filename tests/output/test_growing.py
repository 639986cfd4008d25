"""A file that grows: whole at the end, kept when stopped, gone on from only for the same."""

import os

import pytest

from geneva_cli.errors import GenevaError
from geneva_cli.output.growing import Growing

HEADER, KEY = "a,b\n", "request"


@pytest.fixture
def path(tmp_path):
    return str(tmp_path / "rows.csv")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def begun(path, text):
    with Growing(path, HEADER, KEY, False) as file:
        file.append(text)


def test_it_is_there_only_when_it_is_whole(path):
    with open(path, "w") as file:
        file.write("old")
    os.chmod(path, 0o640)
    with Growing(path, HEADER, KEY, False) as file:
        file.append("1,2\n")
        assert read(path) == "old"
        file.finish()
    assert read(path) == "a,b\n1,2\n"
    assert os.stat(path).st_mode & 0o777 == 0o640
    assert os.listdir(os.path.dirname(path)) == ["rows.csv"]


def test_a_stopped_run_is_gone_on_from_its_last_whole_line(path):
    begun(path, "1,2\n3,4\n5,")
    with Growing(path, HEADER, KEY, True) as file:
        assert file.done == 2
        file.append("5,6\n")
        file.finish()
    assert read(path) == "a,b\n1,2\n3,4\n5,6\n"


def test_without_resume_it_begins_again(path):
    begun(path, "1,2\n")
    with Growing(path, HEADER, KEY, False) as file:
        assert file.done == 0
        file.finish()
    assert read(path) == HEADER


def test_it_does_not_go_on_for_another_request(path):
    begun(path, "1,2\n")
    with pytest.raises(GenevaError, match="begun for something else"):
        Growing(path, HEADER, "another", True)
    assert read(path + ".partial") == "a,b\n1,2\n"


def test_nothing_to_go_on_from(path):
    with pytest.raises(GenevaError, match=r"no rows.csv.partial to go on from"):
        Growing(path, HEADER, KEY, True)


def test_an_input_is_not_written_over(path):
    begun(path, "")
    os.replace(path + ".partial", path)
    with pytest.raises(GenevaError, match="is an input"):
        Growing(path, HEADER, KEY, False, [path])


def test_no_folder(tmp_path):
    with pytest.raises(GenevaError, match="make the folder"):
        Growing(str(tmp_path / "none" / "rows.csv"), HEADER, KEY, False)


def test_no_device():
    with pytest.raises(GenevaError, match="not a file that can grow"):
        Growing("/dev/null", HEADER, KEY, False)
