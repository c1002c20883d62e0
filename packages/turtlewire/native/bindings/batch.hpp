// The methods of turtlewire.Buffer that take and give NumPy arrays.
#pragma once

#include <array>

#include "python.hpp"

namespace turtlewire::python {

// Entries of the method table.
std::array<PyMethodDef, 4> batch_methods();

}  // namespace turtlewire::python
