"""Topics with types in a YAML file, which a recorder subscribes to before they have a publisher."""

from __future__ import annotations

from turtlewire.bag.qos_yaml import load_yaml
from turtlewire.errors import BagError
from turtlewire.wire.names import validate_full_topic_name

_KEY = "static_topics_and_types_list"
_EXAMPLE = f"""
Such a file is, for example:
{_KEY}:
- [/chatter, std_msgs/msg/String]"""


def read_static_topics(path: str) -> dict[str, str]:
    """Return the types by topic.

    Raises:
        RuntimeError: The file cannot be read, or does not hold such a list.
    """
    try:
        with open(path, encoding="utf-8") as file:
            content = load_yaml(file.read(), path)
    except (BagError, OSError, UnicodeDecodeError) as error:
        raise RuntimeError(f"cannot read the topics in {path}: {error}") from error
    pairs = content.get(_KEY) if isinstance(content, dict) else None
    if not isinstance(pairs, list):
        raise RuntimeError(  # noqa: TRY004 - the file is wrong, not the call
            f"{path}: the key '{_KEY}' with a list is missing.{_EXAMPLE}"
        )
    found: dict[str, str] = {}
    for pair in pairs:
        words = [word for word in pair if isinstance(word, str)] if isinstance(pair, list) else []
        if len(words) != 2 or len(pair) != 2:
            raise RuntimeError(f"{path}: {pair!r} is not a topic and its type.{_EXAMPLE}")
        topic, type_name = words
        if fault := validate_full_topic_name(topic):
            raise RuntimeError(f"{path}: '{topic}' cannot be the name of a topic: {fault.message}")
        found[topic] = type_name
    return found
