"""Looking into a buffer, and changing it by other ways than new data, on both cores."""

from __future__ import annotations

import io
import math
import zipfile
from random import Random
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from turtlewire import errors, msg
from turtlewire.tf import inspection

if TYPE_CHECKING:
    from pathlib import Path

    import turtlewire

SECOND = 1_000_000_000
STILL = (0.0, 0.0, 0.0, 1.0)


def test_links_and_senders(buffer: turtlewire.Buffer) -> None:
    for t in range(11):
        buffer.set_transform("map", "base", t * SECOND + 1, (0, 0, 0), STILL, authority="odometry")
    buffer.set_transform("base", "camera", 5, (0, 0, 0), STILL, static=True, authority="me")
    base, camera = inspection.links(buffer)
    assert (base.child_frame, base.parent_frame, base.static, base.samples) == (
        "base",
        "map",
        False,
        11,
    )
    assert (base.rate_hz, base.age_ns(12 * SECOND + 1)) == (1.0, 2 * SECOND)
    assert base.senders == (("odometry", "map", 11, 10 * SECOND + 1),)
    assert (camera.static, camera.rate_hz, camera.age_ns(99)) == (True, 0.0, 0)
    assert inspection.conflicts(buffer) == []


def test_two_publishers(buffer: turtlewire.Buffer) -> None:
    for t in range(10):
        buffer.set_transform(
            "map",
            "base",
            t * SECOND + 1,
            (0, 0, 0),
            STILL,
            authority="odometry" if t % 2 else "slam",
        )
    (conflict,) = inspection.conflicts(buffer)
    assert (conflict.kind, conflict.child_frame) == ("two publishers", "base")
    assert "'odometry' and 'slam'" in conflict.text


def test_two_parents_but_not_a_hand_over(buffer: turtlewire.Buffer) -> None:
    for t in range(10):
        buffer.set_transform("left" if t % 2 else "right", "part", t * SECOND + 1, (0, 0, 0), STILL)
        buffer.set_transform(
            "table" if t < 5 else "gripper", "cup", t * SECOND + 1, (0, 0, 0), STILL
        )
    (conflict,) = inspection.conflicts(buffer)
    assert (conflict.kind, conflict.child_frame) == ("two parents", "part")


def test_many_senders_stay_bounded(buffer: turtlewire.Buffer) -> None:
    for t in range(1000):
        buffer.set_transform("map", "base", t + 1, (0, 0, 0), STILL, authority=f"node{t}")
    (link,) = inspection.links(buffer)
    assert len(link.senders) <= 17
    assert link.senders[-1].name == "node999"


def test_refusals_are_counted(buffer: turtlewire.Buffer) -> None:
    buffer.set_transform("map", "base", 100 * SECOND, (0, 0, 0), STILL)
    for _ in range(3):
        buffer.set_transform("map", "base", SECOND, (0, 0, 0), STILL, authority="late")
    buffer.set_transform("map", "base", 100 * SECOND, (math.nan, 0, 0), STILL, authority="broken")
    buffer.set_transform("base", "base", 100 * SECOND, (0, 0, 0), STILL)
    refused = inspection.refusals(buffer)
    assert refused["base"].counts == {"old_data": 3, "nan_value": 1, "self_transform": 1}
    assert refused["base"].last.startswith("TF_SELF_TRANSFORM")
    for i in range(2000):
        buffer.set_transform(f"x{i}", f"x{i}", 1, (0, 0, 0), STILL)
    refused = inspection.refusals(buffer)
    assert len(refused) <= 1001
    assert refused["(others)"].counts["self_transform"] >= 999


def test_malformed_messages_are_counted(buffer: turtlewire.Buffer) -> None:
    assert inspection.malformed(buffer) == (0, "", "")
    for data in (b"", b"\x00\x01\x00\x00\xff\xff\xff\xff"):
        with pytest.raises(errors.CdrError):
            buffer.ingest(data, authority="broken")
    assert inspection.malformed(buffer) == (
        2,
        "4294967295 transforms are announced, which do not fit into 8 bytes",
        "broken",
    )


def test_a_frame_id_that_is_no_text_is_refused_and_the_rest_kept(buffer: turtlewire.Buffer) -> None:
    good = tf_message([("map", "base"), ("map", "robo#"), ("m#p", "cart"), ("map", "arm")])
    assert buffer.ingest(good.replace(b"#", b"\xff"), authority="broken") == 2
    assert buffer.frame_strings() == ["base", "map", "arm"]
    refused = inspection.refusals(buffer)
    assert {child: record.counts for child, record in refused.items()} == {
        "robo\ufffd": {"bad_name": 1},
        "cart": {"bad_name": 1},
    }
    assert refused["cart"].last == (
        'Ignoring transform from authority "broken": '
        "a frame id must be UTF-8 text without NUL, of at most 4096 bytes"
    )


def tf_message(frames: list[tuple[str, str]]) -> bytes:
    stamped = msg.get_message("geometry_msgs/msg/TransformStamped")
    message = msg.get_message("tf2_msgs/msg/TFMessage")()
    for parent, child in frames:
        message.transforms.append(stamped(child_frame_id=child))
        message.transforms[-1].header.frame_id = parent
    return msg.serialize(message)


def test_a_sender_may_get_its_name_late(buffer: turtlewire.Buffer) -> None:
    for t, sender in ((1, "/slam"), (2, "0a0b"), (3, "/slam"), (4, "0a0b")):
        buffer.set_transform("map", "base", t, (0, 0, 0), STILL, authority=sender)
    buffer._rename_sender("0a0b", "/odometry")
    buffer._rename_sender("0c0d", "/odometry")
    buffer.set_transform("map", "base", 5, (0, 0, 0), STILL, authority="0c0d")
    (link,) = inspection.links(buffer)
    assert link.senders == (("/slam", "map", 2, 3), ("/odometry", "map", 3, 5))
    assert "'/odometry'" in buffer.all_frames_as_yaml()


def test_remove(buffer: turtlewire.Buffer) -> None:
    buffer.set_transform("a", "b", 1, (1, 0, 0), STILL, static=True)
    buffer.set_transform("b", "c", 1, (1, 0, 0), STILL, static=True)
    buffer.set_transform("b", "d", 1, (1, 0, 0), STILL)
    assert buffer.can_transform("a", "c")
    assert buffer.remove_frame("c")
    assert not buffer.remove_frame("c")
    assert not buffer.remove_frame("nobody")
    with pytest.raises(errors.LookupException):
        buffer.lookup_transform("a", "c")
    assert buffer.frame_strings() == ["b", "a", "d"]
    assert not buffer.frame_exists("c")
    assert buffer.lookup_transform("a", "d").x == 2.0
    assert buffer.remove_frame("b")  # d still hangs on it
    assert buffer.frame_strings() == ["b", "d"]
    buffer.set_transform("b", "c", 1, (5, 0, 0), STILL, static=True)
    assert buffer.lookup_transform("b", "c").x == 5.0
    assert buffer._fault() == ""


def test_remove_stale(buffer: turtlewire.Buffer) -> None:
    for name, t in (("old", 1), ("new", 5)):
        buffer.set_transform("map", name, t * SECOND, (0, 0, 0), STILL)
    buffer.set_transform("map", "fixed", 0, (0, 0, 0), STILL, static=True)
    assert buffer.remove_stale(3 * SECOND) == ["old"]
    assert buffer.frame_strings() == ["map", "new", "fixed"]


def test_extrapolation(buffer: turtlewire.Buffer) -> None:
    for t in (1, 2, 3):
        buffer.set_transform(
            "a", "b", t * SECOND, (10.0 * t, 0, 0), (0, 0, math.sin(0.1 * t), math.cos(0.1 * t))
        )
    after = buffer.extrapolate_transform("a", "b", 4 * SECOND, SECOND)
    assert after.translation == pytest.approx((40, 0, 0))
    assert after.rotation == pytest.approx((0, 0, math.sin(0.4), math.cos(0.4)))
    before = buffer.extrapolate_transform("b", "a", SECOND // 2, SECOND)
    assert before.inverse().translation == pytest.approx((5, 0, 0))
    assert buffer.extrapolate_transform("a", "b", 2 * SECOND, 0).x == 20.0
    with pytest.raises(errors.ExtrapolationException, match="into the future"):
        buffer.extrapolate_transform("a", "b", 4 * SECOND + 1, SECOND)
    with pytest.raises(errors.ExtrapolationException, match="into the past"):
        buffer.extrapolate_transform("a", "b", 1, SECOND - 2)
    with pytest.raises(ValueError, match="negative"):
        buffer.extrapolate_transform("a", "b", 1, -1)


@pytest.mark.parametrize("names", [("a\udcff", "b"), ("a", "b\udcff")])
def test_names_without_utf_8_are_refused(buffer: turtlewire.Buffer, names: tuple[str, str]) -> None:
    buffer.set_transform("a", "b", SECOND, (0, 0, 0), STILL)
    with pytest.raises(UnicodeEncodeError, match="surrogates"):
        buffer.lookup_latest(*names)
    with pytest.raises(UnicodeEncodeError, match="surrogates"):
        buffer.extrapolate_transform(*names, SECOND, 0)


def test_latest_of_each_link(buffer: turtlewire.Buffer) -> None:
    for t in range(1, 11):
        buffer.set_transform("map", "base", t * SECOND, (t, 0, 0), STILL)
    buffer.set_transform("base", "arm", 3 * SECOND, (0, 1, 0), STILL)
    buffer.set_transform("base", "lamp", 9 * SECOND, (0, 0, 1), STILL)
    buffer.set_transform("arm", "hand", 0, (0, 0, 1), STILL, static=True)
    found, stamps = buffer.lookup_latest("map", "hand")
    assert (found.translation, found.stamp_ns, stamps) == (
        (10.0, 1.0, 1.0),
        3 * SECOND,
        {"arm": 3 * SECOND, "base": 10 * SECOND},
    )
    assert buffer.lookup_latest("lamp", "hand")[1] == {
        "arm": 3 * SECOND,
        "lamp": 9 * SECOND,
    }  # not of the links above base
    assert buffer.lookup_latest("map", "base", max_age_ns=SECOND, now_ns=11 * SECOND)[0].x == 10.0
    with pytest.raises(errors.ExtrapolationException) as caught:
        buffer.lookup_latest("map", "hand", max_age_ns=SECOND, now_ns=11 * SECOND)
    error = caught.value
    assert (error.reason, error.child_frame, error.newest_ns) == ("future", "arm", 3 * SECOND)
    with pytest.raises(ValueError, match="now_ns"):
        buffer.lookup_latest("map", "hand", max_age_ns=SECOND)


def test_whole_history(buffer: turtlewire.Buffer) -> None:
    stamps = np.arange(1, 6) * SECOND
    poses = np.array([[i, 0, 0, 0, 0, 0, 1] for i in range(5)], dtype=float)
    assert buffer.set_transforms("a", "b", stamps, poses, "robot") == 5
    assert buffer.set_transforms("z", "b", [6 * SECOND, 7 * SECOND], poses[:2]) == 2
    (first, second) = buffer.samples("b")
    assert first[0] == "a"
    assert np.array_equal(first[1], stamps)
    assert np.array_equal(first[2], poses)
    assert (second[0], len(second[1])) == ("z", 2)
    assert buffer.samples("a") == []
    with pytest.raises(errors.LookupException):
        buffer.samples("nobody")
    with pytest.raises(ValueError, match="shape"):
        buffer.set_transforms("a", "b", stamps, poses[:2])


def test_save_and_load(buffer: turtlewire.Buffer, tmp_path: Path) -> None:
    for t in range(1, 6):
        buffer.set_transform(
            "a" if t < 3 else "z",
            "b",
            t * SECOND,
            (t, 0, 0),
            (0, 0, math.sin(t), math.cos(t)),
            authority="robot",
        )
    buffer.set_transform("b", "c", 0, (1, 2, 3), (0.5, 0.5, 0.5, 0.5), static=True, authority="me")
    path = tmp_path / "tree.saved"
    inspection.save(buffer, path)
    again = inspection.load(path)
    assert again.all_frames_as_yaml() == buffer.all_frames_as_yaml()
    assert again.cache_time_ns == buffer.cache_time_ns
    for t in (1, 2, 3.5, 5):
        stamp = int(t * SECOND)
        target = "a" if t < 3 else "z"
        assert np.asarray(again.lookup_transform(target, "c", stamp)) == pytest.approx(
            np.asarray(buffer.lookup_transform(target, "c", stamp)), abs=1e-15
        )


def test_save_while_a_frame_is_removed(
    buffer: turtlewire.Buffer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    buffer.set_transform("map", "base", SECOND, (1, 2, 3), STILL)
    buffer.set_transform("map", "cup", SECOND, (1, 2, 3), STILL)
    listed = inspection.links(buffer)
    buffer.remove_frame("cup")
    monkeypatch.setattr(inspection, "links", lambda _buffer: listed)
    inspection.save(buffer, tmp_path / "file")
    assert inspection.load(tmp_path / "file").frame_strings() == ["base", "map"]


HEADER = b'{"format": "turtlewire buffer 1", "cache_time_ns": 1, "runs": [["a", "b", false, "me"]]}'


def archive(*, header: bytes, **arrays: bytes) -> bytes:
    """What `save` writes, with these bytes as the members."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as members:
        members.writestr("header.npy", claiming("|u1", (len(header),)) + header)
        for name, data in arrays.items():
            members.writestr(f"{name}.npy", data)
    return file.getvalue()


def claiming(dtype: str, shape: tuple[int, ...]) -> bytes:
    """The start of a file with an array, without its data."""
    start = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        start, {"descr": dtype, "fortran_order": False, "shape": shape}
    )
    return start.getvalue()


def test_load_any_bytes(buffer: turtlewire.Buffer, tmp_path: Path) -> None:
    for t in range(1, 6):
        buffer.set_transform("a", "b", t * SECOND, (t, 0, 0), STILL)
    path = tmp_path / "tree.saved"
    inspection.save(buffer, path)
    whole = path.read_bytes()
    random = Random(1)
    refused = 0
    for _ in range(400):
        data = bytearray(whole)
        for _ in range(random.randrange(1, 6)):
            data[random.randrange(len(data))] = random.randrange(256)
        path.write_bytes(data)
        try:
            inspection.load(path)
        except ValueError:
            refused += 1
    assert refused > 300


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: b"",
        lambda data: data[:-30],
        lambda data: b"x" * 200,
        lambda data: data[:300] + b"\0" * 40 + data[340:],
        lambda data: archive(header=b"[" * 100_000),
        lambda data: archive(header=b"[]"),
        lambda data: archive(header=HEADER, stamps0=b"", poses0=b""),
        lambda data: archive(header=HEADER, stamps0=claiming("<i8", (10**12,)), poses0=b""),
        lambda data: archive(header=HEADER, stamps0=claiming("|O", (1,)), poses0=b""),
        lambda data: archive(header=bytes(50_000_000)),
        lambda data: data.replace(b"PK\1\2", b"PK\1\2\xff\xff\xff\xff\xff"),
    ],
)
def test_load_something_else(buffer: turtlewire.Buffer, tmp_path: Path, damage: Any) -> None:
    for t in range(1, 6):
        buffer.set_transform("a", "b", t * SECOND, (t, 0, 0), STILL)
    path = tmp_path / "tree.saved"
    inspection.save(buffer, path)
    path.write_bytes(damage if isinstance(damage, bytes) else damage(path.read_bytes()))
    with pytest.raises(ValueError, match="is not a saved buffer"):
        inspection.load(path)
    with pytest.raises(FileNotFoundError):
        inspection.load(tmp_path / "missing")


def test_unlimited(core: Any) -> None:
    buffer = core.Buffer(None)
    assert buffer.cache_time_ns is None
    for t in (1, 10**18):
        assert buffer.set_transform("a", "b", t, (0, 0, 0), STILL) == ""
    assert buffer.can_transform("a", "b", 1)
