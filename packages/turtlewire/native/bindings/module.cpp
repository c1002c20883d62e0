#include "errors.hpp"
#include "transform.hpp"
#include "types.hpp"

NB_MODULE(_native, module) {
  using namespace turtlewire::python;
  module.attr("__doc__") = "The compiled core of turtlewire. Use it through turtlewire.Buffer.";
  // Objects that a program or a daemon thread keeps until the process ends are not leaks that
  // nanobind should report.
  nb::set_leak_warnings(false);
  load_error_classes();
  if (!add_transform_type(module)) throw nb::python_error();
  add_buffer_type(module);
  add_message_lookup_type(module);
  add_intake_type(module);
  add_joint_types(module);
  add_record_walk_type(module);
  add_bag_message_types(module);
  add_cyclone_types(module);
  add_zenoh_types(module);
}
