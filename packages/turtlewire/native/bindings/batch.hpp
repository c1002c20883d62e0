// The methods of turtlewire.Buffer that take and give NumPy arrays.
#pragma once

#include "buffer.hpp"

namespace turtlewire::python {

void add_batch_methods(nb::class_<BufferObject>& cls);

}  // namespace turtlewire::python
