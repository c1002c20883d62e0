// turtlewire.Transform: the light result of a lookup.
#pragma once

#include "../core/shared_buffer.hpp"
#include "python.hpp"

namespace turtlewire::python {

// Adds the type to the module; false with a Python error set.
bool add_transform_type(nb::module_& module);

// A new Transform; takes new references to the two names.
PyObject* make_transform(PyObject* target, PyObject* source, const Found& found);

}  // namespace turtlewire::python
