"""Recording topics into bags and playing them: what ``ros2 bag`` and rosbag2_py do.

Messages travel as bytes between the wire and the bag; no message object is made.

===================  ==================================================
module               what it holds
===================  ==================================================
`options`            `RecordOptions`, `PlayOptions`
`recorder`           `Recorder`: subscribes, takes, pauses, splits
`recorder_services`  its services
`recorder_qos`       which QoS receives from all publishers of a topic
`topic_filter`       which topics are recorded
`session`            a context, a node and its executor for one command
`record`             one recording from beginning to end
`progress`           its progress, on one line of a terminal
`qos_overrides`      QoS profiles by topic, from YAML
===================  ==================================================
"""
