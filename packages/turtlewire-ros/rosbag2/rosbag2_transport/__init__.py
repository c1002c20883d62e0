"""Records topics into bags and plays them, for ``ros2 bag`` and rosbag2_py.

Messages travel as bytes between the wire and the bag; no message object is made.

=====================  ==========================================================
module                 contents
=====================  ==========================================================
`options`              `RecordOptions`, `PlayOptions`
`record`               `ros2 bag record` from beginning to end, and its keys
`play`                 `ros2 bag play` from beginning to end, and its keys
`recorder`             `Recorder`: subscribes, takes, pauses
`recorder_services`    services and topic of a recorder
`recorder_notices`     reports requested topics that do not exist
`recorder_qos`         which QoS receives from all publishers of a topic
`topic_filter`         which topics are recorded or converted, and which belong to an action
`player`               `Player`: time, order, and what pauses, seeks or ends it
`played_bags`          the bags, as if they were one; what is latched where a playback begins
`player_outputs`       its publishers, their QoS, and recorded requests
`player_services`      services, topic and ``/clock`` of a player
`play_filter`          which topics are played
`rewrite`              converts bags
`qos_overrides`        QoS profiles from a file
`session`              common parts: context, node, terminal, signals
`progress`             a line on a terminal
=====================  ==========================================================
"""
