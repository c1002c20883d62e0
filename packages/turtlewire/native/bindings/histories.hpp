// The methods of turtlewire.Buffer that take or return whole histories of a frame as arrays.
#pragma once

#include <array>

#include "buffer.hpp"

namespace turtlewire::python {

// Entries of the method table.
std::array<PyMethodDef, 2> history_methods();

void add_history_methods(nb::class_<BufferObject>& cls);

}  // namespace turtlewire::python
