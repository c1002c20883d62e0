"""The msg interfaces of rmw_dds_common: classes made at first access."""

from turtlewire.msg import lazy_classes

__all__ = [
    "Gid",
    "NodeEntitiesInfo",
    "ParticipantEntitiesInfo",
]

__getattr__ = lazy_classes(__name__)


def __dir__() -> list[str]:
    return __all__
