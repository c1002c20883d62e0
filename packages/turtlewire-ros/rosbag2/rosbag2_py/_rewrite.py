"""Converting bags as a YAML file asks."""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Iterable
from dataclasses import fields
from datetime import timedelta
from typing import Any

from rosbag2_py._recorder import compression_mode_of
from rosbag2_py._storage import StorageOptions
from rosbag2_py._writer import make_writer
from rosbag2_transport.options import RecordOptions
from rosbag2_transport.qos_overrides import qos_profile
from rosbag2_transport.rewrite import Output, rewrite
from turtlewire.bag import open_bag
from turtlewire.bag.qos_yaml import load_yaml
from turtlewire.distro import KILTED, since
from turtlewire.errors import BagError
from turtlewire.terminal.suggestion import did_you_mean

_EXAMPLES = {
    "input_bags": """
Such a file is, for example:
input_bags:
- uri: recorded""",
    "output_bags": """
Such a file is, for example:
output_bags:
- uri: converted
  storage_id: mcap
  all_topics: true
  all_services: true""",
}

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
            or written. Topics that are not in CDR are left out; the error names them at the end.
    """
    configurations = [
        _options(output_config_file, output) for output in _read(output_config_file, "output_bags")
    ]
    try:
        with contextlib.ExitStack() as stack:
            bags = [stack.enter_context(open_bag(options.uri)) for options in input_options]
            left_out = rewrite(bags, _outputs(configurations))
    except BagError as error:
        raise RuntimeError(str(error)) from error
    except OSError as error:
        raise RuntimeError(f"Converting stopped: {error}") from error
    if left_out:
        raise RuntimeError(" ".join(left_out))


def input_bags(path: str) -> list[StorageOptions]:
    """Return the bags that a YAML file lists under ``input_bags``.

    Raises:
        RuntimeError: The file cannot be read, or asks for what is not known.
    """
    found = []
    for bag in _read(path, "input_bags"):
        values: dict[str, Any] = {}
        for key, value in bag.items():
            if key not in _STORAGE_KEYS:
                raise _unknown(path, key, _STORAGE_KEYS)
            values[key] = _value(path, key, value, _STORAGE_KEYS[key])
        found.append(StorageOptions(**values))
    return found


def _read(path: str, key: str) -> list[dict[str, Any]]:
    """Return the bags that a file lists under a key."""
    try:
        with open(path, encoding="utf-8") as file:
            content = load_yaml(file.read(), path)
    except OSError as error:
        raise RuntimeError(f"bad file: {path}") from error
    except BagError as error:
        raise RuntimeError(str(error)) from error
    bags = content.get(key) if isinstance(content, dict) else None
    if not isinstance(bags, list):
        raise RuntimeError(  # noqa: TRY004 - the file is wrong, not the call
            f"{path}: the key '{key}' with a list is missing.{_EXAMPLES[key]}"
        )
    for bag in bags:
        if not isinstance(bag, dict) or "uri" not in bag:
            raise RuntimeError(f"{path}: each bag needs the key 'uri'.{_EXAMPLES[key]}")
    return bags


def _unknown(path: str, key: object, known: Iterable[str]) -> RuntimeError:
    hint = did_you_mean(str(key), known)
    text = f"{path}: unknown key '{key}'"
    return RuntimeError(f"{text}\n{hint}" if hint else text)


def _options(path: str, output: dict[str, Any]) -> tuple[StorageOptions, RecordOptions]:
    storage: dict[str, Any] = {}
    record: dict[str, Any] = {}
    for key, value in output.items():
        name = _ALIASES.get(key, key)
        if key == "all":
            record["all_topics"] = record["all_services"] = bool(value)
            record["all_actions"] = bool(value) and since(KILTED)
        elif name in _STORAGE_KEYS:
            storage[name] = _value(path, key, value, _STORAGE_KEYS[name])
        elif name in _RECORD_KEYS:
            record[name] = _record_value(path, key, name, value)
        else:
            raise _unknown(path, key, _KEYS)
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
    """Return a value of the kind that the option has; a single text becomes a list."""
    if value is None:
        return kind()
    if kind is list and isinstance(value, str):
        return [value]
    # Not `isinstance`, because `true` must not count as 1.
    if type(value) is not kind:
        raise RuntimeError(f"{path}: {key} is of type {kind.__name__}, not {value!r}")
    return value


def _interval(path: str, value: Any) -> timedelta:
    """Return an interval that is given in milliseconds, or as a dictionary with units."""
    parts = value if isinstance(value, dict) else {"milliseconds": value}
    factors = {"sec": 1000, "nsec": 1e-6, "milliseconds": 1}
    if not parts.keys() <= factors.keys() or any(type(part) is not int for part in parts.values()):
        raise RuntimeError(f"{path}: topic_polling_interval is a number of ms, not {value!r}")
    return timedelta(milliseconds=sum(factors[unit] * part for unit, part in parts.items()))


def _event_topic(service: str) -> str:
    ending = "/_service_event"
    return service if service.endswith(ending) else service + ending


def _outputs(configurations: list[tuple[StorageOptions, RecordOptions]]) -> list[Output]:
    """Open the bags to write; none is left if one of them cannot be made."""
    outputs: list[Output] = []
    try:
        for storage, record in configurations:
            writer = make_writer(storage, compression_mode_of(record))
            outputs.append(Output(writer, record, storage.start_time_ns, storage.end_time_ns))
    except BaseException:
        for output in outputs:
            output.writer.close()
            shutil.rmtree(output.writer.path)
        raise
    return outputs
