// Lookups that return real geometry_msgs/msg/TransformStamped objects.
#pragma once

#include "python.hpp"

namespace turtlewire::python {

void add_message_lookup_type(nb::module_& module);

}  // namespace turtlewire::python
