"""Operators, containers, pickles and shortcuts of buffers and transforms, on both cores."""

import importlib.util
import os
import pickle
import types
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp
from tests.programs import run_python

from turtlewire.errors import InvalidTransformError

SECOND = 1_000_000_000


@pytest.fixture(scope="session")
def buffer_type(core):
    """`turtlewire.Buffer` on each core: the module is run again with the other one chosen."""
    spec = importlib.util.find_spec("turtlewire.tf.buffer")
    other = types.ModuleType("buffer_on_another_core")
    other.__dict__["__name__"] = "buffer_on_another_core"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("turtlewire.tf.implementation.BaseBuffer", core.Buffer)
        native = core.__name__ == "turtlewire._native"
        patch.setattr("turtlewire.tf.implementation.CORE", "native" if native else "python")
        exec(compile(Path(spec.origin).read_text(), spec.origin, "exec"), vars(other))
    return other.Buffer


def poses():
    number = st.floats(-5, 5)
    quaternion = st.tuples(number, number, number, number).filter(lambda q: np.linalg.norm(q) > 0.1)
    return st.tuples(st.tuples(number, number, number), quaternion)


def made(core, names, pose, stamp=None):
    translation, quaternion = pose
    rotation = tuple(quaternion / np.linalg.norm(quaternion))
    return core.Transform(*names, translation, rotation, stamp_ns=stamp)


@given(poses(), poses())
def test_matmul_multiplies_the_matrices(core, first, second):
    a, b = made(core, ("a", "b"), first), made(core, ("b", "c"), second)
    assert (a @ b).as_matrix() == pytest.approx(a.as_matrix() @ b.as_matrix(), abs=1e-9)
    assert ((a @ b).target_frame, (a @ b).source_frame) == ("a", "c")
    assert (a @ a.inverse()).as_matrix() == pytest.approx(np.eye(4), abs=1e-9)


@given(poses(), poses(), st.integers(0, SECOND))
def test_interpolation_is_lerp_and_slerp(core, first, second, at):
    a = made(core, ("a", "b"), first, 10 * SECOND)
    b = made(core, ("a", "b"), second, 11 * SECOND)
    between = a.interpolate(b, 10 * SECOND + at)
    assert between == b.interpolate(a, 10 * SECOND + at)
    u = at / SECOND
    expected = (1 - u) * np.array(a.translation) + u * np.array(b.translation)
    assert between.translation == pytest.approx(tuple(expected), abs=1e-9)
    turns = Rotation.from_quat([a.rotation, b.rotation])
    if (turns[0].inv() * turns[1]).magnitude() < 3.1:  # a half turn has two ways
        turned = Slerp([0, 1], turns)([u])[0]
        assert (turned.inv() * Rotation.from_quat(between.rotation)).magnitude() < 1e-6
    assert between.stamp_ns == 10 * SECOND + at


def test_stamps_of_products(core):
    identity = ((0, 0, 0), (0, 0, 0, 1))
    a, b = made(core, ("a", "b"), identity, 5), made(core, ("b", "c"), identity, 3)
    fixed = made(core, ("b", "c"), identity)
    assert (a @ b).stamp_ns == 3
    assert (a @ fixed).stamp_ns == a.inverse().stamp_ns == 5
    assert (a @ made(core, ("b", "c"), identity, 0)).stamp_ns == 0
    assert (fixed @ made(core, ("c", "d"), identity)).stamp_ns is None
    assert a.interpolate(a, np.int64(5)) == a
    with pytest.raises(TypeError, match="stamp_ns must be an int"):
        a.interpolate(a, 5.0)
    with pytest.raises(ValueError, match="without a stamp"):
        fixed.interpolate(fixed, 5)


@given(poses())
def test_points_and_matrices(core, pose):
    a = made(core, ("a", "b"), pose, 5)
    points = np.arange(24.0).reshape(2, 4, 3)
    matrix = a.as_matrix()
    expected = points @ matrix[:3, :3].T + matrix[:3, 3]
    assert a.apply(points) == pytest.approx(expected, abs=1e-12)
    assert a.apply([1, 0, 0]).shape == (3,)
    assert a.apply(points.astype(np.float32)).dtype == np.float32
    again = core.Transform.from_matrix("a", "b", matrix, stamp_ns=5)
    assert (again.target_frame, again.source_frame, again.stamp_ns) == ("a", "b", 5)
    assert again.as_matrix() == pytest.approx(matrix, abs=1e-9)


def test_unsuitable_points_and_matrices(core):
    a = core.Transform("a", "b", (0, 0, 0))
    assert a.rotation == (0.0, 0.0, 0.0, 1.0)
    with pytest.raises(ValueError, match=r"\(\.\.\., 3\), not \(2, 2\)"):
        a.apply(np.ones((2, 2)))
    with pytest.raises(InvalidTransformError) as caught:
        core.Transform.from_matrix("a", "b", 2 * np.eye(4))
    assert caught.value.reason == "not a rotation"
    with pytest.raises(ValueError, match=r"\(4, 4\), not \(3, 3\)"):
        core.Transform.from_matrix("a", "b", np.eye(3))
    with pytest.raises(TypeError, match="stamp_ns"):
        core.Transform("a", "b", (0, 0, 0), stamp_ns=1.0)
    with pytest.raises(ValueError, match="translation must have 3 numbers"):
        core.Transform("a", "b", (0, 0))
    with pytest.raises(TypeError, match="source_frame must be str, not int"):
        core.Transform("a", 5, (0, 0, 0))
    with pytest.raises(TypeError, match="target_frame must be str, not int"):
        core.Transform(5, "b", (0, 0, 0))


def test_euler_angles(core):
    a = core.Transform("a", "b", (0, 0, 0), (0, 0, np.sqrt(0.5), np.sqrt(0.5)))
    assert a.euler == pytest.approx((0, 0, np.pi / 2))


def test_unsuitable_values(core):
    identity = ((0, 0, 0), (0, 0, 0, 1))
    a, c = made(core, ("a", "b"), identity, 5), made(core, ("c", "b"), identity, 7)
    with pytest.raises(ValueError, match=r"the inner frames differ, 'b' and 'c'; inverse\(\)"):
        a @ c
    with pytest.raises(TypeError):
        a @ 3
    with pytest.raises(TypeError, match=r"Transform times ndarray is not defined; .*apply"):
        a @ np.ones(7)  # NumPy would make one number of it
    with pytest.raises(ValueError, match="different frames"):
        a.interpolate(c, 6)
    with pytest.raises(ValueError, match="9 is not between 5 and 8"):
        a.interpolate(made(core, ("a", "b"), identity, 8), 9)


def test_a_buffer_knows_its_frames_and_shows_itself(buffer_type):
    buffer = buffer_type(None)
    assert (bool(buffer), buffer.frames(), str(buffer)) == (True, [], "")
    assert repr(buffer) == "<Buffer: 0 frames, 0 links>"
    buffer.set_transform("map", "base", 10 * SECOND, (1, 0, 0), (0, 0, 0, 1))
    buffer.set_transform("map", "base", 12 * SECOND, (2, 0, 0), (0, 0, 0, 1))
    buffer.set_static_transform("base", "laser", (0, 1, 0), (0, 0, 0, 1))
    assert buffer.frames() == ["base", "map", "laser"]
    assert str(buffer) == "map\n  base\n    laser"
    assert "base" in buffer
    assert "Base" not in buffer
    assert 3 not in buffer
    assert repr(buffer) == (
        "<Buffer: 3 frames, 2 links, 2 samples from 10.000 to 12.000 (2.000 s)>"
    )


def test_a_buffer_is_pickled():
    from turtlewire import Buffer

    buffer = Buffer(None)
    for i in range(100):
        buffer.set_transform("map", "base", i * SECOND, (i, 0, 0), (0, 0, 0, 1))
    buffer.set_static_transform("base", "laser", (0, 1, 0), (0, 0, 0, 1))
    copy = pickle.loads(pickle.dumps(buffer))
    assert copy.cache_time_ns is None
    assert copy.lookup_transform("map", "laser", 50 * SECOND).translation == (50, 1, 0)

    assert type(copy) is Buffer

    class Own(Buffer):
        pass

    with pytest.raises(TypeError, match="cannot pickle Own"):
        pickle.dumps(Own())


def test_a_buffer_is_one_class_of_its_core():
    from turtlewire import Buffer
    from turtlewire.tf import buffer, implementation, plain

    assert Buffer is buffer.Buffer
    assert issubclass(Buffer, implementation.BaseBuffer)
    assert (Buffer.__module__, Buffer.__qualname__) == ("turtlewire", "Buffer")
    assert not hasattr(implementation.BaseBuffer, "from_bag")  # nothing is added from outside
    if buffer.CORE == "native":  # CPython calls only an exact class's own C methods directly
        assert Buffer.lookup_transform.__objclass__ is Buffer
    for core in (Buffer, plain.Buffer):
        with pytest.raises(AttributeError):
            core().note = "a misspelt attribute"


def test_shortcuts(tmp_path):
    from tests.bags import START, write_bag

    from turtlewire import Buffer

    path = write_bag(tmp_path / "made")
    buffer = Buffer.from_bag(path)
    assert buffer.bag_report.messages == 101
    assert Buffer().bag_report is None
    trajectory = buffer.trajectory("odom", "camera", rate_hz=10)
    assert np.diff(trajectory.stamps_ns).tolist() == [SECOND // 10] * 9
    assert buffer.trajectory("odom", "camera").stamps_ns[0] == START
    times = np.array(["2023-11-14T22:13:20.1"], dtype="datetime64[ns]")
    assert buffer.trajectory("odom", "camera", stamps=times).positions[0, 0] == pytest.approx(0.1)

    class Own(Buffer):
        pass

    assert isinstance(Own.from_bag(path), Own)


def test_the_twin_reads_bags(tmp_path):
    from tests.bags import write_bag

    path = write_bag(tmp_path / "made")
    code = (
        "import sys, turtlewire; b = turtlewire.Buffer.from_bag(sys.argv[1]); print(b.bag_report)"
    )
    done = {
        core: run_python(code, str(path), env={**os.environ, "TURTLEWIRE_CORE": core}).stdout
        for core in ("python", "")
    }
    assert done["python"] == done[""]
    assert "made: 101 messages" in done[""]
