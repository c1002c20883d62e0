// The methods of turtlewire.Buffer that inspect it, or change it other than by adding data.
#pragma once

#include <array>

#include "buffer.hpp"

namespace turtlewire::python {

// Entries of the method table.
std::array<PyMethodDef, 4> inspection_methods();

void add_inspection_methods(nb::class_<BufferObject>& cls);

}  // namespace turtlewire::python
