"""The in-process middleware: the same contract as the real one, without a wire.

All contexts of one process and one domain see each other. ``publish`` delivers messages
before it returns, so a later ``take`` always finds them: tests need not wait.

===========================  ==========================================================
module                       contents
===========================  ==========================================================
`bus`                        nodes and endpoints of a domain, and which endpoints match
`context`                    a participant and its graph
`node`                       a node, and the state that it shares with its endpoints
`endpoint`                   publishers, subscriptions, and their common base
===========================  ==========================================================
"""
