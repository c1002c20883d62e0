// The methods of turtlewire.Buffer by subject: entries of its method table, and slower ones.
#pragma once

#include <array>

#include "buffer.hpp"

namespace turtlewire::python {

// Those that add data.
std::array<PyMethodDef, 4> addition_methods();

// Those that take and give NumPy arrays.
std::array<PyMethodDef, 4> batch_methods();

// Those that take or return whole histories of a frame as arrays.
std::array<PyMethodDef, 2> history_methods();
void add_history_methods(nb::class_<BufferObject>& cls);

// Those that inspect the buffer, or change it other than by adding data.
std::array<PyMethodDef, 4> inspection_methods();
void add_inspection_methods(nb::class_<BufferObject>& cls);

}  // namespace turtlewire::python
