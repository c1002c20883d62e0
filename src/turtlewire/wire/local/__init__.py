"""The in-process middleware: the same contract as the real one, without a wire.

All contexts of one process and one domain see each other. Messages are handed over inside
``publish``, so what was published before a ``take`` is there at the ``take``: tests need no
waiting.
"""
