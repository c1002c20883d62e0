// Cyclone DDS from Python, without ctypes where that is too slow.
#pragma once

#include "python.hpp"

namespace turtlewire::python {

void add_cyclone_types(nb::module_& module);

}  // namespace turtlewire::python
