// The methods of turtlewire.Buffer that look into it, and change it by other ways than new data.
#pragma once

#include "buffer.hpp"

namespace turtlewire::python {

void add_inspection_methods(nb::class_<BufferObject>& cls);

}  // namespace turtlewire::python
