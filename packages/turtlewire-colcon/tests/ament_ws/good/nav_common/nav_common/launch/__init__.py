from .prefixed import prefixed

__all__ = ["prefixed"]
