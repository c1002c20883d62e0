# The compiled core; use it through turtlewire.Buffer. The module itself has the docstrings.

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, final

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray
from typing_extensions import Buffer as AnyBuffer
from typing_extensions import Self

from turtlewire.bag.transform_report import TransformReport
from turtlewire.trajectory.trajectory import Trajectory

@final
class Transform:
    frame_id: str
    child_frame_id: str
    stamp_ns: int
    x: float
    y: float
    z: float
    qx: float
    qy: float
    qz: float
    qw: float
    def __new__(
        cls,
        frame_id: str,
        child_frame_id: str,
        stamp_ns: int,
        translation: tuple[float, float, float],
        rotation: tuple[float, float, float, float],
    ) -> Transform: ...
    @property
    def translation(self) -> tuple[float, float, float]: ...
    @property
    def rotation(self) -> tuple[float, float, float, float]: ...
    def inverse(self) -> Transform: ...
    def __matmul__(self, other: Transform) -> Transform: ...
    def interpolate(self, other: Transform, stamp_ns: int) -> Transform: ...
    def as_matrix(self) -> NDArray[np.float64]: ...
    def _repr_html_(self) -> str: ...
    def __array__(
        self, dtype: DTypeLike | None = None, copy: bool | None = None
    ) -> NDArray[Any]: ...
    def __eq__(self, other: object) -> bool: ...

class Buffer:
    def __init__(self, cache_time_ns: int | None = ...) -> None: ...
    @classmethod
    def from_bag(
        cls,
        path: str | os.PathLike[str],
        *,
        topics: str | Iterable[str] = "/tf",
        static_topics: str | Iterable[str] = "/tf_static",
        start_ns: int = 0,
        end_ns: int = ...,
        cache_time_ns: int | None = None,
        progress: Callable[[float], None] | None = None,
    ) -> Self: ...
    @property
    def bag_report(self) -> TransformReport | None: ...
    def trajectory(
        self,
        target_frame: str,
        source_frame: str,
        *,
        stamps: ArrayLike | None = None,
        rate_hz: float | None = None,
        max_gap_ns: int | None = None,
    ) -> Trajectory: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[str]: ...
    def __contains__(self, frame: object) -> bool: ...
    @property
    def cache_time_ns(self) -> int | None: ...
    def set_transform(
        self,
        parent_frame: str,
        child_frame: str,
        stamp_ns: int,
        translation: Sequence[float],
        rotation: Sequence[float],
        static: bool = False,
        authority: str = "default_authority",
    ) -> str: ...
    def ingest(
        self,
        cdr: bytes | bytearray | memoryview,
        static: bool = False,
        authority: str = "default_authority",
    ) -> int: ...
    def clear(self) -> None: ...
    def lookup_transform(
        self, target_frame: str, source_frame: str, stamp_ns: int = 0, timeout_ns: int = 0
    ) -> Transform: ...
    def lookup_transform_full(
        self,
        target_frame: str,
        target_stamp_ns: int,
        source_frame: str,
        source_stamp_ns: int,
        fixed_frame: str,
        timeout_ns: int = 0,
    ) -> Transform: ...
    def can_transform(
        self, target_frame: str, source_frame: str, stamp_ns: int = 0, timeout_ns: int = 0
    ) -> bool: ...
    def can_transform_full(
        self,
        target_frame: str,
        target_stamp_ns: int,
        source_frame: str,
        source_stamp_ns: int,
        fixed_frame: str,
        timeout_ns: int = 0,
    ) -> bool: ...
    def can_transform_reason(
        self, target_frame: str, source_frame: str, stamp_ns: int = 0, timeout_ns: int = 0
    ) -> str: ...
    def can_transform_full_reason(
        self,
        target_frame: str,
        target_stamp_ns: int,
        source_frame: str,
        source_stamp_ns: int,
        fixed_frame: str,
        timeout_ns: int = 0,
    ) -> str: ...
    def latest_common_time(self, target_frame: str, source_frame: str) -> int: ...
    def frame_strings(self) -> list[str]: ...
    def frame_exists(self, frame: str) -> bool: ...
    def all_frames_as_string(self) -> str: ...
    def all_frames_as_yaml(self, now: float = 0.0) -> str: ...
    def all_frames_as_dot(self, now: float = 0.0) -> str: ...
    def _repr_svg_(self) -> str: ...
    def add_change_listener(self, listener: Callable[[], object]) -> Callable[[], None]: ...
    def wake(self) -> None: ...
    def lookup_batch(
        self,
        target_frame: str,
        source_frame: str,
        stamps: ArrayLike,
        *,
        matrices: bool = False,
        out: NDArray[np.float64] | None = None,
        status: NDArray[np.uint8] | None = None,
    ) -> NDArray[np.float64]: ...
    def lookup_all(
        self, target_frame: str, stamp_ns: int = 0
    ) -> tuple[list[str], NDArray[np.float64], NDArray[np.int64]]: ...
    def transform_points(
        self,
        target_frame: str,
        source_frame: str,
        points: ArrayLike,
        stamps: int | ArrayLike = 0,
        *,
        fixed_frame: str | None = None,
        target_stamp_ns: int = 0,
        out: NDArray[Any] | None = None,
        status: NDArray[np.uint8] | None = None,
    ) -> NDArray[Any]: ...
    def lookup_velocity(
        self,
        tracking_frame: str,
        observation_frame: str,
        stamps: int | ArrayLike = 0,
        *,
        interval_ns: int = ...,
        reference_frame: str | None = None,
        point: tuple[float, float, float] = ...,
        point_frame: str | None = None,
        out: NDArray[np.float64] | None = None,
        status: NDArray[np.uint8] | None = None,
    ) -> NDArray[np.float64]: ...
    def extrapolate_transform(
        self, target_frame: str, source_frame: str, stamp_ns: int, limit_ns: int
    ) -> Transform: ...
    def lookup_latest(
        self, target_frame: str, source_frame: str, *, max_age_ns: int = 0, now_ns: int = 0
    ) -> tuple[Transform, dict[str, int]]: ...
    def remove_frame(self, child_frame: str) -> bool: ...
    def remove_stale(self, before_ns: int) -> list[str]: ...
    def samples(
        self, child_frame: str
    ) -> list[tuple[str, NDArray[np.int64], NDArray[np.float64]]]: ...
    def stamps(self, child_frame: str) -> NDArray[np.int64]: ...
    def set_transforms(
        self,
        parent_frame: str,
        child_frame: str,
        stamps: ArrayLike,
        poses: ArrayLike,
        authority: str = "default_authority",
    ) -> int: ...
    def _describe_links(
        self, most: int
    ) -> list[tuple[str, str, bool, int, int, int, int, int, list[tuple[str, str, int, int]]]]: ...
    def _describe_refusals(self) -> dict[str, tuple[dict[str, int], str]]: ...
    def _describe_malformed(self) -> tuple[int, str, str]: ...
    def _rename_sender(self, name: str, shown: str) -> None: ...
    def _fault(self) -> str: ...

class JointFrames:
    def __init__(
        self,
        template: bytes,
        stamps: list[int],
        poses: list[int],
        constants: list[float],
        sources: list[int],
        factors: list[float],
        offsets: list[float],
    ) -> None: ...
    def message(self, joint_state: bytes, positions: int) -> bytes: ...

class RecordWalk:
    def __init__(self, start_ns: int, end_ns: int) -> None: ...
    def walk(
        self,
        buffer: Buffer,
        records: bytes | memoryview,
        channels: Mapping[int, tuple[str, bool]],
    ) -> int: ...
    @property
    def messages(self) -> int: ...
    @property
    def jumps(self) -> list[tuple[int, str, int]]: ...
    @property
    def steps_back(self) -> dict[str, tuple[int, int]]: ...

class MessageLookup:
    def __init__(self, buffer: Buffer, example: Any) -> None: ...
    def lookup(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = None
    ) -> Any: ...
    def lookup_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> Any: ...

class Sink: ...

class Intake(Sink):
    def __init__(
        self,
        static: bool,
        most_kept: int,
        identify: Callable[[int, Callable[[int], bytes]], tuple[bytes, str]],
        on_expected: Callable[[], None],
    ) -> None: ...
    def feed(self, buffers: tuple[Buffer, ...]) -> None: ...
    def name(self, gid: bytes, name: str) -> None: ...
    def stored(self) -> int: ...
    def expect(self) -> None: ...
    def serve(self, gid_of: Callable[[int], bytes]) -> list[tuple[bytes, int, int]]: ...

class Outlet: ...

class JointRelay(Sink):
    def __init__(self, outlet: Any, most_kept: int) -> None: ...
    def serve(self, gid_of: Callable[[int], bytes]) -> list[tuple[bytes, int, int]]: ...
    def set_rules(self, interval: int, ignores_stamps: bool, tells_of_skipping: bool) -> None: ...
    def set_time(self, now: int | None) -> None: ...
    def add_layout(
        self,
        head: bytes,
        positions: int,
        end: int,
        frames: JointFrames,
        names: Sequence[str],
        moves: bool,
    ) -> None: ...
    def forget_layouts(self) -> None: ...
    def earliest(self, names: Sequence[str], now: int) -> int: ...
    def published(self, names: Sequence[str], stamp: int) -> None: ...
    def moved_back(self, now: int) -> bool: ...
    def clear(self) -> None: ...
    def relayed(self) -> int: ...

class Cyclone:
    def __init__(self, functions: Sequence[int], info: Sequence[int]) -> None: ...
    def take(self, reader: int, limit: int) -> list[tuple[bytes, int, int]]: ...

class CycloneWriter(Outlet):
    def __init__(self, library: Cyclone, writer: int, sertype: int) -> None: ...
    def write(self, cdr: AnyBuffer | tuple[AnyBuffer, ...]) -> int: ...
    def close(self) -> None: ...

class CycloneInlet:
    def __init__(self, library: Cyclone, guard: int, sink: Any) -> None: ...
    def listener(self) -> tuple[int, int]: ...

def print_on_abort(pipe: int) -> None: ...
