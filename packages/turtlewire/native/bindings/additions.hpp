// The hot methods of turtlewire.Buffer that add data.
#pragma once

#include <array>

#include "python.hpp"

namespace turtlewire::python {

// Entries of the method table.
std::array<PyMethodDef, 4> addition_methods();

}  // namespace turtlewire::python
