"""The in-process middleware: the same contract as the real one, without a wire.

All contexts of one process and one domain see each other. ``publish`` delivers messages
before it returns, so a later ``take`` always finds them: tests need not wait.

===========================  ==========================================================
module                       contents
===========================  ==========================================================
`bus`                        endpoints, nodes and contexts of a domain; which endpoints match
`context`                    a participant and its graph; nodes, publishers, subscriptions
===========================  ==========================================================
"""
