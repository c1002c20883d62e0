"""The common base of entities, event handlers, contexts and the loop of a launch.

Nothing here imports a public module of `launch` except for events, so all of them can import it.
The parts refer to each other through :mod:`~launch._kernel.protocols`;
:class:`~launch._kernel.run.Run` is the state of one launch, which :class:`launch.LaunchContext`
shows to entities and :class:`launch.LaunchService` drives.
"""
