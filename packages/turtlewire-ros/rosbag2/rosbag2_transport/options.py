"""Options of the recorder and the player.

As ROS 2's classes, the options reject attributes that they do not have.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass, field
from datetime import timedelta
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile


class NumberedEnum(enum.Enum):
    """An enum that ``int()`` takes, as the C++ classes are in ROS 2."""

    def __int__(self) -> int:
        return int(self.value)


class ServiceRequestsSource(NumberedEnum):
    """The endpoint whose record of a service request is played."""

    SERVICE_INTROSPECTION = 0
    CLIENT_INTROSPECTION = 1


class MessageOrder(NumberedEnum):
    """By which of their times messages are played."""

    RECEIVED_TIMESTAMP = 0
    SENT_TIMESTAMP = 1


@dataclass(slots=True)
class RecordOptions:
    """Options of a recording.

    Attributes:
        all_topics: Record all topics.
        all_services: Record the events of all services.
        is_discovery_disabled: Look only once for topics.
        topics: Names of topics.
        topic_types: Types whose topics are recorded.
        services: Names of the event topics of services (``/add/_service_event``).
        all_actions: Record all actions.
        actions: Names of actions.
        exclude_actions: Names of actions that are left out.
        exclude_topics: Names of topics that are left out.
        exclude_topic_types: Types whose topics are left out.
        exclude_service_events: Names of event topics that are left out.
        rmw_serialization_format: Only ``cdr``, or an empty string for it.
        topic_polling_interval: How long changes of the graph are collected before the next look.
        repeat_transient_local_messages: How many messages of a latched topic are written again into
            each further file and each snapshot, by topic.
        repeat_all_transient_local_depth: The same number for all latched topics; 0 for none.
        static_topics_uri: A YAML file with topics that are subscribed to at once, or empty.
        regex: A pattern; topics and services in whose name it is found are recorded.
        exclude_regex: A pattern; topics and services in whose name it is found are left out.
        node_prefix: Put in front of the node's name.
        compression_mode: ``file``, ``message``, ``none`` or empty.
        compression_format: ``zstd``, or empty.
        compression_queue_size: Accepted as in ROS 2; the cache bounds what waits.
        compression_threads: Accepted as in ROS 2.
        compression_threads_priority: Accepted as in ROS 2.
        topic_qos_profile_overrides: QoS of subscriptions by topic.
        include_hidden_topics: Record topics whose name has a part that begins with ``_``.
        include_unpublished_topics: Record topics that currently have no publisher.
        ignore_leaf_topics: Leave out topics without subscriptions.
        start_paused: Begin paused.
        use_sim_time: Take the time of messages from ``/clock``.
        disable_keyboard_controls: Do not read keys.
    """

    all_topics: bool = False
    all_services: bool = False
    is_discovery_disabled: bool = False
    topics: list[str] = field(default_factory=list)
    topic_types: list[str] = field(default_factory=list)
    services: list[str] = field(default_factory=list)
    all_actions: bool = False
    actions: list[str] = field(default_factory=list)
    exclude_actions: list[str] = field(default_factory=list)
    exclude_topics: list[str] = field(default_factory=list)
    exclude_topic_types: list[str] = field(default_factory=list)
    exclude_service_events: list[str] = field(default_factory=list)
    rmw_serialization_format: str = ""
    topic_polling_interval: timedelta = timedelta(milliseconds=100)
    repeat_transient_local_messages: dict[str, int] = field(default_factory=dict)
    repeat_all_transient_local_depth: int = 0
    static_topics_uri: str = ""
    regex: str = ""
    exclude_regex: str = ""
    node_prefix: str = ""
    compression_mode: str = ""
    compression_format: str = ""
    compression_queue_size: int = 1
    compression_threads: int = 0
    compression_threads_priority: int = 0
    topic_qos_profile_overrides: dict[str, QoSProfile] = field(default_factory=dict)
    include_hidden_topics: bool = False
    include_unpublished_topics: bool = False
    ignore_leaf_topics: bool = False
    start_paused: bool = False
    use_sim_time: bool = False
    disable_keyboard_controls: bool = False


@dataclass(slots=True)
class PlayOptions:
    """Options of a playback. Times are in seconds; a negative time means that it is not set.

    Attributes:
        read_ahead_queue_size: How many messages are read before they are due.
        message_order: By which of their times messages are played. By the time at which they were
            sent, one that is due more than ``read_ahead_queue_size`` messages earlier than it was
            received comes late; bags of sqlite3 have only the time at which it was received.
        node_prefix: Put in front of the node's name.
        rate: Bag seconds in one second.
        topics_to_filter: Names of the topics to play; empty for all.
        services_to_filter: Names of the service event topics to play; empty for all.
        actions_to_filter: Names of the actions to play; empty for all.
        exclude_actions_to_filter: Names of actions that are left out.
        send_actions_as_client: Send recorded goals, requests to cancel and requests of results to
            action servers, instead of publishing the topics of actions.
        regex_to_filter: A pattern that matches whole names of what is played.
        exclude_regex_to_filter: A pattern that matches whole names of what is left out.
        exclude_topics_to_filter: Names of topics that are left out.
        exclude_service_events_to_filter: Names of event topics that are left out.
        topic_qos_profile_overrides: QoS of publishers by topic.
        loop: Begin again at the end.
        topic_remapping_options: Words of a command line: ``--ros-args --remap /a:=/b``.
        clock_publish_frequency: How often ``/clock`` is published [Hz]; 0 for never.
        clock_publish_on_topic_publish: Publish ``/clock`` with each message.
        clock_trigger_topics: Publish ``/clock`` with the messages of these topics.
        delay: How long to wait before each playback.
        playback_duration: How much of the bag is played.
        playback_until_timestamp: Time of the bag at which to end [ns].
        start_paused: Begin paused.
        start_offset: Where in the bag to begin.
        disable_keyboard_controls: Do not read keys.
        wait_acked_timeout: How long to wait at the end until all reliable subscriptions have all
            messages [ms]; 0 without limit.
        disable_loan_message: Accepted as in ROS 2; messages are never loaned.
        progress_bar_update_rate: How often the line with the progress is drawn [Hz]; 0 for never,
            negative for as often as a terminal shows.
        progress_bar_separation_lines: Accepted as in ROS 2; the line needs none.
        publish_service_requests: Send recorded requests to services instead of their events.
        service_requests_source: Whose record of a request is sent.
    """

    read_ahead_queue_size: int = 1000
    node_prefix: str = ""
    rate: float = 1.0
    topics_to_filter: list[str] = field(default_factory=list)
    services_to_filter: list[str] = field(default_factory=list)
    actions_to_filter: list[str] = field(default_factory=list)
    exclude_actions_to_filter: list[str] = field(default_factory=list)
    send_actions_as_client: bool = False
    regex_to_filter: str = ""
    exclude_regex_to_filter: str = ""
    exclude_topics_to_filter: list[str] = field(default_factory=list)
    exclude_service_events_to_filter: list[str] = field(default_factory=list)
    topic_qos_profile_overrides: dict[str, QoSProfile] = field(default_factory=dict)
    loop: bool = False
    topic_remapping_options: list[str] = field(default_factory=list)
    clock_publish_frequency: float = 0.0
    clock_publish_on_topic_publish: bool = False
    clock_trigger_topics: list[str] = field(default_factory=list)
    delay: float = 0.0
    playback_duration: float = -1.0
    playback_until_timestamp: int = -1
    start_paused: bool = False
    start_offset: float = 0.0
    disable_keyboard_controls: bool = False
    wait_acked_timeout: int = -1
    disable_loan_message: bool = False
    progress_bar_update_rate: int = 3
    progress_bar_separation_lines: int = 2
    publish_service_requests: bool = False
    service_requests_source: ServiceRequestsSource = ServiceRequestsSource.SERVICE_INTROSPECTION
    message_order: MessageOrder = MessageOrder.RECEIVED_TIMESTAMP
