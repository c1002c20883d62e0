// The methods of turtlewire.Buffer that look into it, and change it by other ways than new data.
#pragma once

#include <array>

#include "buffer.hpp"

namespace turtlewire::python {

// Entries of the method table.
std::array<PyMethodDef, 4> inspection_methods();

void add_inspection_methods(nb::class_<BufferObject>& cls);

}  // namespace turtlewire::python
