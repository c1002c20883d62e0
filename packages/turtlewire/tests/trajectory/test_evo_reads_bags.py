"""evo, unmodified, reads the transforms of a bag through our `tf2_py`."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.bags import write_bag

from turtlewire import Buffer
from turtlewire.trajectory import Trajectory

EVO = Path(sys.executable).parent / "evo_traj"


def test_evo_samples_our_buffer(tmp_path):
    bag = write_bag(tmp_path / "made", count=500)
    (path,) = bag.glob("*.mcap")
    done = subprocess.run(
        [EVO, "mcap", path, "/tf:odom.camera", "--save_as_tum"],
        cwd=tmp_path,
        env={**os.environ, "HOME": str(tmp_path), "MPLBACKEND": "Agg"},
        capture_output=True,
        text=True,
        timeout=840,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "50 poses" in done.stdout
    (saved,) = tmp_path.glob("*.tum")
    of_evo = Trajectory.load(saved)
    ours = Buffer.from_bag(bag).trajectory("odom", "camera", stamps=of_evo.stamps_ns)
    assert len(ours) == len(of_evo) == 50
    assert ours.poses == pytest.approx(of_evo.poses, abs=1e-6)
