"""Extensions by which other packages change how `Node` starts nodes.

A package adds one by an entry point in the group ``launch_ros.node_action``.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.utilities.plugin_support import PluginException, satisfies_version
from turtlewire.plugins import declared

if TYPE_CHECKING:
    import logging

    from launch.launch_context import LaunchContext
    from turtlewire.plugins import Entry

_GROUP = "launch_ros.node_action"


class NodeActionExtension:
    """Base of the extensions.

    Attributes:
        NAME: Name of the entry point; set by `get_extensions`.
        EXTENSION_POINT_VERSION: Version of this interface.

    Raises:
        PluginException: A subclass is for another version.
    """

    NAME: str | None = None
    EXTENSION_POINT_VERSION = "0.1"

    def __init__(self) -> None:
        satisfies_version(self.EXTENSION_POINT_VERSION, "^0.1")

    def prepare_for_execute(
        self, context: LaunchContext, ros_specific_arguments: dict[str, Any], node_action: Any
    ) -> tuple[list[Any], dict[str, Any]]:
        """Return words to append to the command line, and the names of the node.

        It is called before each start of a node.

        Args:
            context: The launch.
            ros_specific_arguments: The rules for the node's name and namespace, for example
                ``{"name": "__node:=talker", "ns": "__ns:=/robot"}``.
            node_action: The `Node`.
        """
        del context, node_action
        return [], ros_specific_arguments


def get_extensions(logger: logging.Logger) -> dict[str, Any]:
    """Return an instance of each installed extension, by name.

    Args:
        logger: Warns of an extension that cannot be loaded or made; it is left out.
    """
    extensions: dict[str, Any] = {}
    for name, entry in _entries().items():
        try:
            cls = entry.load()
        # Another's module may fail in any way; nodes start without it.
        except Exception as error:  # noqa: BLE001
            logger.warning("Failed to load entry point '%s': %s", name, error)
            continue
        extension = instantiate_extension(_GROUP, name, cls, extensions, logger)
        if extension is not None:
            extension.NAME = name
    return extensions


def instantiate_extension(
    group_name: str,
    extension_name: str,
    extension_class: Any,
    extensions: dict[str, Any],
    logger: logging.Logger,
    *,
    unique_instance: bool = False,
) -> Any:
    """Return an instance of an extension, or None if it cannot be made.

    Args:
        group_name: The group of entry points, for the log.
        extension_name: Name of the entry point.
        extension_class: The class.
        extensions: The instances that were made already; gets the new one.
        logger: Tells why it cannot be made.
        unique_instance: Whether to make a new instance which ``extensions`` does not get.
    """
    if not unique_instance and extension_name in extensions:
        return extensions[extension_name]
    failed = "Failed to instantiate '%s' extension '%s': %s"
    try:
        extension = extension_class()
    except PluginException as error:
        logger.warning(failed, group_name, extension_name, error)
        return None
    # Another's constructor may fail in any way; nodes start without it.
    except Exception as error:  # noqa: BLE001
        logger.error(failed, group_name, extension_name, error)  # noqa: TRY400  one line, as in ROS 2
        return None
    if not unique_instance:
        extensions[extension_name] = extension
    return extension


def prepared_by(
    extensions: dict[str, Any], context: LaunchContext, names: dict[str, Any], node_action: Any
) -> tuple[list[str], dict[str, Any]]:
    """Ask the extensions one after the other; return all their words, and the names at the end."""
    words: list[str] = []
    for extension in extensions.values():
        added, names = extension.prepare_for_execute(context, names, node_action)
        words += [
            perform_substitutions(context, normalize_to_list_of_substitutions(word))
            for word in added
        ]
    return words, names


@functools.cache
def _entries() -> dict[str, Entry]:
    # Once for all nodes of a launch: it reads a file of each installed package.
    return declared(_GROUP)
