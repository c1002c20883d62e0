"""The in-process middleware: the same contract as the real one, without a wire.

All contexts of one process and one domain see each other. Messages are handed over inside
``publish``, so what was published before a ``take`` is there at the ``take``: tests need no
waiting.

===========================  ==========================================================
module                       what it holds
===========================  ==========================================================
`bus`                        nodes and endpoints of a domain, and which endpoints match
`context`                    a participant and its graph
`node`, `node_state`         a node; what it shares with its endpoints
`endpoint`                   what publishers and subscriptions have in common
`publisher`, `subscription`  the two kinds of endpoints
===========================  ==========================================================
"""
