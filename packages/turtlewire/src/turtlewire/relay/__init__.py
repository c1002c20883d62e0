"""Carries topics, services and actions between two networks: ``turtlewire relay``.

================  =================================================================
module            contents
================  =================================================================
`ends`            parses the networks that the command line names
`renaming`        converts names and frames between the two ends
`marks`           marks the nodes of relays, so that nothing is carried twice
`side`            one end: its context, its nodes and the thread that takes messages
`direction`       opens and closes routes from one end to the other
`topic_route`     one topic
`service_route`   one service
`relay`           `Relay`, which follows the changes at both ends
================  =================================================================
"""
