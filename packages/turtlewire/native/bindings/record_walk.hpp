// The Python class _native.RecordWalk: a bag's chunks into a buffer.
#pragma once

#include "python.hpp"

namespace turtlewire::python {

void add_record_walk_type(nb::module_& module);

}  // namespace turtlewire::python
