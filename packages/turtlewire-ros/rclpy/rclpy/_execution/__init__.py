"""How executors wait, decide what runs next, and run it; none of it is ROS 2's public surface.

========================  =============================================================
module                    what it holds
========================  =============================================================
`scheduler`, `pool`       finds and runs what is ready; the same with a pool of threads
`wait`, `timer_queue`     the one wait for wire and timers; timers by their due times
`entity`                  `Entity`, `EntityHost`: all that an entity knows of its executor
`running_callbacks`       threads that run callbacks, and which
`blocking`, `self_waits`  waiting for a response; warnings of deadlocks
`futures`                 callbacks of futures: called at once, or by an executor
`background_events`       TF messages, stored by other threads, as events
`exceptions`              reasons for which a wait ends without work
`handle`                  handles, where ROS 2 has objects of its C library
`asyncio_loop`            asyncio's loop, where one runs
========================  =============================================================
"""
