"""Zenoh: the protocol of rmw_zenoh_cpp (ROS 2 Jazzy and later) on PyPI's ``eclipse-zenoh``.

Messages are CDR with an attachment of 33 bytes. The graph consists of liveliness tokens, whose text
describes a node or an endpoint. Endpoints match by their key alone, so all endpoints of one topic
and type match, whatever their QoS.

Each subscription and publisher and the graph have a thread, made by the library, which waits
without the GIL and only queues; a subscription with a native sink (TF) has a channel and one of our
threads, which passes the messages of the channel to the sink in batches. Requests and responses are
rare and are queued on Zenoh's receiving threads. The context's reader thread calls the callbacks.

===========================  ==================================================================
module                       contents
===========================  ==================================================================
`protocol`                   `Token`: a node or an endpoint in the graph, with its QoS; the
                             attachment of a message, 33 bytes
`configuration`              the configuration of sessions and routers, ``ZENOH_*``, shared memory
`library`                    the import of ``eclipse-zenoh``
`context`                    a participant and its nodes
`callback_threads`           the threads of callbacks; counts the calls into Zenoh's library
`context_state`              the state that a context shares with nodes and endpoints
`graph`                      nodes and endpoints, from the tokens
`endpoint`                   the common base of all endpoints
`publisher`                  publishers
`inlet`                      subscriptions, also those whose messages go to a native sink
`services`                   clients and servers
`router`                     ``rmw_zenohd``, its messages about rejected peers, the wait for it
`diagnosis`                  explains why a session cannot be opened
===========================  ==================================================================
"""
