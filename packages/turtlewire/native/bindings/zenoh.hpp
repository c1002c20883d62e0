// Messages that Zenoh's channels hold, for native sinks.
#pragma once

#include "python.hpp"

namespace turtlewire::python {

void add_zenoh_types(nb::module_& module);

}  // namespace turtlewire::python
