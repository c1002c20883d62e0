"""The public surface of ROS 2 Jazzy's rclpy, name by name, with parameters and defaults.

A table says what is there in ROS 2. Ours may take more keywords, with defaults; it may not lack
one, or have another default.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import re
from pathlib import Path

import pytest

import rclpy.node
import rclpy.qos
from rclpy.clock import ClockType
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy.qos import QoSProfile

# `module` or `module.Class`, and below it what it has, each with its parameters; `self` and `cls`
# are left out.
FUNCTIONS = """
rclpy
  init(*, args=None, context=None, domain_id=None, signal_handler_options=None)
  shutdown(*, context=None, uninstall_handlers=None)
  try_shutdown(*, context=None)
  ok(*, context=None)
  get_default_context(*, shutting_down=False)
  get_global_executor()
  create_node(node_name, *, context=None, cli_args=None, namespace=None, use_global_arguments=True, enable_rosout=True, start_parameter_services=True, parameter_overrides=None, allow_undeclared_parameters=False, automatically_declare_parameters_from_overrides=False, enable_logger_service=False)
  spin(node, executor=None)
  spin_once(node, *, executor=None, timeout_sec=None)
  spin_until_future_complete(node, future, executor=None, timeout_sec=None)
  Context() from rclpy.context
  Future(*, executor=None) from rclpy.task
  Parameter(name, type_=None, value=None) from rclpy.parameter
  get_rmw_implementation_identifier() from rclpy.utilities
rclpy.utilities
  get_default_context(*, shutting_down=False)
  remove_ros_args(args=None)
  ok(*, context=None)
  shutdown(*, context=None)
  try_shutdown(*, context=None)
  get_rmw_implementation_identifier()
  get_available_rmw_implementations()
  timeout_sec_to_nsec(timeout_sec)
rclpy.node
  Node(node_name, *, context=None, cli_args=None, namespace=None, use_global_arguments=True, enable_rosout=True, start_parameter_services=True, parameter_overrides=None, allow_undeclared_parameters=False, automatically_declare_parameters_from_overrides=False, enable_logger_service=False)
rclpy.node.Node
  create_publisher(msg_type, topic, qos_profile, *, callback_group=None, event_callbacks=None, qos_overriding_options=None, publisher_class=Publisher)
  create_subscription(msg_type, topic, callback, qos_profile, *, callback_group=None, event_callbacks=None, qos_overriding_options=None, raw=False, content_filter_options=None)
  create_client(srv_type, srv_name, *, qos_profile=qos_profile_services_default, callback_group=None)
  create_service(srv_type, srv_name, callback, *, qos_profile=qos_profile_services_default, callback_group=None)
  create_timer(timer_period_sec, callback, callback_group=None, clock=None, autostart=True)
  create_rate(frequency, clock=None)
  create_guard_condition(callback, callback_group=None)
  destroy_publisher(publisher)
  destroy_subscription(subscription)
  destroy_client(client)
  destroy_service(service)
  destroy_timer(timer)
  destroy_guard_condition(guard)
  destroy_rate(rate)
  destroy_node()
  add_waitable(waitable)
  remove_waitable(waitable)
  get_name()
  get_namespace()
  get_fully_qualified_name()
  get_clock()
  get_logger()
  get_topic_names_and_types(no_demangle=False)
  get_service_names_and_types()
  get_node_names()
  get_node_names_and_namespaces()
  get_node_names_and_namespaces_with_enclaves()
  get_fully_qualified_node_names()
  get_publisher_names_and_types_by_node(node_name, node_namespace, no_demangle=False)
  get_subscriber_names_and_types_by_node(node_name, node_namespace, no_demangle=False)
  get_service_names_and_types_by_node(node_name, node_namespace)
  get_client_names_and_types_by_node(node_name, node_namespace)
  count_publishers(topic_name)
  count_subscribers(topic_name)
  count_clients(service_name)
  count_services(service_name)
  get_publishers_info_by_topic(topic_name, no_mangle=False)
  get_subscriptions_info_by_topic(topic_name, no_mangle=False)
  wait_for_node(fully_qualified_node_name, timeout)
  resolve_topic_name(topic, *, only_expand=False)
  resolve_service_name(service, *, only_expand=False)
  declare_parameter(name, value=None, descriptor=None, ignore_override=False)
  declare_parameters(namespace, parameters, ignore_override=False)
  undeclare_parameter(name)
  has_parameter(name)
  get_parameter(name)
  get_parameters(names)
  get_parameter_or(name, alternative_value=None)
  get_parameters_by_prefix(prefix)
  get_parameter_type(name)
  get_parameter_types(names)
  set_parameters(parameter_list)
  set_parameters_atomically(parameter_list)
  list_parameters(prefixes, depth)
  describe_parameter(name)
  describe_parameters(names)
  set_descriptor(name, descriptor, alternative_value=None)
  add_pre_set_parameters_callback(callback)
  add_on_set_parameters_callback(callback)
  add_post_set_parameters_callback(callback)
  remove_pre_set_parameters_callback(callback)
  remove_on_set_parameters_callback(callback)
  remove_post_set_parameters_callback(callback)
rclpy.publisher.Publisher
  publish(msg)
  get_subscription_count()
  assert_liveliness()
  wait_for_all_acked(timeout=Duration(seconds=-1))
  destroy()
rclpy.subscription.Subscription
  get_publisher_count()
  destroy()
rclpy.subscription_content_filter_options
  ContentFilterOptions(filter_expression, expression_parameters)
rclpy.client.Client
  call(request, timeout_sec=None)
  call_async(request)
  remove_pending_request(future)
  service_is_ready()
  wait_for_service(timeout_sec=None)
  configure_introspection(clock, service_event_qos_profile, introspection_state)
  destroy()
rclpy.service.Service
  send_response(response, header)
  configure_introspection(clock, service_event_qos_profile, introspection_state)
  destroy()
rclpy.timer
  Timer(callback, callback_group, timer_period_ns, clock, *, context=None, autostart=True)
  Rate(timer, *, context)
rclpy.timer.Timer
  is_ready()
  is_canceled()
  cancel()
  reset()
  time_since_last_call()
  time_until_next_call()
  destroy()
rclpy.timer.Rate
  sleep()
  destroy()
rclpy.guard_condition
  GuardCondition(callback, callback_group, context=None)
rclpy.guard_condition.GuardCondition
  trigger()
  destroy()
rclpy.waitable
  Waitable(callback_group)
  NumberOfEntities(num_subs=0, num_gcs=0, num_timers=0, num_clients=0, num_services=0, num_events=0)
rclpy.waitable.Waitable
  is_ready(wait_set)
  take_data()
  execute(taken_data)
  get_num_entities()
  add_to_wait_set(wait_set)
  add_future(future)
rclpy.callback_groups
  CallbackGroup()
  MutuallyExclusiveCallbackGroup()
  ReentrantCallbackGroup()
rclpy.callback_groups.CallbackGroup
  add_entity(entity)
  has_entity(entity)
  can_execute(entity)
  beginning_execution(entity)
  ending_execution(entity)
rclpy.executors
  Executor(*, context=None)
  SingleThreadedExecutor(*, context=None)
  MultiThreadedExecutor(num_threads=None, *, context=None)
  ExternalShutdownException(*args)
  await_or_execute(callback, *args)
rclpy.executors.Executor
  add_node(node)
  remove_node(node)
  get_nodes()
  spin()
  spin_once(timeout_sec=None)
  spin_until_future_complete(future, timeout_sec=None)
  spin_once_until_future_complete(future, timeout_sec=None)
  create_task(callback, *args, **kwargs)
  wake()
  shutdown(timeout_sec=None)
  can_execute(entity)
  wait_for_ready_callbacks(timeout_sec=None)
rclpy.experimental
  EventsExecutor(*, context=None) from rclpy.experimental.events_executor
rclpy.task
  Future(*, executor=None)
  Task(handler, args=None, kwargs=None, executor=None)
rclpy.task.Future
  result()
  exception()
  done()
  cancelled()
  cancel()
  set_result(result)
  set_exception(exception)
  add_done_callback(callback)
rclpy.task.Task
  executing()
  cancel()
rclpy.context
  Context()
rclpy.context.Context
  init(args=None, *, initialize_logging=True, domain_id=None)
  ok()
  shutdown()
  try_shutdown()
  on_shutdown(callback)
  get_domain_id()
rclpy.signals
  install_signal_handlers(options=SignalHandlerOptions.ALL)
  uninstall_signal_handlers()
  get_current_signal_handlers_options()
rclpy.action
  ActionClient(node, action_type, action_name, *, callback_group=None, goal_service_qos_profile=qos_profile_services_default, result_service_qos_profile=qos_profile_services_default, cancel_service_qos_profile=qos_profile_services_default, feedback_sub_qos_profile=QoSProfile(depth=10), status_sub_qos_profile=qos_profile_action_status_default) from rclpy.action.client
  ActionServer(node, action_type, action_name, execute_callback, *, callback_group=None, goal_callback=default_goal_callback, handle_accepted_callback=default_handle_accepted_callback, cancel_callback=default_cancel_callback, goal_service_qos_profile=qos_profile_services_default, result_service_qos_profile=qos_profile_services_default, cancel_service_qos_profile=qos_profile_services_default, feedback_pub_qos_profile=QoSProfile(depth=10), status_pub_qos_profile=qos_profile_action_status_default, result_timeout=900) from rclpy.action.server
  get_action_names_and_types(node)
  get_action_client_names_and_types_by_node(node, remote_node_name, remote_node_namespace)
  get_action_server_names_and_types_by_node(node, remote_node_name, remote_node_namespace)
rclpy.action.client.ActionClient
  send_goal(goal, feedback_callback=None, goal_uuid=None)
  send_goal_async(goal, feedback_callback=None, goal_uuid=None)
  server_is_ready()
  wait_for_server(timeout_sec=None)
  destroy()
rclpy.action.client.ClientGoalHandle
  cancel_goal()
  cancel_goal_async()
  get_result()
  get_result_async()
rclpy.action.server.ActionServer
  notify_execute(goal_handle, execute_callback)
  notify_goal_done()
  register_handle_accepted_callback(handle_accepted_callback)
  register_goal_callback(goal_callback)
  register_cancel_callback(cancel_callback)
  register_execute_callback(execute_callback)
  destroy()
rclpy.action.server.ServerGoalHandle
  execute(execute_callback=None)
  publish_feedback(feedback)
  succeed()
  abort()
  canceled()
  destroy()
rclpy.qos
  QoSProfile(**kwargs)
  qos_check_compatible(publisher_qos, subscription_qos)
  qos_policy_name_from_kind(policy_kind)
  InvalidQoSProfileException(*args)
rclpy.qos.QoSPresetProfiles
  short_keys()
  get_from_short_key(name)
rclpy.qos.ReliabilityPolicy
  short_keys()
  get_from_short_key(name)
rclpy.qos_overriding_options
  QoSOverridingOptions(policy_kinds, *, callback=None, entity_id=None)
rclpy.qos_overriding_options.QoSOverridingOptions
  with_default_policies(*, callback=None, entity_id=None)
rclpy.event_handler
  PublisherEventCallbacks(*, deadline=None, liveliness=None, incompatible_qos=None, incompatible_type=None, matched=None, use_default_callbacks=True)
  SubscriptionEventCallbacks(*, deadline=None, liveliness=None, incompatible_qos=None, message_lost=None, incompatible_type=None, matched=None, use_default_callbacks=True)
  QoSDeadlineRequestedInfo(total_count, total_count_change)
  QoSDeadlineOfferedInfo(total_count, total_count_change)
  QoSLivelinessChangedInfo(alive_count, not_alive_count, alive_count_change, not_alive_count_change)
  QoSLivelinessLostInfo(total_count, total_count_change)
  QoSMessageLostInfo(total_count, total_count_change)
  QoSRequestedIncompatibleQoSInfo(total_count, total_count_change, last_policy_kind)
  QoSOfferedIncompatibleQoSInfo(total_count, total_count_change, last_policy_kind)
  QoSSubscriptionMatchedInfo(total_count, total_count_change, current_count, current_count_change)
  QoSPublisherMatchedInfo(total_count, total_count_change, current_count, current_count_change)
  IncompatibleTypeInfo(total_count, total_count_change)
rclpy.time
  Time(*, seconds=0, nanoseconds=0, clock_type=ClockType.SYSTEM_TIME)
rclpy.time.Time
  seconds_nanoseconds()
  to_msg()
  from_msg(msg, clock_type=ClockType.ROS_TIME)
rclpy.duration
  Duration(*, seconds=0, nanoseconds=0)
rclpy.duration.Duration
  to_msg()
  from_msg(msg)
rclpy.clock
  Clock(*, clock_type=ClockType.SYSTEM_TIME)
  ROSClock()
  JumpThreshold(*, min_forward, min_backward, on_clock_change=True)
  TimeJump(clock_change, delta)
  JumpHandle(*, clock, threshold, pre_callback, post_callback)
rclpy.clock.Clock
  now()
  sleep_until(until, context=None)
  sleep_for(rel_time, context=None)
  create_jump_callback(threshold, *, pre_callback=None, post_callback=None)
rclpy.clock.ROSClock
  set_ros_time_override(time)
rclpy.clock.JumpHandle
  unregister()
rclpy.time_source
  TimeSource(*, node=None)
rclpy.time_source.TimeSource
  attach_node(node)
  detach_node()
  attach_clock(clock)
  clock_callback(msg)
rclpy.parameter
  Parameter(name, type_=None, value=None)
  get_parameter_value(string_value)
  parameter_value_to_python(parameter_value)
  parameter_dict_from_yaml_file(parameter_file, use_wildcard=False, target_nodes=None, namespace='')
rclpy.parameter.Parameter
  from_parameter_msg(param_msg)
  to_parameter_msg()
  get_parameter_value()
rclpy.parameter.Parameter.Type
  from_parameter_value(parameter_value)
  check(parameter_value)
rclpy.parameter_client
  AsyncParameterClient(node, remote_node_name, qos_profile=qos_profile_services_default, callback_group=None)
rclpy.parameter_client.AsyncParameterClient
  services_are_ready()
  wait_for_services(timeout_sec=None)
  list_parameters(prefixes=None, depth=None, callback=None)
  get_parameters(names, callback=None)
  set_parameters(parameters, callback=None)
  describe_parameters(names, callback=None)
  get_parameter_types(names, callback=None)
  set_parameters_atomically(parameters, callback=None)
  delete_parameters(names, callback=None)
  load_parameter_file(parameter_file, use_wildcard=False, callback=None)
  load_parameter_file_atomically(parameter_file, use_wildcard=False, callback=None)
rclpy.parameter_event_handler
  ParameterEventHandler(node, qos_profile=qos_profile_parameter_events)
  ParameterCallbackHandle(parameter_name, node_name, callback)
  ParameterEventCallbackHandle(callback)
rclpy.parameter_event_handler.ParameterEventHandler
  destroy()
  add_parameter_event_callback(callback)
  remove_parameter_event_callback(handle)
  add_parameter_callback(parameter_name, node_name, callback)
  remove_parameter_callback(handle)
  get_parameter_from_event(event, parameter_name, node_name)
  get_parameters_from_event(event)
rclpy.logging
  get_logger(name)
  set_logger_level(name, level, detailed_error=False)
  get_logger_level(name)
  get_logger_effective_level(name)
  get_logging_severity_from_string(log_severity)
  get_logging_directory()
  initialize()
  shutdown()
  clear_config()
rclpy.impl.rcutils_logger
  RcutilsLogger(name='', namespace='')
rclpy.impl.rcutils_logger.RcutilsLogger
  get_child(name)
  set_level(level)
  get_effective_level()
  is_enabled_for(severity)
  log(message, severity, **kwargs)
  debug(message, **kwargs)
  info(message, **kwargs)
  warning(message, **kwargs)
  warn(message, **kwargs)
  error(message, **kwargs)
  fatal(message, **kwargs)
rclpy.wait_for_message
  wait_for_message(msg_type, node, topic, *, qos_profile=1, time_to_wait=-1)
rclpy.serialization
  serialize_message(message)
  deserialize_message(serialized_message, message_type)
rclpy.expand_topic_name
  expand_topic_name(topic_name, node_name, node_namespace)
rclpy.topic_or_service_is_hidden
  topic_or_service_is_hidden(name)
rclpy.validate_node_name
  validate_node_name(node_name)
rclpy.validate_namespace
  validate_namespace(namespace)
rclpy.validate_topic_name
  validate_topic_name(name, *, is_service=False)
rclpy.validate_full_topic_name
  validate_full_topic_name(name, *, is_service=False)
rclpy.validate_parameter_name
  validate_parameter_name(name)
rclpy.type_support
  check_for_type_support(msg_or_srv_type)
  check_is_valid_msg_type(msg_type)
  check_is_valid_srv_type(srv_type)
rclpy.topic_endpoint_info
  TopicEndpointInfo(**kwargs)
rclpy.type_hash
  TypeHash(version=-1, value=bytes(32))
rclpy.type_description_service
  TypeDescriptionService(node)
rclpy.logging_service
  LoggingService(node)
rclpy.parameter_service
  ParameterService(node)
rclpy.lifecycle
  LifecycleNode(node_name, *, enable_communication_interface=True, **kwargs) from rclpy.lifecycle.node
  LifecycleNodeMixin(*, enable_communication_interface=True, callback_group=None) from rclpy.lifecycle.node
  LifecyclePublisher(*args, **kwargs) from rclpy.lifecycle.publisher
  LifecycleState(label, state_id)
  ManagedEntity() from rclpy.lifecycle.managed_entity
  SimpleManagedEntity() from rclpy.lifecycle.managed_entity
rclpy.lifecycle.LifecycleNode
  create_lifecycle_publisher(*args, **kwargs)
  destroy_lifecycle_publisher(publisher)
  add_managed_entity(entity)
  trigger_configure()
  trigger_activate()
  trigger_deactivate()
  trigger_cleanup()
  trigger_shutdown()
  register_on_configure(cb)
  register_on_activate(cb)
  register_on_deactivate(cb)
  register_on_cleanup(cb)
  register_on_shutdown(cb)
  register_on_error(cb)
rclpy.lifecycle.ManagedEntity
  on_configure(state)
  on_activate(state)
  on_deactivate(state)
  on_cleanup(state)
  on_shutdown(state)
  on_error(state)
rclpy.exceptions
  NotInitializedException(msg=None)
  NoTypeSupportImportedException(*args)
  NameValidationException(name_type, name, error_msg, invalid_index, *args)
  InvalidNamespaceException(name, error_msg, invalid_index, *args)
  InvalidNodeNameException(name, error_msg, invalid_index, *args)
  InvalidTopicNameException(name, error_msg, invalid_index, *args)
  InvalidServiceNameException(name, error_msg, invalid_index, *args)
  ParameterException(error_msg, parameters, *args)
  ParameterNotDeclaredException(parameters, *args)
  ParameterAlreadyDeclaredException(parameters, *args)
  InvalidParameterException(parameter, *args)
  InvalidParameterTypeException(desired_parameter, expected_type)
  InvalidParameterValueException(parameter, value, reason)
  ParameterImmutableException(parameter, *args)
  ParameterUninitializedException(parameter, *args)
  ROSInterruptException(*args)
"""

# What a class has as a property, a class attribute or an attribute of its instances; `=` marks
# those that can be set.
PROPERTIES = """
rclpy.node.Node: publishers subscriptions clients services timers guards waitables executor= context default_callback_group handle PARAM_REL_TOL
rclpy.publisher.Publisher: topic_name logger_name handle
rclpy.subscription.Subscription: topic_name handle callback= is_cft_enabled CallbackType
rclpy.client.Client: service_name logger_name handle
rclpy.service.Service: service_name logger_name handle
rclpy.timer.Timer: timer_period_ns= clock handle
rclpy.guard_condition.GuardCondition: handle
rclpy.waitable.NumberOfEntities: num_subscriptions= num_guard_conditions= num_timers= num_clients= num_services= num_events=
rclpy.executors.Executor: context
rclpy.context.Context: handle
rclpy.time.Time: nanoseconds clock_type
rclpy.duration.Duration: nanoseconds
rclpy.clock.Clock: clock_type
rclpy.clock.ROSClock: ros_time_is_active
rclpy.clock.TimeJump: clock_change delta
rclpy.time_source.TimeSource: ros_time_is_active=
rclpy.parameter.Parameter: name type_ value Type
rclpy.qos.QoSProfile: history= depth= reliability= durability= lifespan= deadline= liveliness= liveliness_lease_duration= avoid_ros_namespace_conventions=
rclpy.qos.ReliabilityPolicy: short_key
rclpy.qos_overriding_options.QoSOverridingOptions: policy_kinds callback entity_id
rclpy.topic_endpoint_info.TopicEndpointInfo: node_name= node_namespace= topic_type= topic_type_hash= endpoint_type= endpoint_gid= qos_profile=
rclpy.type_hash.TypeHash: version= value=
rclpy.action.client.ClientGoalHandle: goal_id stamp accepted status
rclpy.action.server.ActionServer: action_type
rclpy.action.server.ServerGoalHandle: request goal_id is_active is_cancel_requested status
rclpy.lifecycle.SimpleManagedEntity: is_activated when_enabled
"""

CONSTANTS = """
rclpy.signals.SignalHandlerOptions: NO=0 SIGINT=1 SIGTERM=2 ALL=3
rclpy.qos.HistoryPolicy: SYSTEM_DEFAULT=0 KEEP_LAST=1 KEEP_ALL=2 UNKNOWN=3
rclpy.qos.ReliabilityPolicy: SYSTEM_DEFAULT=0 RELIABLE=1 BEST_EFFORT=2 UNKNOWN=3 BEST_AVAILABLE=4
rclpy.qos.DurabilityPolicy: SYSTEM_DEFAULT=0 TRANSIENT_LOCAL=1 VOLATILE=2 UNKNOWN=3 BEST_AVAILABLE=4
rclpy.qos.LivelinessPolicy: SYSTEM_DEFAULT=0 AUTOMATIC=1 MANUAL_BY_TOPIC=3 UNKNOWN=4 BEST_AVAILABLE=5
rclpy.qos.QoSPolicyKind: INVALID=1 DURABILITY=2 DEADLINE=4 LIVELINESS=8 RELIABILITY=16 HISTORY=32 LIFESPAN=64 DEPTH=128 LIVELINESS_LEASE_DURATION=256 AVOID_ROS_NAMESPACE_CONVENTIONS=512
rclpy.qos.QoSCompatibility: OK=0 WARNING=1 ERROR=2
rclpy.clock_type.ClockType: UNINITIALIZED=0 ROS_TIME=1 SYSTEM_TIME=2 STEADY_TIME=3
rclpy.clock.ClockChange: ROS_TIME_NO_CHANGE=1 ROS_TIME_ACTIVATED=2 ROS_TIME_DEACTIVATED=3 SYSTEM_TIME_NO_CHANGE=4
rclpy.parameter.Parameter.Type: NOT_SET=0 BOOL=1 INTEGER=2 DOUBLE=3 STRING=4 BYTE_ARRAY=5 BOOL_ARRAY=6 INTEGER_ARRAY=7 DOUBLE_ARRAY=8 STRING_ARRAY=9
rclpy.logging.LoggingSeverity: UNSET=0 DEBUG=10 INFO=20 WARN=30 ERROR=40 FATAL=50
rclpy.service_introspection.ServiceIntrospectionState: OFF=0 METADATA=1 CONTENTS=2
rclpy.topic_endpoint_info.TopicEndpointTypeEnum: INVALID=0 PUBLISHER=1 SUBSCRIPTION=2
rclpy.action.GoalResponse: REJECT=1 ACCEPT=2
rclpy.action.CancelResponse: REJECT=1 ACCEPT=2
rclpy.lifecycle.TransitionCallbackReturn: SUCCESS=97 FAILURE=98 ERROR=99
rclpy.event_handler.QoSPublisherEventType: RCL_PUBLISHER_OFFERED_DEADLINE_MISSED=0 RCL_PUBLISHER_LIVELINESS_LOST=1 RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS=2 RCL_PUBLISHER_INCOMPATIBLE_TYPE=3 RCL_PUBLISHER_MATCHED=4
rclpy.event_handler.QoSSubscriptionEventType: RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED=0 RCL_SUBSCRIPTION_LIVELINESS_CHANGED=1 RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS=2 RCL_SUBSCRIPTION_MESSAGE_LOST=3 RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE=4 RCL_SUBSCRIPTION_MATCHED=5
action_msgs.msg.GoalStatus: STATUS_UNKNOWN=0 STATUS_ACCEPTED=1 STATUS_EXECUTING=2 STATUS_CANCELING=3 STATUS_SUCCEEDED=4 STATUS_CANCELED=5 STATUS_ABORTED=6
"""

# Error: base class. Where a name is reachable in several places, each place is listed.
ERRORS = """
rclpy.exceptions.NotInitializedException: Exception
rclpy.exceptions.NoTypeSupportImportedException: Exception
rclpy.exceptions.NameValidationException: Exception
rclpy.exceptions.InvalidNamespaceException: NameValidationException
rclpy.exceptions.InvalidNodeNameException: NameValidationException
rclpy.exceptions.InvalidTopicNameException: NameValidationException
rclpy.exceptions.InvalidServiceNameException: NameValidationException
rclpy.exceptions.ParameterException: Exception
rclpy.exceptions.ParameterNotDeclaredException: ParameterException
rclpy.exceptions.ParameterAlreadyDeclaredException: ParameterException
rclpy.exceptions.InvalidParameterException: ParameterException
rclpy.exceptions.InvalidParameterTypeException: ParameterException
rclpy.exceptions.InvalidParameterValueException: ParameterException
rclpy.exceptions.ParameterImmutableException: ParameterException
rclpy.exceptions.ParameterUninitializedException: ParameterException
rclpy.exceptions.ROSInterruptException: Exception
rclpy.exceptions.InvalidHandle: RuntimeError
rclpy.executors.TimeoutException: Exception
rclpy.executors.ShutdownException: Exception
rclpy.executors.ExternalShutdownException: Exception
rclpy.executors.ConditionReachedException: Exception
rclpy.qos.InvalidQoSProfileException: Exception
rclpy.qos_overriding_options.InvalidQosOverridesError: Exception
rclpy.node.NodeNameNonExistentError: RCLError
rclpy.event_handler.UnsupportedEventTypeError: RCLError
rclpy._rclpy_pybind11.RCLError: RuntimeError
rclpy._rclpy_pybind11.RMWError: RuntimeError
rclpy._rclpy_pybind11.InvalidHandle: RuntimeError
rclpy._rclpy_pybind11.UnknownROSArgsError: RuntimeError
rclpy._rclpy_pybind11.RCLInvalidROSArgsError: RCLError
rclpy._rclpy_pybind11.NodeNameNonExistentError: RCLError
rclpy._rclpy_pybind11.UnsupportedEventTypeError: RCLError
rclpy._rclpy_pybind11.TimerCancelledError: RCLError
"""

ALIASES = """
rclpy.qos.QoSHistoryPolicy = rclpy.qos.HistoryPolicy
rclpy.qos.QoSReliabilityPolicy = rclpy.qos.ReliabilityPolicy
rclpy.qos.QoSDurabilityPolicy = rclpy.qos.DurabilityPolicy
rclpy.qos.QoSLivelinessPolicy = rclpy.qos.LivelinessPolicy
rclpy.lifecycle.Node = rclpy.lifecycle.LifecycleNode
rclpy.lifecycle.NodeMixin = rclpy.lifecycle.LifecycleNodeMixin
rclpy.lifecycle.Publisher = rclpy.lifecycle.LifecyclePublisher
rclpy.lifecycle.State = rclpy.lifecycle.LifecycleState
rclpy.clock.ClockType = rclpy.clock_type.ClockType
rclpy.impl.logging_severity.LoggingSeverity = rclpy.logging.LoggingSeverity
rclpy.impl.implementation_singleton.rclpy_implementation = rclpy._rclpy_pybind11
"""

QOS_PRESETS = """
default              KEEP_LAST       10    RELIABLE        VOLATILE
sensor_data          KEEP_LAST       5     BEST_EFFORT     VOLATILE
services_default     KEEP_LAST       10    RELIABLE        VOLATILE
parameters           KEEP_LAST       1000  RELIABLE        VOLATILE
parameter_events     KEEP_LAST       1000  RELIABLE        VOLATILE
system_default       SYSTEM_DEFAULT  0     SYSTEM_DEFAULT  SYSTEM_DEFAULT
best_available       KEEP_LAST       10    BEST_AVAILABLE  BEST_AVAILABLE
action_status_default KEEP_LAST      1     RELIABLE        TRANSIENT_LOCAL
"""


def find(path):
    """What a dotted path names: modules first, then attributes."""
    parts = path.split(".")
    for count in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for name in parts[count:]:
            found = getattr(found, name)
        return found
    raise ModuleNotFoundError(path)


def functions():
    """Each callable of the table: its place, name and parameters, and its second module."""
    place = None
    for line in FUNCTIONS.strip().splitlines():
        if not line.startswith(" "):
            place = line
            continue
        name, parameters, elsewhere = re.fullmatch(
            r"  (\w+)\((.*)\)(?: from (\S+))?", line
        ).groups()
        yield pytest.param(place, name, parameters, elsewhere, id=f"{place}.{name}")


def rows(table):
    return [line.split(": ") for line in table.strip().splitlines()]


class Namespace(dict):
    """Gives the names in a default value of the table their meaning."""

    def __missing__(self, name):
        for module in ("rclpy.qos", "rclpy.publisher", "rclpy.signals", "rclpy.action.server"):
            if hasattr(find(module), name):
                return getattr(find(module), name)
        return (
            getattr(__builtins__, name)
            if not isinstance(__builtins__, dict)
            else __builtins__[name]
        )


def wanted_signature(parameters):
    made = Namespace(Duration=Duration, ClockType=ClockType, QoSProfile=QoSProfile)
    return inspect.signature(eval(f"lambda {parameters}: None", made))  # our own table


def our_parameters(place, name):
    parameters = dict(inspect.signature(getattr(find(place), name)).parameters)
    parameters.pop("self", None)
    return parameters


POSITIONAL = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)


@pytest.mark.parametrize(("place", "name", "parameters", "elsewhere"), list(functions()))
def test_signatures(place, name, parameters, elsewhere):
    wanted = wanted_signature(parameters).parameters
    ours = our_parameters(place, name)
    in_order = [key for key, parameter in ours.items() if parameter.kind in POSITIONAL]
    wanted_in_order = [key for key, parameter in wanted.items() if parameter.kind in POSITIONAL]
    assert in_order[: len(wanted_in_order)] == wanted_in_order
    for key, parameter in wanted.items():
        assert key in ours
        if parameter.kind not in POSITIONAL:
            assert ours[key].kind in (parameter.kind, *POSITIONAL)
        assert ours[key].default == parameter.default
    for key in ours.keys() - wanted.keys():
        assert ours[key].default is not inspect.Parameter.empty or ours[key].kind not in POSITIONAL
    if elsewhere:
        assert getattr(find(elsewhere), name) is getattr(find(place), name)


def test_how_much_is_in_the_tables():
    assert len(list(functions())) == 358
    assert sum(len(names.split()) for _, names in rows(PROPERTIES)) == 84
    assert sum(len(names.split()) for _, names in rows(CONSTANTS)) == 91
    assert len(rows(ERRORS)) == 33


@pytest.mark.parametrize(
    ("owner", "names"), rows(PROPERTIES), ids=[owner for owner, _ in rows(PROPERTIES)]
)
def test_properties(owner, names):
    for name in names.split():
        attribute = inspect.getattr_static(find(owner), name.rstrip("="))
        if name.endswith("="):
            assert not isinstance(attribute, property) or attribute.fset is not None, name


@pytest.mark.parametrize(
    ("owner", "members"), rows(CONSTANTS), ids=[owner for owner, _ in rows(CONSTANTS)]
)
def test_constants(owner, members):
    for name, number in (member.split("=") for member in members.split()):
        value = getattr(find(owner), name)
        assert getattr(value, "value", value) == int(number), name


@pytest.mark.parametrize(("path", "base"), rows(ERRORS), ids=[path for path, _ in rows(ERRORS)])
def test_errors(path, base):
    error = find(path)
    assert [each.__name__ for each in error.__mro__][1] == base
    assert error.__name__ == path.rpartition(".")[2]


@pytest.mark.parametrize("alias", ALIASES.strip().splitlines())
def test_aliases(alias):
    one, other = alias.split(" = ")
    assert find(one) is find(other)


@pytest.mark.parametrize("row", QOS_PRESETS.strip().splitlines(), ids=lambda row: row.split()[0])
def test_qos_presets(row):
    name, history, depth, reliability, durability = row.split()
    profile = getattr(rclpy.qos, f"qos_profile_{name}")
    assert (
        profile
        == rclpy.qos.QoSPresetProfiles[name.upper()].value
        == rclpy.qos.QoSPresetProfiles.get_from_short_key(name)
    )
    found = (
        profile.history.name,
        str(profile.depth),
        profile.reliability.name,
        profile.durability.name,
    )
    assert found == (history, depth, reliability, durability)


def test_what_every_made_thing_has(node):
    """Attributes that constructors set, which no class shows."""
    from rclpy.clock import JumpThreshold
    from std_msgs.msg import String
    from std_srvs.srv import Empty

    made = {
        node.create_publisher(String, "t", 1): "msg_type topic qos_profile event_handlers",
        node.create_subscription(
            String, "t", print, 1
        ): "msg_type topic callback callback_group raw qos_profile event_handlers",
        node.create_client(Empty, "s"): "srv_type srv_name qos_profile callback_group",
        node.create_service(
            Empty, "s", print
        ): "srv_type srv_name callback callback_group qos_profile",
        node.create_timer(1, print): "callback callback_group",
        node.create_guard_condition(print): "callback callback_group",
        JumpThreshold(
            min_forward=None, min_backward=None
        ): "min_forward min_backward on_clock_change",
    }
    for thing, names in made.items():
        for name in names.split():
            assert hasattr(thing, name), f"{thing}: {name}"


def test_handles_are_context_managers(node):
    """Programs write `with thing.handle:`, as rclpy itself does; that destroys nothing."""
    from std_msgs.msg import String

    publisher = node.create_publisher(String, "t", 1)
    subscription = node.create_subscription(String, "t", print, 1)
    with node.handle, publisher.handle, subscription.handle:
        pass
    assert publisher.topic_name == subscription.topic_name == "/t"
    assert node.create_publisher(String, "t", 1).topic_name == "/t"


def test_with_statements(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    with Context() as context:
        context.init(args=[])
        with SingleThreadedExecutor(context=context) as executor:
            assert executor.context is context
    assert not context.ok()


def test_a_subscription_says_that_nothing_is_filtered(node):
    from rclpy.subscription_content_filter_options import ContentFilterOptions
    from std_msgs.msg import String

    options = ContentFilterOptions(filter_expression="data = %0", expression_parameters=["'x'"])
    assert (
        node.create_subscription(
            String, "t", print, 1, content_filter_options=options
        ).is_cft_enabled
        is False
    )


# Private attributes that ROS 2's nodes have as well; programs know better than to take these names.
OF_ROS_2 = {
    "_callbacks",
    "_clock",
    "_context",
    "_logger",
    "_managed_entities",
    "_parameter_service",
    "_parameters",
    "_state_machine",
}
OF_ROS_2 |= {"_time_source", "_type_description_service"}


@pytest.mark.parametrize("kind", [Node, LifecycleNode])
def test_a_program_may_have_attributes_of_its_own(context, kind):
    """A class derived from Node may use any attribute name, for example `_name` or `_executor`."""
    node = kind("tested", context=context, enable_logger_service=True)
    private = {
        name
        for name in (*vars(node), *dir(kind))
        if name.startswith("_") and not name.startswith(("__", "_rclpy"))
    }
    assert {
        name
        for name in private - OF_ROS_2
        if not name.startswith(("_Node__", "_LifecycleNodeMixin__"))
    } == set()
    public = {name for name in dir(Node) if not name.startswith("_")}
    listed = {
        name
        for place, name, *_ in (row.values for row in functions())
        if place == "rclpy.node.Node"
    }
    assert public - listed == set(
        dict(rows(PROPERTIES))["rclpy.node.Node"].replace("=", "").split()
    )
    node.destroy_node()


def test_node_is_a_facade():
    """Each method of a node is one line onto the part that does the work."""
    (node_class,) = [
        each
        for each in ast.parse(Path(rclpy.node.__file__).read_text()).body
        if getattr(each, "name", "") == "Node"
    ]
    longer = set()
    for method in (each for each in node_class.body if isinstance(each, ast.FunctionDef)):
        work = [each for each in method.body if not isinstance(each, ast.ImportFrom)]
        if len(work) - (ast.get_docstring(method) is not None) != 1:
            longer.add(method.name)
    assert longer == {"__init__", "destroy_node", "executor"}
