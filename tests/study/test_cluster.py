"""The manual's way past one machine, run as it stands there on a local cluster."""

import os
import re
import subprocess
import sys

import pytest
import repo

from geneva_cli.manual import page
from geneva_cli.study.sweep.request import request


@pytest.mark.long
def test_the_dask_example_makes_the_bytes_of_one_run(tmp_path):
    text = page("sweep-front")
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    (example,) = [block for block in blocks if "dask" in block]
    # each shard is a run of the program, which takes longer to start than its rows: 3, not 16
    for shown, few in (("of=16", "of=3"), ("range(1, 17)", "range(1, 4)"), (":0.01", ":0.05")):
        assert shown in example
        example = example.replace(shown, few)
    (tmp_path / "example.py").write_text(example, encoding="utf-8")
    target = (repo.ROOT / "designs" / "side-crank-z6.toml").read_text(encoding="utf-8")
    (tmp_path / "slow.toml").write_text(target, encoding="utf-8")
    path = os.pathsep.join((os.path.dirname(sys.executable), os.environ["PATH"]))
    # small workers that talk to nobody but each other
    own = {"PATH": path, "DASK_DISTRIBUTED__DASHBOARD__LINK": "", "DASK_TEMPORARY_DIRECTORY": "."}
    subprocess.run(
        [sys.executable, "example.py"],
        cwd=tmp_path,
        env={**os.environ, **own},
        timeout=120,
        check=True,
    )
    asked = request(str(tmp_path / "slow.toml"), ["drive.A=0..0.9:0.05"], jobs=1)
    lines = (tmp_path / "all.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == ",".join(asked.sweep.names)
    rows = [row for block in asked.blocks() for row in block]
    assert [float(line.split(",")[0]) for line in lines[1:]] == [row[0] for row in rows]
    assert len(rows) == 19
