"""`docs/compatibility.md` is true: each of its entries has a test, which the table below names.

An entry is known by its first cell, what ROS 2 does. Whoever adds one adds its test here; whoever
changes a test's name sees it here.
"""

import ast
import functools
import subprocess
import sys

import pytest
from tests.places import ROOT, module_of_tests

PAGE = ROOT / "docs" / "compatibility.md"

# Entry, and below it the tests of what we do instead.
TESTED = """
discovery reaches the subnet
  wire/test_environment.py test_the_range_is_localhost_unless_said_otherwise
  wire/test_two_hosts.py test_other_hosts_cannot_reach_nodes_by_default
Ctrl-C of the tutorial's nodes ends in tracebacks, exit code -2 or 1
  rclpy/test_signals.py test_ctrl_c_ends_the_tutorials_main_cleanly test_one_shutdown_after_a_signal_is_tolerated_and_a_second_raises
a waiting lookup sleeps 20 ms at a time, on the system clock
  tf/test_buffer.py test_wakes_when_data_comes
  tf2_ros/test_waiting_in_callbacks.py test_waiting_never_hangs_and_answers_right
`RMW_IMPLEMENTATION` names a middleware that is not installed: every program ends in a traceback
  wire/test_environment.py test_a_middleware_that_is_not_here_is_one_line_and_cyclone_is_taken
the middleware is Fast DDS unless `RMW_IMPLEMENTATION` names another
  wire/test_environment.py test_missing_middleware_is_reported_and_replaced
  wire/test_libddsc.py test_zenoh_is_taken_instead_of_an_unknown_version
processes find each other through a router, `rmw_zenohd`
  wire/test_processes.py test_messages_go_both_ways
  wire/zenoh/test_sdk.py test_their_server test_their_client
`ROS_AUTOMATIC_DISCOVERY_RANGE` and `ROS_STATIC_PEERS` are not read
  wire/zenoh/test_configuration.py test_the_range_of_discovery
a session looks for a router once, unless `ZENOH_ROUTER_CHECK_ATTEMPTS` says otherwise
  wire/zenoh/test_router_check.py test_nothing_is_waited_for
a volatile subscription drops what is older than the last message of the same process
  wire/test_contract.py test_publishers_of_several_threads_lose_nothing
the router listens on all interfaces
  wire/zenoh/test_configuration.py test_the_router_stays_on_this_computer
`rosidl_parser.parser` needs lark, and its grammar has enums
  rosidl_parser/test_parser.py test_all_fields_have_the_types_that_classes_have test_errors_are_reported
an extension of another package may replace an extension of ROS 2 with the same name
  ros2cli/test_extensions.py test_a_verb_is_added_and_none_is_replaced
Ctrl-C in `ros2 bag convert` leaves a bag that looks complete
  rosbag2_py/test_converting.py test_an_interrupted_conversion_says_so_and_leaves_no_half_bag
interfaces, from Jazzy on
  msg/test_distro_interfaces.py test_names_and_hashes_are_those_of_the_distribution test_interfaces_of_other_distributions_can_be_loaded
TF, from Kilted on
  tf2_py/test_buffer_core.py test_all_answers_equal
TF, in Lyrical
  tf2_py/test_buffer_core.py test_all_answers_equal
  tf2_ros/test_buffer_server.py test_a_time_message_is_refused_in_lyrical
  tf2_ros/test_tools.py test_lyrical_ignores_what_are_no_flags
rclpy, from Kilted on
  rclpy/test_distros.py test_changes
rclpy, in Lyrical
  rclpy/test_distros.py test_changes test_modules_that_lyrical_dropped test_a_declaration_of_a_name_alone test_services_announce_their_hash
messages, in Lyrical
  msg/test_distro_interfaces.py test_constructors_of_lyrical_refuse_unknown_keywords_and_take_none
message_filters, from Kilted on
  message_filters/test_distros.py test_the_fourth_argument_of_a_synchronizer test_the_misspelt_name_of_the_latest_time
message_filters, in Lyrical
  message_filters/test_distros.py test_the_misspelt_name_of_the_latest_time
turtlesim, from Kilted on
  turtlesim/test_distro.py test_types_are_those_of_the_distribution
launch, in Lyrical
  launch/test_later_actions.py test_a_log_without_a_level_is_warned_of_in_lyrical
  launch/test_frontend.py test_an_action_s_own_parse
`ros2 run`, from Kilted on
  ros2cli/test_launch_and_run.py test_a_signal_ends_the_executable_and_is_told_from_kilted_on
bags, in Lyrical
  bag/test_writer.py test_files_of_lyrical_have_the_number_in_front_and_the_time_behind
`ros2 topic`
  ros2cli/test_topic_statistics.py test_two_topics test_all_topics test_qos_of_the_subscription
  ros2cli/test_topics.py test_each_document_is_a_message
`ros2 service`
  ros2cli/test_services.py test_a_call_waits_no_longer_than_it_is_told test_stamps_have_the_time_of_each_call test_clients_and_servers_in_detail
`ros2 action`
  ros2cli/test_services.py test_names_of_a_type test_messages_of_all_interfaces
`ros2 lifecycle`, `ros2 component`
  ros2cli/test_unanswered.py test_verbs_end_in_time
`ros2` without a name, in Lyrical
  ros2cli/test_command_line.py test_verbs_use_the_chosen_name test_without_a_terminal
`ros2 action send_goal`, in Lyrical
  ros2cli/test_unanswered.py test_a_goal_ends_in_time_in_lyrical
`ros2 param`
  ros2cli/test_node_services.py test_several_parameters_of_a_node test_a_parameter_of_all_nodes test_several_parameters_are_set test_all_parameters_are_set_or_none
`ros2 bag record`, in Lyrical
  rosbag2_transport/test_lyrical_options.py test_topics_without_their_option_are_gone_in_lyrical
`ros2 bag`
  rosbag2_transport/test_lyrical_options.py test_a_file_names_the_bags_to_convert test_static_topics_are_recorded_before_they_have_a_publisher test_the_oldest_files_are_removed
  rosbag2_transport/test_actions.py test_recorded_topics_of_actions test_played_topics_of_actions test_an_action_is_recorded_and_its_goals_are_sent_again
`ros2 bag`, from Kilted on
  rosbag2_transport/test_actions.py test_from_kilted_on_actions_are_neither_topics_nor_services test_the_text_about_a_bag_from_kilted_on
parameter files and `-p`, in Lyrical
  rclpy/test_distros.py test_tags_choose_the_type_in_lyrical test_up_to_kilted_only_the_tag_of_strings_counts
URDF, in Lyrical
  urdf/test_versions.py test_versions_that_lyrical_reads test_up_to_kilted_there_is_only_version_1_0 test_an_origin_with_a_quaternion test_capsules test_limits_of_version_1_2
`ros2topic.api.add_qos_arguments`, from Kilted on
  ros2cli/test_topics.py test_the_parameters_of_ros2topic_follow_the_distribution
robot_state_publisher, in Lyrical
  robot_state_publisher/test_node.py test_the_description_from_a_topic test_frequencies_are_more_than_zero_in_lyrical test_a_file_is_no_description_in_lyrical
`ros2 doctor --report`
  ros2cli/test_doctor.py test_the_report_has_facts
an integer that 64 bits cannot hold raises `AssertionError`, or `OverflowError` under `-O`, after the checks
  rclpy/test_parameters.py test_integers_that_no_message_can_hold_are_refused
the end of any node of a name ends the log of all on `/rosout`, as a warning says
  rclpy/test_logging.py test_two_nodes_of_one_name_share_the_first_sink
`message_filters` warns of each message without a stamp
  message_filters/test_message_filters.py test_messages_without_a_stamp_are_refused
Python errors have a message
  rclpy/test_mistakes.py test_hints_are_notes
a service with a server on Fast DDS is called, and nothing answers
  peers/test_services.py test_commands_call_services_parameters_and_actions test_each_command_says_why_and_does_no_harm test_not_even_a_request_sent_at_the_moment_of_discovery_is_read
servers on Cyclone DDS and on Fast DDS have the same name: one misreads each request
  peers/test_services.py test_servers_on_two_middlewares_are_refused_until_one_leaves
a server misses the first request of a new client on Fast DDS if it discovers the client later
  peers/test_services.py test_not_even_the_first_request_of_a_new_client_is_lost
`ros2 topic info -v` shows a history that Fast DDS did not announce
  peers/test_topics.py test_topic_info_shows_no_history_that_was_not_announced

range `LOCALHOST` switches multicast off and asks peers on this host
  wire/test_environment.py test_localhost_uses_nothing_but_the_loopback_interface
`ROS_STATIC_PEERS` on one side is enough, since the default range is `SUBNET`
  wire/test_two_hosts.py test_static_peers_find_the_other_host_without_multicast
a static peer that cannot be resolved ends the process
  wire/test_environment.py test_static_peer_fatal_to_cyclone_is_skipped_with_a_warning
`publish()` on a reliable keep-all topic blocks while a matched subscription takes no messages
  wire/test_scale.py test_a_publisher_gives_up_on_a_subscription_that_stands_still
datagrams of up to 14.7 kB (Cyclone's default)
  wire/test_environment.py test_datagrams_are_large_on_loopback_only
some 30 processes on a host in range `LOCALHOST`
  wire/test_scale.py test_fifty_processes_that_start_at_once_see_each_other
  wire/test_environment.py test_configuration_of_each_range
a service waits within its callback's thread until the client's reader is known
  wire/test_processes.py test_the_first_request_of_a_new_client_is_always_answered
`ros_discovery_info` is sent again for every endpoint
  wire/test_scale.py test_a_thousand_endpoints_take_a_handful_of_announcements
a publisher whose type has the same name but other fields counts as the same type
  wire/test_bad_input.py test_a_type_of_our_name_with_other_fields_is_named_once
the middleware logs every datagram that the network rejects
  wire/test_two_hosts.py test_link_down_and_up_is_named_once_and_messages_resume
  wire/test_cyclone_log.py test_many_lines_of_one_kind_are_one_warning_and_the_thread_ends
big-endian messages are read
  wire/test_foreign_peers.py test_payloads_that_are_no_messages_are_dropped_and_said_once
`message_lost` is raised for lost samples
  wire/test_cyclone_events.py test_message_lost_can_be_watched

fields are properties over `_x` slots
  msg/test_classes.py test_fields_are_plain_slots_that_do_not_take_other_names
an int in a float field crashes the process when it is published
  msg/test_cdr.py test_integers_and_numpy_scalars_are_accepted_as_floats
a value of the wrong type fails inside C, or an assertion ends the process
  msg/test_cdr.py test_a_wrong_value_is_named
a float32 out of range is sent as infinity
  msg/test_cdr.py test_a_wrong_value_is_named
an unknown keyword raises `AssertionError` only where assertions are on
  test_compatibility.py test_an_unknown_keyword_is_an_error_without_assertions_too

error texts end in `, at ./src/rcl/arguments.c:380`
  rclpy/test_arguments.py test_golden_errors
`[]` on the command line is a byte array
  rclpy/test_parameters.py test_an_empty_list_of_the_command_line_fits_every_array
`get_parameter_value('"5"')` turns it into a number
  rclpy/test_parameter.py test_values_from_yaml
a lifecycle transition that is not possible raises out of `spin`
  rclpy/test_lifecycle.py test_services
after the clock is set back, a throttled message is silent until it catches up
  rclpy/test_logging.py test_throttle
log files are called `python3_<pid>_<ms>.log`
  rclpy/test_logging.py test_the_log_file
`--log-config-file` configures spdlog
  rclpy/test_logging.py test_a_configuration_file_is_ignored_with_a_warning
`transition_event` has neither time nor transition
  rclpy/test_lifecycle.py test_transition_events
whether a child of a node's logger reaches `/rosout` depends on which code made it
  rclpy/test_logging.py test_records_reach_the_sink_of_their_node
`client.call_async` responses wait for the client's callback group
  rclpy/test_executors.py test_awaiting_a_service_in_the_same_group
`client.call()` in a callback of a single-threaded executor hangs
  rclpy/test_executors.py test_call_in_a_callback_of_a_single_thread test_call_to_a_service_of_the_blocked_executor_raises
an `async` callback that awaits a service of its own callback group hangs
  rclpy/test_executors.py test_an_async_callback_that_waits_for_itself_is_warned_of
`client.call()` hangs silently if no executor spins the node
  rclpy/test_executors.py test_a_call_that_nobody_serves_is_warned_of
`rate.sleep()` in the thread that spins hangs
  rclpy/test_timer.py test_rate_raises_in_the_spinning_thread
`shutdown()` after Ctrl-C raises
  rclpy/test_signals.py test_one_shutdown_after_a_signal_is_tolerated_and_a_second_raises
a Ctrl-C that is not caught prints a traceback
  rclpy/test_signals.py test_ctrl_c_that_is_not_caught_ends_without_a_traceback test_other_errors_keep_their_traceback
Ctrl-C while an action server executes a goal prints the traceback of `publish_feedback`
  demo_nodes_py/test_minimal_actions.py test_ctrl_c_in_the_middle_of_a_goal_is_one_line
two SIGINT for one Ctrl-C (terminal and launch) interrupt the clean-up
  rclpy/test_signals.py test_ctrl_c_ends_the_tutorials_main_cleanly
`rclpy.spin_once(node)` takes a node out of the executor it was in
  rclpy/test_init_shutdown.py test_a_spin_within_a_callback_leaves_the_node_where_it_was
messages are encoded even without a subscription
  rclpy/test_topics.py test_without_subscriptions_only_the_first_message_is_encoded
a client drops the feedback that it has not handled when it gets the result
  rclpy/test_actions.py test_no_feedback_that_was_sent_after_the_result
SIGTERM does not end `AsyncNode.run()`, because nothing wakes the loop (Lyrical)
  rclpy/test_async_signals.py test_sigterm_ends_run
`AsyncNode.create_subscription` needs a callback (Lyrical)
  rclpy/test_async_topics.py test_iterating_over_messages
`wait_for_service` and `wait_for_node` of asynchronous nodes look again every `check_interval` (Lyrical)
  rclpy/test_async_services.py test_a_call
  rclpy/test_async_node.py test_waiting_for_a_node
content filters of subscriptions work with `rmw_fastrtps_cpp`
  rclpy/test_surface.py test_content_filters_are_refused

`ExtrapolationException` has only a message
  tf/test_errors.py test_attributes
rotations closer than about 1.5e-8 rad hold the older one between samples
  tf/test_agreement.py test_interpolation_moves_at_one_speed
values of one stamp are stored without limit
  tf/test_buffer.py test_flood_of_one_stamp
a lookup with a timeout polls, always until the timeout
  tf/test_buffer.py test_does_not_wait_for_the_impossible
`BufferCore(cache_time=...)` as a keyword is ignored
  tf2_py/test_buffer_core.py test_cache_time
`lookupVelocityCore` is wrong in general (a lever arm is multiplied element by element)
  tf2_py/test_buffer_core.py test_velocity
`_chain` lists wrong frames for V-shaped paths
  tf2_py/test_buffer_core.py test_chain
a translation must be a real `Vector3`
  tf2_py/test_buffer_core.py test_lookup_returns_a_message
any byte string is a valid frame name
  tf/test_buffer.py test_name_that_is_not_utf8 test_reason
a rejected transform is reported only in the log
  tf/test_inspection.py test_refusals_are_counted
  tf2_py/test_buffer_core.py test_refusal_is_logged

`do_transform_vector3` zeroes the caller's transform; result headers are the transform's own object
  tf2_geometry_msgs/test_registration.py test_arguments_stay_and_headers_are_copies
C++ rotates a wrench's force and torque, without the lever arm
  tf2_geometry_msgs/test_twists.py test_power_is_the_same_in_every_frame
Python has no twists, paths, odometry, pose arrays, wrenches, velocities, quaternions
  tf2_geometry_msgs/test_registration.py test_a_buffer_transforms_it_at_the_time_of_its_stamp test_the_package_lists_what_it_has
clouds: only x, y, z are rotated, `row_step` is ignored
  tf2_sensor_msgs/test_clouds.py test_normals_are_turned_and_not_moved test_every_layout
`view_frames` needs graphviz, and crashes on a loop
  tf2_tools/test_view_frames.py test_it_listens_and_writes_three_files test_a_loop_is_told_and_written
a static transform has a rate of 10000 Hz
  tf/test_tree_drawing.py test_a_static_transform_has_no_rate_and_a_single_one_neither
  tf2_tools/test_view_frames.py test_one_link_as_ros_2_writes_it

a static transform that is sent again from Python is ignored
  tf2_ros/test_broadcasters.py test_a_static_transform_can_be_sent_again test_the_last_sender_of_a_process_wins_for_late_joiners_too
`StaticTransformBroadcaster` keeps the caller's message
  tf2_ros/test_broadcasters.py test_the_caller_may_reuse_the_message
async lookups have no timeout, and wait for times that can no longer arrive
  tf2_ros/test_buffer.py test_futures_may_have_a_timeout test_a_future_fails_when_its_time_has_fallen_out_of_the_cache
a timed-out remote lookup is an empty transform and a success
  tf2_ros/test_buffer_server.py test_a_remote_timeout_is_an_error_and_no_empty_transform
`BufferClient` needs another thread that spins its node
  tf2_ros/test_buffer_server.py test_a_callback_of_the_user_s_node_may_ask
`tf2_echo` does not pad nanoseconds
  tf2_ros/test_tools.py test_echo_prints_what_ros_2_prints test_echo_as_json
`convert` and `new_type` return a message of another type than requested
  tf2_geometry_msgs/test_registration.py test_no_type_passes_for_another
`tf2_monitor` does not name publishers
  tf2_ros/test_tools.py test_monitor_names_who_publishes
`tf2_monitor` reports a net delay of 1.8e9 s for a static chain
  tf2_ros/test_tools.py test_static_chain_has_no_net_delay
`tf2_echo` and `tf2_monitor` give no help with an unknown frame id
  tf2_ros/test_tools.py test_the_tools_help_with_a_frame_id_that_is_not_known
`MessageFilter` is for C++
  tf2_ros/test_message_filter.py test_callbacks_run_on_the_executor_not_where_the_data_come
a lookup waits until its timeout for a server that was killed
  tf2_ros/test_clock_jumps.py test_the_client_goes_on_with_the_next_server
a `Buffer` without a node ignores the simulated clock
  tf2_ros/test_buffer.py test_a_buffer_follows_the_clock_of_its_listener
waiting messages stay in a filter or synchronizer after the clock jumps back
  tf2_ros/test_message_filter.py test_waiting_messages_are_dropped_when_the_clock_jumps_back
`tf2_echo` waits forever for an invalid frame id (`/world`)
  tf2_ros/test_tools.py test_echo_refuses
`static_transform_publisher` publishes NaN, infinity and a quaternion of zeros
  tf2_ros/test_tools.py test_wrong_arguments_are_named
`tf_transformations` needs `transforms3d`, and loads NumPy at once
  tf_transformations/test_tf_transformations.py test_the_broadcaster_s_function_needs_no_numpy

urdfdom's errors name a line of its C++ code
  urdf/test_parser.py test_texts_of_urdfdom_with_line_and_element
  robot_state_publisher/test_golden.py test_a_description_that_urdfdom_refuses
a zero `axis` is accepted, and poses are NaN
  urdf/test_parser.py test_joints_that_urdfdom_refuses
links with two parents and loops outside the tree are accepted
  urdf/test_parser.py test_joints_that_urdfdom_refuses
the DOCTYPE of a URDF is skipped
  urdf/test_parser.py test_entities_are_refused
a joint that mimics another mimic joint moves only if their names sort in the right order
  robot_state_publisher/test_node.py test_a_mimic_joint_of_a_mimic_joint_moves
joints that mimic each other in a loop are accepted in silence
  robot_state_publisher/test_node.py test_mimic_joints_in_a_loop_are_told_and_the_rest_moves
joint states are skipped in silence, because of `publish_frequency` or a stamp that does not advance
  robot_state_publisher/test_node.py test_skipped_messages_are_told_once test_unchanged_stamps_are_reported
joint states without a known joint are ignored silently
  robot_state_publisher/test_node.py test_unknown_joints_are_told_after_a_while
a floating joint is not published, in silence
  robot_state_publisher/test_node.py test_floating_joint_is_reported
`publish_frequency` 0 divides by zero
  robot_state_publisher/test_node.py test_zero_frequency_publishes_every_forward_stamp
kdl_parser warns twice about a new `robot_description`
  robot_state_publisher/test_golden.py test_scenario
a failed start aborts with 250
  robot_state_publisher/test_golden.py test_a_wrong_start
`urdf_to_graphviz` needs Graphviz for the PDF
  urdfdom/test_programs.py test_drawings

two INFO lines at the start
  turtlesim/test_turtlesim_processes.py test_ctrl_c_ends_it_with_a_browser_open_too test_ctrl_c_ends_the_simulator_cleanly
a Qt window; closing it ends the node
  turtlesim/test_turtlesim_processes.py test_the_page_drives_the_turtle_on_its_topic
  web/test_server.py test_a_taken_port_is_replaced_by_a_free_one
a NaN or infinite command loses the turtle
  turtlesim/test_turtlesim_node.py test_non_finite_values_are_ignored_with_one_line test_a_heading_that_is_not_finite_is_rejected
an invalid turtle name ends the process
  turtlesim/test_turtlesim_node.py test_start_spawn_kill_and_reset_with_their_texts
the simulation runs in real time
  turtlesim/test_turtlesim_node.py test_the_speed_is_a_parameter_from_its_first_use_on test_in_a_pause_nothing_moves_and_no_pose_comes test_a_faster_simulation_has_its_speed_as_a_parameter
lines have the pen's colour
  turtlesim/test_page_settings.py test_lines_have_the_colour_of_their_turtles_shell test_only_the_pen_that_nobody_set_is_tinted
turtlesim does not report turtles that other nodes wait for
  turtlesim/test_turtlesim_node.py test_a_wanted_turtle_is_named_with_the_command test_the_command_for_a_wanted_turtle_is_shown_until_it_is_there
  turtlesim/test_page.py test_a_missing_turtle_is_offered
callbacks run inside ticks only
  turtlesim/test_model.py test_teleports_are_applied_in_order_at_the_next_tick
ticks follow wall time even with `use_sim_time`
  turtlesim/test_testing.py test_time_moves_only_in_steps
teleop without a terminal aborts
  turtlesim/test_turtlesim_processes.py test_teleop_without_a_terminal_says_so
`signal_handler(signum=2)` is printed
  turtlesim/test_turtlesim_processes.py test_ctrl_c_ends_the_simulator_cleanly
`turtlesim_msgs` comes with Kilted
  turtlesim/test_distro.py test_types_are_those_of_the_distribution
bad `--ros-args` abort with 250
  test_compatibility.py test_bad_arguments_end_turtlesim_with_status_1

`--ros-args` that cannot be read end a Python node with a traceback
  ros2cli/test_launch_and_run.py test_a_bad_command_line_of_a_node_is_told_in_one_line
an unknown name is answered with an error line only
  ros2cli/test_suggestions.py test_names_that_are_known_without_nodes test_names_of_the_graph
a package that is not built or sourced, and a file that is not installed, are reported as not found, without a reason
  turtlewire_ros/test_workspace_hints.py test_a_package_that_is_not_built test_a_package_that_is_built_and_not_sourced test_a_file_that_is_not_installed test_an_executable_that_is_not_installed
a program that logs each failed lookup fills the console with one line
  rclpy/test_failed_lookups.py test_the_console_repeats_a_failure_once_a_second test_the_log_file_has_every_line
teleop silently publishes in a domain without subscriptions
  rclpy/test_unheard.py test_teleop_says_that_nothing_listens test_other_domains_are_named
an error in a launch file does not include its position
  launch/test_launch_files.py test_errors_in_files_are_named_with_their_lines
colcon builds a package whose `package.xml` cannot be read, but ROS does not find it afterwards
  test_colcon_ament.py test_a_broken_manifest_is_named_with_its_line
SIGTERM and a single SIGINT of `ros2 run` leave the executable running
  ros2cli/test_launch_and_run.py test_a_signal_ends_the_executable_and_is_told_from_kilted_on
a playback that begins at an offset, paused or after a seek loses the latched messages from before
  rosbag2_transport/test_player.py test_received_messages_equal_those_of_the_real_node test_a_paused_playback_has_sent_what_was_latched_before_the_bag test_after_a_seek_listeners_have_what_was_latched_then
a subscription that joins a playback late gets the last ten messages of `/tf_static`
  rosbag2_transport/test_player.py test_one_that_joins_late_gets_all_static_transforms
`ros2 bag play` silently ignores topics and services in its options that the bag does not have, and does not say why it plays nothing
  rosbag2_transport/test_golden_commands.py test_a_command
  rosbag2_transport/test_play_options.py test_option_names_missing_from_the_bag
`ros2 bag record` waits in silence for topics that never appear
  rosbag2_transport/test_record_options.py test_it_tells_once_what_it_waits_for
a QoS override that prevents a recorder from receiving anything is applied silently
  rosbag2_transport/test_record_options.py test_simulated_time_splits_compression_and_overrides
Ctrl-C does not end `ros2 bag play --wait-for-all-acked 0` while a subscription has stopped reading
  rosbag2_transport/test_play_options.py test_a_listener_that_stands_still_does_not_hold_back_ctrl_c
a recorder loses latched messages that come during a pause
  rosbag2_transport/test_recorder.py test_latched_messages_that_come_during_a_pause_are_kept
a topic whose type is not installed is not recorded
  rosbag2_transport/test_recorder.py test_a_topic_of_a_type_that_is_not_known_here_is_recorded
a recorder continues when the disk is full
  rosbag2_transport/test_recorder.py test_a_full_disk_ends_the_recording_with_one_line
`ros2 bag reindex` leaves a file that was cut off as it is
  bag/test_repair.py test_a_cut_bag_is_made_whole
messages of an older definition are played and read as they were recorded, and subscriptions cannot decode them
  bag/test_encodings.py test_each_type_of_each_release
  rosbag2_py/test_converting.py test_scripts_read_older_messages_as_those_that_are_installed
`ros2 bag convert` writes topics of any encoding as if they were in CDR, and leaves an empty bag after an error
  rosbag2_py/test_converting.py test_a_topic_that_cannot_be_converted_is_named test_a_refused_conversion_leaves_no_bag
`ros2 bag info -v` fails for bags compressed by file, and counts no requests in bags compressed by message
  ros2cli/test_bag.py test_info
`ros2 control`, `security`
  ros2cli/test_suggestions.py test_commands_that_are_not_here
an unknown option shows the usage of `ros2`
  ros2cli/test_extensions.py test_unknown_options_show_the_usage_of_the_verb
a verb keeps waiting when the server that it called has ended
  ros2cli/test_unanswered.py test_a_killed_server_ends_the_wait
names and strings of other nodes reach the terminal unescaped
  ros2cli/test_output.py test_every_verb_is_escaped test_topic_info_of_a_hostile_peer
endpoints of different types on one topic or service exchange nothing, in silence
  rclpy/test_mistakes.py test_one_topic_with_two_types
  wire/test_contract.py test_a_client_of_another_type_than_the_service_is_warned
a verb waits silently for a service with another type or a wrong name
  ros2cli/test_unanswered.py test_mistakes_raise_immediately test_requests_that_do_not_get_through_are_told_once
YAML aliases may stand for any number of values
  ros2cli/test_command_line.py test_aliases_that_stand_for_too_much_are_refused
`interface show` prints upstream's comments
  ros2cli/test_golden_cli.py test_commands_without_nodes
the `print()` output of children waits in a buffer
  launch/test_execute_process.py test_print_is_seen_at_once
a launched program has a pipe as its input
  launch_ros/test_examples.py test_a_launched_teleop_reads_the_terminal
SIGTERM of launch may leave orphans
  launch/test_launch_service.py test_sigterm_stops_the_children_too
grandchildren, and processes that ignore signals, outlive a launch that ends or is killed
  launch/test_launch_service.py test_not_even_sigkill_leaves_children
  chaos/test_processes.py test_ros2_run_leaves_nothing test_ros2_launch_leaves_nothing
pytest imports launch at each start
  launch_testing/test_runs.py test_plain_tests_do_not_wait_for_launch
`assertWaitFor` says only that the output timed out
  launch_testing/test_runs.py test_failures_with_launch_test
a start that fails, and errors in a launch file, print a traceback
  launch/test_launch_files.py test_malformed_files
  launch/test_launch_service.py test_debug_shows_tracebacks_and_events
a component container must be named in full
  launch_ros/test_composable_nodes.py test_nodes_of_a_container
a container loads C++ libraries
  rclpy_components/test_component_manager.py test_a_class_has_the_name_of_a_component_of_cpp
a daemon is started by the first command and answers queries about the graph
  test_compatibility.py test_no_daemon_is_running
  ros2cli/test_daemon.py test_the_verbs test_it_answers_as_a_node_does
any page in a browser can call the daemon
  ros2cli/test_daemon.py test_any_program_may_ask_but_no_web_page
`ProcessStdin` has no effect
  launch/test_execute_process.py test_single_processes_can_be_stopped_signalled_and_fed
Ctrl-C of a verb may end in error lines
  ros2cli/test_main.py test_verb_errors_become_one_line_and_a_status
a verb ends with a traceback or "Exception ignored" if `head` has closed its output or the disk is full
  test_program.py test_a_reader_that_has_gone_ends_a_command_as_it_ends_git test_a_full_disk_is_one_line
`ros2 run` starts a script with the interpreter in its shebang line
  ros2cli/test_launch_and_run.py test_python_scripts_run_on_this_interpreter
`AMENT_PREFIX_PATH` must be set
  turtlewire_ros/test_prefix.py test_prefixes_that_exist_in_their_order_and_the_own_one_last
`pkg create` can create C++ packages, and creates one if `--build-type` is not given
  ros2cli/test_pkg_create.py test_a_package_with_a_node test_a_node_of_cpp_is_refused
without a route to the group, `ros2 multicast` ends with `No such device`
  ros2cli/test_multicast.py test_without_a_network_it_arrives_on_the_same_host
`ros2 doctor` counts checks, and compares the versions of packages with those of the distribution
  doctor/test_doctor.py test_the_command_says_problems_first_and_fails
`dependent_joints` have no effect once there is a description
  joint_state_publisher/test_golden.py test_dependent_joints_outlive_the_description
a mimic joint of an unknown joint ends joint_state_publisher with `KeyError`
  joint_state_publisher/test_golden.py test_a_mimic_of_an_unknown_joint_does_not_end_the_node
a cycle of mimic joints ends joint_state_publisher
  joint_state_publisher/test_golden.py test_a_circle_of_mimics_is_refused
joint_state_publisher also reads COLLADA robots
  joint_state_publisher/test_description.py test_errors
joint_state_publisher_gui opens a Qt window
  joint_state_publisher_gui/test_page.py test_a_slider_moves_its_joint_and_those_that_follow
`address` is 0.0.0.0 by default
  foxglove/test_command.py test_it_tells_its_address_serves_and_ends_at_ctrl_c test_an_address_for_others_is_said_plainly
pages of any origin connect
  foxglove/test_hostile.py test_other_pages_are_refused_with_one_line
`tls`, `certfile` and `keyfile` make it a wss server
  foxglove/test_command.py test_wrong_parameters_are_refused
`num_threads`, `min_qos_depth`, `max_qos_depth`, `best_effort_qos_topic_whitelist`, `use_compression` and others tune it
  foxglove/test_command.py test_options_without_effect_are_reported
an integer for a floating-point parameter is rejected
  foxglove/test_requests.py test_parameters_are_set_and_keep_their_type
`rviz2` opens a window
  robots/test_urdf_tutorial.py test_every_model_is_displayed
RViz draws displays of any plugin
  view/test_rviz_file.py test_a_file_of_rviz_is_read
RViz's Effort draws revolute joints at the stamp of the message
  view/test_efforts.py test_efforts_are_shares_of_the_greatest_ones
  view/test_efforts.py test_efforts_follow_their_joints_and_earlier_ones_stay
RViz's Camera can leave out each display (`Visibility`)
  view/test_rviz_file.py test_a_display_of_a_file
RViz's DepthCloud pairs images by stamps within a queue, reads compressed ones, and can fill what is hidden
  view/test_depth_clouds.py test_a_slow_colour_image_delays_no_points
  view/test_rviz_file.py test_a_display_of_a_file
RViz's interactive markers may start programs, and hold shapes of any frame
  view/test_interactive_pictures.py test_a_menu_opens_by_the_right_button
  view/test_interactive_markers.py test_a_wrong_control_is_named test_too_many_controls_and_menu_entries_are_cut
RViz uses the transforms at both ends of a scan and interpolates the beams
  view/test_feed_order.py test_each_beam_is_drawn_from_where_the_scanner_was
RViz draws all points of the `Decay Time`
  view/test_feed_order.py test_points_that_stay_share_the_budget
RViz's RobotModel reads a topic or a file
  view/test_tools_and_files.py test_a_robot_of_a_parameter_and_its_links
RViz uses the default for an invalid value in a `.rviz` file
  view/test_rviz_file.py test_wrong_values_of_a_file_are_named
RViz subscribes with the QoS that its display is set to
  view/test_viewer.py test_a_display_subscribes_as_its_publishers_offer
  view/test_rviz_file.py test_unsupported_parts_are_written_back
RViz loads meshes from any file and from `http`
  view/test_robot_model.py test_addresses_that_are_refused
`ament_cmake` packages need CMake
  robots/test_urdf_tutorial.py test_the_workspace_is_known
  test_cmake.py test_installed_files
  test_colcon_ament.py test_scripts_modules_and_launch_files
pip cannot install `ament_cmake` packages
  test_pip_install.py test_packages_are_built_after_those_that_they_need
  test_colcon_ament.py test_pip_installs_such_packages
`ament_add_gtest` and linters are tests of `colcon test`
  turtlewire_ros/test_pytest_plugin.py test_tests_of_absent_linters_are_skipped
  test_cmake.py test_targets_without_compilation_pass
xacro (PyPI, 2.1)
  robots/test_urdf_tutorial.py test_every_model_is_displayed
roslibpy (PyPI, 2.1)
  turtlewire_ros/test_roslibpy.py test_topics_and_services
rosbags, mcap, mcap-ros2-support (PyPI)
  bag/test_writer.py test_rosbags_reads_it test_mcap_reads_it
  bag/test_writer.py test_other_libraries_decode_with_the_definitions_in_it
  bag/test_other_tools.py test_rosbags test_mcap
evo (PyPI)
  trajectory/test_metrics.py test_the_table_is_evos
  trajectory/test_metrics.py test_evo_samples_our_buffer
transforms3d (PyPI)
  tf_transformations/test_tf_transformations.py test_euler_conventions
yourdfpy (PyPI)
  urdf/test_kinematics.py test_as_yourdfpy
colcon, catkin-pkg (`python3-catkin-pkg`), rosdep (PyPI)
  turtlewire_ros/test_prefix.py test_catkin_pkg_reads_our_manifests
  test_colcon_ament.py test_colcon_test_runs_what_the_package_adds
  tutorial/test_terminal.py test_the_five_commands
rosbridge_suite, rosapi, nav2_common, diagnostic_updater's Python part, joint_state_publisher, urdf_tutorial
  test_colcon_ament.py test_scripts_modules_and_launch_files
  test_colcon_ament.py test_data_templates_extras_and_hooks
geographic_msgs, control_msgs, nav2_msgs, test_msgs
  test_colcon_ament.py test_interfaces_with_extras_bounds_defaults_and_idl
`xacro` in `Command` must be in PATH
  robots/test_examples.py test_the_walker_walks
"""


def entries():
    """The first cells of the page's tables; a line of dashes follows each head.

    What the page says was seen once has no test.
    """
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    heads = {index - 1 for index, line in enumerate(lines) if line.startswith("|---")}
    cells = [
        line.strip("|").split(" | ")[0].strip()
        for index, line in enumerate(lines)
        if line.startswith("| ") and index not in heads and not line.endswith("| once |")
    ]
    assert len(cells) == len(set(cells))
    return cells


def table(tested=TESTED):
    """Each entry with its tests as pairs of file and name."""
    found, entry = {}, ""
    for line in filter(None, tested.splitlines()):
        if line.startswith(" "):
            file, *names = line.split()
            found[entry] += [(file, name) for name in names]
        else:
            entry = line
            found[entry] = []
    return found


@functools.cache
def functions_of(file):
    tree = ast.parse(module_of_tests(file).read_text(encoding="utf-8"))
    functions = (ast.FunctionDef, ast.AsyncFunctionDef)
    return {node.name for node in ast.walk(tree) if isinstance(node, functions)}


def test_every_entry_has_its_tests():
    untested = [entry for entry in entries() if not table().get(entry)]
    assert untested == [], "write tests of these, and name them in TESTED above"
    gone = [entry for entry in table() if entry not in entries()]
    assert gone == [], "these are not on the page any more: change or delete them in TESTED above"


@pytest.mark.parametrize(
    ("file", "name"), sorted({pair for pairs in table().values() for pair in pairs})
)
def test_the_tests_are_there(file, name):
    assert name in functions_of(file)


# What no other room tests


def run(*command):
    return subprocess.run(
        [sys.executable, *command], capture_output=True, text=True, timeout=300, check=False
    )


def test_an_unknown_keyword_is_an_error_without_assertions_too():
    ended = run("-O", "-c", "from geometry_msgs.msg import Twist; Twist(lineer=1)")
    assert ended.returncode == 1
    assert "\nAssertionError: Invalid arguments passed to constructor: lineer\n" in ended.stderr


def test_bad_arguments_end_turtlesim_with_status_1():
    ended = run("-m", "turtlesim.turtlesim_node", "--ros-args", "-r", "a:=b:=c")
    assert ended.returncode == 1
    assert "Couldn't parse remap rule: '-r a:=b:=c'" in ended.stderr


def test_no_daemon_is_running(capsys):
    from ros2cli.main import main

    main(["daemon", "status"])
    assert capsys.readouterr().out == "The daemon is not running\n"
