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


@pytest.mark.parametrize("text", ["1,2\n3,4\n5,", "1", ""])
def test_a_later_share_has_no_header_to_be_counted(path, text):
    """The row that was taken for one came twice."""
    with Growing(path, "", KEY, False) as file:
        file.append(text)
    with Growing(path, "", KEY, True) as file:
        assert file.done == text.count("\n")
        file.append("5,6\n")
        file.finish()
    assert read(path) == text[: text.rfind("\n") + 1] + "5,6\n"


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


def whole(path, *lines):
    """A file made by a run that may be asked for again."""
    with Growing(path, HEADER, KEY, True) as file:
        for line in lines:
            file.append(line)
        file.finish()


def test_where_there_is_nothing_to_go_on_from_it_begins(path):
    with Growing(path, HEADER, KEY, True) as file:
        assert "there is no rows.csv.partial" in file.found
        assert (file.done, file.is_whole) == (0, False)
        file.append("1,2\n")
        file.finish()
    assert read(path) == "a,b\n1,2\n"


def test_of_a_whole_file_there_is_nothing_to_do(path):
    whole(path, "1,2\n")
    with Growing(path, HEADER, KEY, True) as file:
        assert file.is_whole
        assert file.found == "--resume: rows.csv is whole already"
    assert read(path) == "a,b\n1,2\n"
    assert sorted(os.listdir(os.path.dirname(path))) == ["rows.csv", "rows.csv.key"]


@pytest.mark.parametrize("key", [KEY, "another"])
def test_a_file_of_something_else_or_changed_since_is_not_taken_for_whole(path, key):
    whole(path, "1,2\n")
    if key == KEY:
        with open(path, "a") as file:
            file.write("3,4\n")
    with Growing(path, HEADER, key, True) as file:
        assert not file.is_whole
        file.append("5,6\n")
        file.finish()
    assert read(path) == "a,b\n5,6\n"


def test_a_lost_file_is_made_again(path):
    whole(path, "1,2\n")
    os.unlink(path)
    whole(path, "1,2\n")
    assert read(path) == "a,b\n1,2\n"


def test_without_resume_nothing_is_left_beside_the_file(path):
    whole(path, "1,2\n")
    with Growing(path, HEADER, KEY, False) as file:
        file.finish()
    assert os.listdir(os.path.dirname(path)) == ["rows.csv"]


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
