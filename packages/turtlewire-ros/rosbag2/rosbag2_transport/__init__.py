"""Recording topics into bags and playing them: what ``ros2 bag`` and rosbag2_py do.

Messages travel as bytes between the wire and the bag; no message object is made.

=====================  ==========================================================
module                 what it holds
=====================  ==========================================================
`options`              `RecordOptions`, `PlayOptions`
`record`               `ros2 bag record` from beginning to end, and its keys
`play`                 `ros2 bag play` from beginning to end, and its keys
`recorder`             `Recorder`: subscribes, takes, pauses
`recorder_services`    its services and its topic
`recorder_notices`     what was asked for and is not there
`recorder_qos`         which QoS receives from all publishers of a topic
`topic_filter`         which topics are recorded or converted
`action_topics`        which topics belong to an action
`static_topics`        topics that are recorded from the start
`player`               `Player`: time, order, and what pauses, seeks or ends it
`played_bags`          the bags, as if they were one
`player_outputs`       its publishers
`player_requests`      recorded requests, sent to services again
`player_qos`           with which QoS it publishes
`player_clock`         ``/clock``
`player_services`      its services and its topic
`play_filter`          which topics are played
`latched`              latched messages wherever a playback begins
`rewrite`              bags into bags
`qos_overrides`        QoS profiles from a file
`session`              what both share: context, node, terminal, signals
`progress`             a line on a terminal
=====================  ==========================================================
"""
