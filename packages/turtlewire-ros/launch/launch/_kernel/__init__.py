"""What entities, event handlers, contexts and the loop of a launch have in common.

Nothing here imports a public module of `launch` except for events, so all of them can stand on it.
The parts know each other by :mod:`~launch._kernel.protocols`; :class:`~launch._kernel.run.Run` is
the state of one launch, which :class:`launch.LaunchContext` shows to entities and
:class:`launch.LaunchService` drives.
"""
