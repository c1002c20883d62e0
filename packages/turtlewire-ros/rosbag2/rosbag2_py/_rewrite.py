"""Converting bags as a YAML file asks."""

from __future__ import annotations

import contextlib
import sqlite3
from dataclasses import fields
from datetime import timedelta
from typing import TYPE_CHECKING, Any

from rosbag2_py._open_writer import make_writer
from rosbag2_py._recorder import compression_mode_of
from rosbag2_py._storage import StorageOptions
from rosbag2_transport.options import RecordOptions
from rosbag2_transport.qos_overrides import qos_profile
from rosbag2_transport.rewrite import Output, rewrite
from turtlewire.bag import open_bag
from turtlewire.bag.qos_yaml import load_yaml
from turtlewire.errors import BagError
from turtlewire.terminal.suggestion import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["bag_rewrite"]

_EXAMPLE = """
Such a file is, for example:
output_bags:
- uri: converted
  storage_id: mcap
  all_topics: true
  all_services: true"""

#: Words of the file that stand for others.
_ALIASES = {
    "exclude": "exclude_regex",
    "exclude_services": "exclude_service_events",
}


def _types(options: StorageOptions | RecordOptions) -> dict[str, type]:
    return {field.name: type(getattr(options, field.name)) for field in fields(options)}


#: The types of the values by key.
_STORAGE_KEYS, _RECORD_KEYS = _types(StorageOptions("")), _types(RecordOptions())
_KEYS = {"all", *_ALIASES, *_STORAGE_KEYS, *_RECORD_KEYS}


def bag_rewrite(input_options: Iterable[StorageOptions], output_config_file: str) -> None:
    """Write the messages of bags into others.

    Args:
        input_options: The bags to read.
        output_config_file: A YAML file whose key ``output_bags`` lists the bags to write, with the
            attributes of `StorageOptions` and `RecordOptions`.

    Raises:
        RuntimeError: The file cannot be read or asks for what is not known, or a bag cannot be read
            or written.
    """
    configurations = _read(output_config_file)
    try:
        with contextlib.ExitStack() as stack:
            bags = [stack.enter_context(open_bag(options.uri)) for options in input_options]
            outputs = []
            for options in configurations:
                outputs.append(_output(options))
                stack.callback(outputs[-1].writer.close)  # also if the next one cannot be made
            rewrite(bags, outputs)
    except BagError as error:
        raise RuntimeError(str(error)) from error
    except (OSError, sqlite3.Error) as error:
        raise RuntimeError(f"Converting stopped: {error}") from error


def _read(path: str) -> list[tuple[StorageOptions, RecordOptions]]:
    try:
        with open(path, encoding="utf-8") as file:
            content = load_yaml(file.read(), path)
    except OSError as error:
        raise RuntimeError(f"bad file: {path}") from error
    except BagError as error:
        raise RuntimeError(str(error)) from error
    outputs = content.get("output_bags") if isinstance(content, dict) else None
    if not isinstance(outputs, list):
        raise RuntimeError(  # noqa: TRY004 - the file is wrong, not the call
            f"{path}: the key 'output_bags' with a list is missing.{_EXAMPLE}"
        )
    return [_options(path, output) for output in outputs]


def _options(path: str, output: Any) -> tuple[StorageOptions, RecordOptions]:
    if not isinstance(output, dict) or "uri" not in output:
        raise RuntimeError(f"{path}: each bag needs the key 'uri'.{_EXAMPLE}")
    storage: dict[str, Any] = {}
    record: dict[str, Any] = {}
    for key, value in output.items():
        name = _ALIASES.get(key, key)
        if key == "all":
            record["all_topics"] = record["all_services"] = bool(value)
        elif name in _STORAGE_KEYS:
            storage[name] = _value(path, key, value, _STORAGE_KEYS[name])
        elif name in _RECORD_KEYS:
            record[name] = _record_value(path, key, name, value)
        else:
            hint = did_you_mean(str(key), _KEYS)
            text = f"{path}: unknown key '{key}'"
            raise RuntimeError(f"{text}\n{hint}" if hint else text)
    return StorageOptions(**storage), RecordOptions(**record)


def _record_value(path: str, key: str, name: str, value: Any) -> Any:
    if name == "topic_polling_interval":
        return _interval(path, value)
    if name == "topic_qos_profile_overrides":
        return {topic: qos_profile(topic, profile) for topic, profile in (value or {}).items()}
    value = _value(path, key, value, _RECORD_KEYS[name])
    if name in ("services", "exclude_service_events"):
        return [_event_topic(service) for service in value]
    return value


def _value(path: str, key: str, value: Any, kind: type) -> Any:
    """Return a value of the kind that the option has; one text stands for a list of it."""
    if value is None:
        return kind()
    if kind is list and isinstance(value, str):
        return [value]
    if type(value) is not kind:
        raise RuntimeError(f"{path}: {key} is of type {kind.__name__}, not {value!r}")
    return value


def _interval(path: str, value: Any) -> timedelta:
    """Milliseconds, or a dictionary with units."""
    parts = value if isinstance(value, dict) else {"milliseconds": value}
    factors = {"sec": 1000, "nsec": 1e-6, "milliseconds": 1}
    if not parts.keys() <= factors.keys() or any(type(part) is not int for part in parts.values()):
        raise RuntimeError(f"{path}: topic_polling_interval is a number of ms, not {value!r}")
    return timedelta(milliseconds=sum(factors[unit] * part for unit, part in parts.items()))


def _event_topic(service: str) -> str:
    ending = "/_service_event"
    return service if service.endswith(ending) else service + ending


def _output(options: tuple[StorageOptions, RecordOptions]) -> Output:
    storage, record = options
    writer = make_writer(storage, compression_mode_of(record))
    return Output(writer, record, storage.start_time_ns, storage.end_time_ns)
