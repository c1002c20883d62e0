"""Private parts of executors: waiting, choosing what runs next, and running it.

========================  =============================================================
module                    contents
========================  =============================================================
`scheduler`, `pool`       finds and runs ready callbacks; a variant with a thread pool
`wait`, `timer_queue`     the one wait for wire and timers; timers by their due times
`entity`                  `Entity`; `EntityHost`, an entity's view of its executor
`served_entities`         the entities that an executor serves
`membership`              the entities of a node in an executor
`running_callbacks`       the callbacks that each thread is running
`blocking`                waiting for a response; warnings of deadlocks
`background_events`       TF messages, stored by other threads, as events
`exceptions`              reasons for which a wait ends without work
`handle`                  stand-ins for the objects of ROS 2's C library
`asyncio_loop`            asyncio's loop, where one runs
========================  =============================================================
"""
