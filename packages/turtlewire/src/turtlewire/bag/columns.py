"""Fields of all messages of a topic as NumPy arrays."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from turtlewire.bag.column_fields import (
    ColumnField,
    ColumnKind,
    column_steps,
    find_field,
    read_texts,
)
from turtlewire.bag.message import UndecodableType
from turtlewire.bag.metadata import is_cdr, is_decodable
from turtlewire.bag.sensor_arrays import cloud_array, cloud_dtype, image_array, read_point_fields
from turtlewire.bag.written_types import written_type
from turtlewire.errors import BagError
from turtlewire.msg.evolution import older_evolution
from turtlewire.msg.registry import load_message
from turtlewire.msg.types import NamespacedType
from turtlewire.platforms import asked_core
from turtlewire.terminal.suggestion import did_you_mean

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire.bag.message import BagChannel, BagMessage
    from turtlewire.bag.metadata import BagMetadata, TopicInfo
    from turtlewire.bag.record_messages import LoggedBytes, RawMessage
    from turtlewire.bag.storage import StorageFile

__all__ = ["Columns", "read_columns"]

_HEADER_STAMP = "header.stamp"

#: The fields that say how the bytes of a sensor's `data` are arranged.
_LAYOUTS = {
    "sensor_msgs/msg/Image": ("height", "width", "step", "encoding", "is_bigendian"),
    "sensor_msgs/msg/PointCloud2": (
        "height",
        "width",
        "row_step",
        "point_step",
        "is_bigendian",
        "fields",
    ),
}


class _Bag(Protocol):
    """The part of `turtlewire.bag.reader.Bag` that is used here."""

    metadata: BagMetadata

    @property
    def topics(self) -> dict[str, TopicInfo]: ...
    def readable_files(self, paths: list[str], damage: list[BagError]) -> list[StorageFile]: ...
    def messages(self, topics: str, *, start_ns: int, end_ns: int) -> Iterator[BagMessage]: ...


class Columns(Mapping[str, "NDArray[Any]"]):
    """Fields of the messages of a topic, one array each, in order of the messages' log time.

    A mapping from the names of the fields to their arrays. `Bag.columns` makes it.

    Attributes:
        topic: The topic.
        type: The type of its messages.
        log_times_ns: When each message was recorded, nanoseconds, shape ``(N,)``.
        stamps_ns: The stamp in the header of each message, nanoseconds; the log times if the type
            has no header.
    """

    def __init__(
        self,
        topic: str,
        type_name: str,
        log_times_ns: NDArray[np.int64],
        stamps_ns: NDArray[np.int64],
        arrays: dict[str, NDArray[Any]],
        labels: dict[str, tuple[str, ...]],
    ) -> None:
        self.topic = topic
        self.type = type_name
        self.log_times_ns = log_times_ns
        self.stamps_ns = stamps_ns
        self._arrays = arrays
        self._labels = labels

    def __getitem__(self, field: str) -> NDArray[Any]:
        try:
            return self._arrays[field]
        except KeyError:
            near = did_you_mean(field, self._arrays)
            has = near or f"The columns are {', '.join(self._arrays)}"
            raise KeyError(f"'{field}' was not read from {self.topic}. {has}.") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def __repr__(self) -> str:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in self._arrays.items())
        return f"<Columns of {self.topic}, {self.type}: {shapes}>"

    def to_pandas(self) -> Any:
        """Return a pandas ``DataFrame``: index UTC time of the stamps, a column for each number.

        The numbers of a message become ``linear_acceleration.x``, the numbers of an array
        ``covariance[0]``. Texts, and arrays whose length differs, are objects.

        Raises:
            ImportError: pandas is not installed.
        """
        import pandas as pd

        columns: dict[str, NDArray[Any]] = {}
        for name, array in self._arrays.items():
            if array.ndim == 1:
                columns[name] = array
            else:
                labels = self._labels[name]
                columns |= {f"{name}{label}": array[:, k] for k, label in enumerate(labels)}
        index = pd.to_datetime(self.stamps_ns, unit="ns", utc=True)
        return pd.DataFrame(columns, index=index)


def read_columns(
    bag: _Bag, topic: str, paths: tuple[str, ...], start_ns: int, end_ns: int
) -> Columns:
    """Read fields of a topic's messages; see `Bag.columns`."""
    known = bag.topics[topic]
    type_name = known.type
    if not is_decodable(known):
        UndecodableType(topic, type_name, known.serialization_format).decode(b"")
    if not paths:
        names = ", ".join(field.name for field in load_message(type_name).fields)
        raise ValueError(f"name at least one field of {topic}; {type_name} has {names or 'none'}")
    wanted = dict.fromkeys(paths)
    if _has_header(type_name):
        wanted[_HEADER_STAMP] = None
    layout = _LAYOUTS.get(type_name, ()) if "data" in wanted else ()
    fields = [find_field(type_name, path) for path in (wanted | dict.fromkeys(layout))]
    found = _read_natively(bag, topic, fields, start_ns, end_ns)
    if found is None:
        found = _read_one_by_one(bag, topic, fields, start_ns, end_ns)
    log_times, arrays = found
    if layout:
        arrays["data"] = _sensor_data(type_name, arrays)
    stamps = arrays.get(_HEADER_STAMP, log_times) if _has_header(type_name) else log_times
    labels = {field.path: field.labels for field in fields}
    return Columns(
        topic, type_name, log_times, stamps, {path: arrays[path] for path in paths}, labels
    )


def _has_header(type_name: str) -> bool:
    fields = load_message(type_name).fields
    header = NamespacedType.parse("std_msgs/msg/Header")
    return any(field.name == "header" and field.type == header for field in fields)


# -- by the compiled core


def _read_natively(
    bag: _Bag, topic: str, fields: list[ColumnField], start_ns: int, end_ns: int
) -> tuple[NDArray[np.int64], dict[str, NDArray[Any]]] | None:
    """Return log times and columns; None if the messages must be decoded one by one."""
    steps = column_steps(bag.topics[topic].type, fields)
    reader_type = _native_reader()
    if steps is None or reader_type is None or bag.metadata.compression_mode == "MESSAGE":
        return None
    type_name = bag.topics[topic].type
    collector = _Collector(reader_type(steps, len(fields)), fields)
    damage: list[BagError] = []
    for file in bag.readable_files(bag.metadata.paths, damage):
        channels = [channel for channel in file.channels() if channel.topic.name == topic]
        if not all(_has_our_fields(each, type_name) for each in channels):
            return None
        for block in file.unordered_blocks(
            lambda each: each.name == topic, start_ns, end_ns, damage.append
        ):
            if not collector.take(block):
                return None
    if damage:
        raise damage[0]
    try:
        return collector.finished()
    except UnicodeDecodeError:  # decoding the messages says which field it is
        return None


def _native_reader() -> Any:
    if asked_core() == "python":
        return None
    try:
        from turtlewire._native import ColumnReader
    except ImportError:
        return None
    return ColumnReader


def _has_our_fields(channel: BagChannel, type_name: str) -> bool:
    """Return True if the messages of a channel surely have the fields that ours have."""
    topic, schema = channel.topic, channel.schema
    if not is_cdr(topic) or topic.type != type_name:
        return False
    if not schema.data:
        return older_evolution(topic.type) is None
    text = schema.data.decode("utf-8", "replace")
    return written_type(topic.type, schema.encoding, text).evolution is None


class _Collector:
    """Collects the fields of blocks of messages."""

    def __init__(self, reader: Any, fields: list[ColumnField]) -> None:
        self._reader = reader
        self._fields = fields
        self._keeps_messages = any(_is_view(field) for field in fields)
        self._messages: list[bytes] = []

    def take(self, block: list[RawMessage] | list[LoggedBytes]) -> bool:
        if self._keeps_messages:
            self._messages += [message[-1] for message in block]
        try:
            taken: bool = self._reader.take(block)
        except OverflowError:
            raise _log_time_error() from None
        return taken

    def finished(self) -> tuple[NDArray[np.int64], dict[str, NDArray[Any]]]:
        """Return log times and columns in order of the log times."""
        log_times = np.frombuffer(bytearray(self._reader.log_times), np.int64)
        columns = [
            _column(field, content, self._messages)
            for field, content in zip(self._fields, self._reader.columns, strict=True)
        ]
        if np.any(log_times[1:] < log_times[:-1]):
            order = np.argsort(log_times, kind="stable")
            log_times, columns = log_times[order], [column[order] for column in columns]
        names = [field.path for field in self._fields]
        return log_times, dict(zip(names, columns, strict=True))


def _is_view(field: ColumnField) -> bool:
    return field.kind not in (ColumnKind.NUMBERS, ColumnKind.TIME)


def _dtype(field: ColumnField) -> np.dtype[Any]:
    return np.dtype("u1" if field.code == "c" else f"<{field.code}")


def _column(field: ColumnField, content: bytes, messages: list[bytes]) -> NDArray[Any]:
    if field.kind == ColumnKind.TIME:
        times = np.frombuffer(content, [("sec", "<i4"), ("nanosec", "<u4")])
        stamps: NDArray[np.int64] = times["sec"].astype(np.int64) * 1_000_000_000
        stamps += times["nanosec"]
        return stamps
    if field.kind == ColumnKind.NUMBERS:
        numbers = np.frombuffer(bytearray(content), _dtype(field))
        return numbers.reshape(-1, len(field.labels)) if field.labels else numbers
    places = np.frombuffer(content, "<u8").reshape(-1, 2).tolist()
    view = _viewer(field)
    values = [view(data, *at) for data, at in zip(messages, places, strict=True)]
    return _objects(values, len(messages))


def _viewer(field: ColumnField) -> Callable[[bytes, int, int], Any]:
    """Return the function that makes a value of where it begins in a message, and its length."""
    if field.kind == ColumnKind.TEXT:
        return lambda data, begin, count: data[begin : begin + count].decode()
    if field.kind == ColumnKind.CLOUD_FIELDS:
        return lambda data, begin, count: data[begin : begin + count]
    if field.kind == ColumnKind.TEXTS:
        return lambda data, begin, count: list(read_texts(data[begin : begin + count]))
    dtype, width = _dtype(field), len(field.labels)
    if not width:
        return lambda data, begin, count: np.frombuffer(data, dtype, count, begin if count else 0)

    def rows(data: bytes, begin: int, count: int) -> Any:
        numbers = np.frombuffer(data, dtype, count * width, begin if count else 0)
        return numbers.reshape(count, width)

    return rows


def _objects(values: Any, count: int) -> NDArray[Any]:
    """Return an array of objects; NumPy would make a matrix if they have the same shape."""
    array = np.empty(count, object)
    for number, value in enumerate(values):
        array[number] = value
    return array


# -- from message objects


def _read_one_by_one(
    bag: _Bag, topic: str, fields: list[ColumnField], start_ns: int, end_ns: int
) -> tuple[NDArray[np.int64], dict[str, NDArray[Any]]]:
    type_name = bag.topics[topic].type
    log_times: list[int] = []
    columns: list[list[Any]] = [[] for _ in fields]
    readers = [
        (column.append, *_reader(field)) for column, field in zip(columns, fields, strict=True)
    ]
    for message in bag.messages(topic, start_ns=start_ns, end_ns=end_ns):
        if message.type != type_name:
            raise BagError(f"{topic} has messages of two types, {type_name} and {message.type}")
        decoded = message.decode()
        log_times.append(message.log_time_ns)
        for append, get, convert in readers:
            append(convert(get(decoded)))
    arrays = {
        field.path: _array(field, values) for field, values in zip(fields, columns, strict=True)
    }
    return _int64(log_times), arrays


def _int64(log_times: list[int]) -> NDArray[np.int64]:
    try:
        return np.array(log_times, np.int64)
    except OverflowError:
        raise _log_time_error() from None


def _log_time_error() -> BagError:
    return BagError("a log time does not fit into 64 bits with a sign")


def _reader(field: ColumnField) -> tuple[Any, Any]:
    """Return the functions that get a field of a message and make it a value of its column."""
    get = attrgetter(field.path)
    names = [label[1:] for label in field.labels if label.startswith(".")]
    if field.kind == ColumnKind.TIME:
        return get, lambda time: time.sec * 1_000_000_000 + time.nanosec
    if field.kind == ColumnKind.CLOUD_FIELDS:
        return get, lambda fields: [(f.name, f.offset, f.datatype, f.count) for f in fields]
    if field.kind in (ColumnKind.TEXT, ColumnKind.TEXTS):
        return get, lambda value: value
    numbers_of = _numbers_of(field, names)
    if field.kind == ColumnKind.NUMBERS:
        return get, numbers_of
    dtype, shape = _dtype(field), (-1, len(names)) if names else (-1,)

    def read_only(values: Any) -> NDArray[Any]:
        array = np.array([numbers_of(value) for value in values], dtype).reshape(shape)
        array.flags.writeable = False  # as the views of the compiled core are
        return array

    return get, read_only


def _numbers_of(field: ColumnField, names: list[str]) -> Any:
    if names:
        parts = [attrgetter(name) for name in names]
        return lambda message: [_number(part(message)) for part in parts]
    if field.labels:
        return lambda values: [_number(value) for value in values]
    return _number


def _number(value: Any) -> Any:
    return value[0] if isinstance(value, bytes) else value  # a `byte` of ROS 2


def _array(field: ColumnField, values: list[Any]) -> NDArray[Any]:
    if _is_view(field):
        return _objects(values, len(values))
    if field.kind == ColumnKind.TIME:
        return np.array(values, np.int64)
    shape = (len(values), len(field.labels)) if field.labels else (len(values),)
    return np.array(values, _dtype(field)).reshape(shape)


# -- images and point clouds


def _sensor_data(type_name: str, arrays: dict[str, NDArray[Any]]) -> NDArray[Any]:
    """Return the data of images or clouds as arrays of pixels or points."""
    rows = zip(arrays["data"], *(arrays[name] for name in _LAYOUTS[type_name]), strict=True)
    count = len(arrays["data"])
    if type_name == "sensor_msgs/msg/Image":
        return _objects((_image(*row) for row in rows), count)
    return _objects(_clouds(rows), count)


def _image(
    data: NDArray[np.uint8], height: int, width: int, step: int, encoding: str, is_bigendian: int
) -> NDArray[Any]:
    order = "<>"[bool(is_bigendian)]
    return image_array(data, int(height), int(width), int(step), encoding, order)


def _clouds(rows: Any) -> Iterator[NDArray[Any]]:
    known: dict[Any, np.dtype[Any] | None] = {}
    for data, height, width, row_step, point_step, is_bigendian, fields in rows:
        key = (fields if isinstance(fields, bytes) else tuple(fields), point_step, is_bigendian)
        if key not in known:
            layout = read_point_fields(fields) if isinstance(fields, bytes) else fields
            known[key] = cloud_dtype(layout, int(point_step), "<>"[bool(is_bigendian)])
        yield cloud_array(data, int(height), int(width), int(row_step), known[key])
