"""Zenoh: the protocol of rmw_zenoh_cpp (ROS 2 Jazzy and later) on PyPI's ``eclipse-zenoh``.

Messages travel as CDR with 33 bytes beside them; the graph is made of liveliness tokens, whose text
says everything about a node or an endpoint. Nothing here is asked for by an endpoint but its key,
so all endpoints of one topic and type match, whatever their QoS.

Each subscription and publisher and the graph have a thread, made by the library, which waits
without the GIL and only queues; a subscription with a native sink (TF) has a channel and a thread
of ours, which empties the channel into the sink in batches. Requests and responses are rare and are
queued on Zenoh's receiving threads. The context's reader thread calls the callbacks.

===========================  ==================================================================
module                       what it holds
===========================  ==================================================================
`qos_text`                   a QoS as a token spells it
`token`                      `Token`: a node or an endpoint in the graph, its key and its gid
`attachment`                 the 33 bytes beside a message
`configuration`              the configuration of sessions and routers, and ``ZENOH_*`` variables
`library`                    the import of ``eclipse-zenoh``
`context`                    a participant
`calls`                      who is in Zenoh's library
`callback_threads`           the threads of callbacks
`context_state`              what a context shares with its nodes and endpoints
`graph`                      nodes and endpoints, from the tokens
`node`                       nodes
`endpoint`                   what all endpoints have in common
`publisher`, `subscription`  the ends of a topic
`inlet`                      subscriptions whose messages go to a native sink
`services`                   clients and servers
`router`, `router_log`       ``rmw_zenohd``, and what it says of peers that it refuses
`diagnosis`                  why a session cannot be opened
===========================  ==================================================================
"""
