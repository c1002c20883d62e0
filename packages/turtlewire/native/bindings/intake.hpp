// Cyclone DDS hands messages to buffers, without Python.
#pragma once

#include "python.hpp"

namespace turtlewire::python {

void add_intake_type(nb::module_& module);

}  // namespace turtlewire::python
