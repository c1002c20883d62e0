"""Writes a data set in the layout of LeRobot v3.0: Parquet files, and a video for each camera."""

from __future__ import annotations

import json
import shutil
import tempfile
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import av
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

if TYPE_CHECKING:
    from collections.abc import Iterable
    from types import TracebackType

    from aligned import Rows
    from typing_extensions import Self

CHUNK = 1000  # files in a folder
FILE = "chunk-{chunk_index:03d}/file-{file_index:03d}"
DATA_PATH = f"data/{FILE}.parquet"
VIDEO_PATH = f"videos/{{video_key}}/{FILE}.mp4"
SAMPLED = 10  # the statistics have every tenth image
COUNTERS = ("frame_index", "episode_index", "index", "task_index")


class DataSet:
    """A data set that appears in its folder when all episodes are written.

    Args:
        folder: The folder, which must not exist; the folder around it must.
        fps: Rows a second.
        robot: The name of the robot's type.

    Raises:
        FileExistsError: The folder exists.
        FileNotFoundError: The folder around it does not exist.
    """

    def __init__(self, folder: Path, fps: int, robot: str) -> None:
        if folder.exists():
            raise FileExistsError(f"{folder} exists already")
        if not folder.absolute().parent.is_dir():
            raise FileNotFoundError(f"the folder {folder.parent} does not exist")
        self._folder, self._fps, self._robot = folder, fps, robot
        self._temporary = Path(tempfile.mkdtemp(prefix=".", dir=folder.absolute().parent))
        self._work = self._temporary / folder.name
        self._features: dict[str, Any] = {}
        self._tasks: dict[str, int] = {}
        self._episodes: list[dict[str, Any]] = []
        self._numbers: dict[str, list[np.ndarray]] = {}
        self._frames = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        try:
            if kind is None:
                self._write_meta()
                self._work.rename(self._folder)
        finally:
            shutil.rmtree(self._temporary)

    def add_episode(self, rows: Rows, task: str, images: dict[str, Iterable[np.ndarray]]) -> None:
        """Write the rows of an episode, and its images.

        Args:
            rows: The rows.
            task: What the robot does, in words.
            images: The image of each row, for each camera: ``(height, width, 3)``.

        Raises:
            ValueError: The episode has other numbers or images than the first one.
        """
        count, number = len(rows.stamps_ns), len(self._episodes)
        place = {"chunk_index": number // CHUNK, "file_index": number % CHUNK}
        episode: dict[str, Any] = {"episode_index": number, "tasks": [task], "length": count}
        episode |= {f"data/{key}": value for key, value in place.items()}
        episode["dataset_from_index"] = self._frames
        episode["dataset_to_index"] = self._frames + count
        features = {
            "observation.state": _feature("float32", [len(rows.state_names)], rows.state_names),
            "action": _feature("float32", [len(rows.action_names)], rows.action_names),
        }
        for camera, frames in images.items():
            key = f"observation.images.{camera}"
            features[key] = self._write_video(key, place, frames)
            episode |= {f"videos/{key}/{each}": value for each, value in place.items()}
            episode[f"videos/{key}/from_timestamp"] = 0.0
            episode[f"videos/{key}/to_timestamp"] = count / self._fps
        if (self._features or features) != features:
            raise ValueError(f"episode {number} differs: {features}, not {self._features}")
        self._features = features
        self._write_rows(rows, place, number, self._tasks.setdefault(task, len(self._tasks)))
        self._episodes.append(episode)
        self._frames += count

    def _write_rows(self, rows: Rows, place: dict[str, int], episode: int, task: int) -> None:
        count = len(rows.stamps_ns)
        steps = np.arange(count)
        columns = {
            "observation.state": rows.state.astype(np.float32),
            "action": rows.action.astype(np.float32),
            "timestamp": (steps / self._fps).astype(np.float32),
            "frame_index": steps,
            "episode_index": np.full(count, episode),
            "index": self._frames + steps,
            "task_index": np.full(count, task),
        }
        for name, column in columns.items():
            self._numbers.setdefault(name, []).append(column.reshape(count, -1))
        path = self._file(DATA_PATH.format(**place))
        pq.write_table(pa.table({name: _array(column) for name, column in columns.items()}), path)

    def _write_video(
        self, key: str, place: dict[str, int], frames: Iterable[np.ndarray]
    ) -> dict[str, Any]:
        path = self._file(VIDEO_PATH.format(video_key=key, **place))
        shape = (0, 0)
        with av.open(path, "w") as file:
            # Every second frame is whole, so that training finds any frame quickly.
            stream = file.add_stream("libx264", rate=self._fps, options={"g": "2", "crf": "18"})
            stream.pix_fmt = "yuv420p"
            for number, pixels in enumerate(frames):
                # Videos have an even number of rows and columns.
                even = pixels[: pixels.shape[0] // 2 * 2, : pixels.shape[1] // 2 * 2]
                if number == 0:
                    shape = stream.height, stream.width = even.shape[:2]
                elif even.shape[:2] != shape:
                    raise ValueError(f"{key} has images of the sizes {shape} and {even.shape[:2]}")
                frame = av.VideoFrame.from_ndarray(np.ascontiguousarray(even), format="rgb24")
                frame.pts, frame.time_base = number, Fraction(1, self._fps)
                file.mux(stream.encode(frame))
                if number % SAMPLED == 0:
                    sample = even[::4, ::4].reshape(-1, 3) / 255
                    self._numbers.setdefault(key, []).append(sample.astype(np.float32))
            file.mux(stream.encode())
        return _video_feature(*shape, self._fps)

    def _file(self, name: str) -> Path:
        path = self._work / name
        path.parent.mkdir(parents=True, exist_ok=True)
        return path

    def _write_meta(self) -> None:
        counters = {name: _feature("int64", [1], None) for name in COUNTERS}
        time = {"timestamp": _feature("float32", [1], None)}
        count = len(self._episodes)
        info = {
            "codebase_version": "v3.0",
            "robot_type": self._robot,
            "total_episodes": count,
            "total_frames": self._frames,
            "total_tasks": len(self._tasks),
            "chunks_size": CHUNK,
            "fps": self._fps,
            "splits": {"train": f"0:{count}"},
            "data_path": DATA_PATH,
            "video_path": VIDEO_PATH,
            "features": {**self._features, **time, **counters},
        }
        statistics = {
            name: _statistics(np.concatenate(parts), is_image=".images." in name)
            for name, parts in self._numbers.items()
        }
        for name, content in (("info", info), ("stats", statistics)):
            self._file(f"meta/{name}.json").write_text(json.dumps(content, indent=4))
        path = self._file(f"meta/episodes/{FILE}.parquet".format(chunk_index=0, file_index=0))
        pq.write_table(pa.Table.from_pylist(self._episodes), path)
        pq.write_table(_task_table(self._tasks), self._file("meta/tasks.parquet"))


def _feature(dtype: str, shape: list[int], names: list[str] | None) -> dict[str, Any]:
    return {"dtype": dtype, "shape": shape, "names": names}


def _video_feature(height: int, width: int, fps: int) -> dict[str, Any]:
    video = {
        "video.height": height,
        "video.width": width,
        "video.codec": "h264",
        "video.pix_fmt": "yuv420p",
        "video.is_depth_map": False,
        "video.fps": fps,
        "video.channels": 3,
        "has_audio": False,
    }
    axes = ["height", "width", "channels"]
    return {**_feature("video", [height, width, 3], axes), "info": video}


def _array(column: np.ndarray) -> pa.Array:
    """Return a column: numbers, or lists of one length."""
    if column.ndim == 1 or column.shape[1] == 1:
        return pa.array(column.ravel())
    return pa.FixedSizeListArray.from_arrays(pa.array(column.ravel()), column.shape[1])


def _statistics(values: np.ndarray, *, is_image: bool) -> dict[str, Any]:
    """Return the statistics that normalize a feature; images have them for each channel."""
    shape = (3, 1, 1) if is_image else (-1,)
    found = {name: getattr(values, name)(axis=0) for name in ("min", "max", "mean", "std")}
    return {
        **{name: numbers.reshape(shape).tolist() for name, numbers in found.items()},
        "count": [len(values)],
    }


def _task_table(tasks: dict[str, int]) -> pa.Table:
    """Return the table of the tasks; pandas, with which LeRobot reads it, finds them by name."""
    table = pa.table({"task_index": list(tasks.values()), "task": list(tasks)})
    columns = [
        {"name": name, "field_name": name, "pandas_type": kind, "numpy_type": kind}
        for name, kind in (("task_index", "int64"), ("task", "object"))
    ]
    index = {"index_columns": ["task"], "column_indexes": [], "columns": columns}
    return table.replace_schema_metadata({"pandas": json.dumps(index)})
