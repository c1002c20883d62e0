"""Cyclone DDS through a thin ctypes layer.

``libddsc`` from the ``cyclonedds`` wheel, without the wheel's Python classes.

Every message is an opaque block of bytes to the middleware, as in rmw_cyclonedds. No Python
function is ever called from a thread of Cyclone's: data and changes of the graph are waited for in
C, without the GIL, and taken by Python threads.

A process must not fork after it opened a context (start children with ``spawn`` or ``subprocess``):
Cyclone's threads do not survive a fork.
"""
