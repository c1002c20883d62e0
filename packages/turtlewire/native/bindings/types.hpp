// What each subject adds to the module _native.
#pragma once

#include "python.hpp"

namespace turtlewire::python {

void add_bag_message_types(nb::module_& module);
void add_buffer_type(nb::module_& module);
void add_cyclone_types(nb::module_& module);
void add_intake_type(nb::module_& module);
void add_joint_types(nb::module_& module);
void add_message_lookup_type(nb::module_& module);
void add_record_walk_type(nb::module_& module);
void add_zenoh_types(nb::module_& module);

}  // namespace turtlewire::python
