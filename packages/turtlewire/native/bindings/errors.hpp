// Raises the exceptions of turtlewire.errors.
#pragma once

#include <Python.h>

#include <string>

#include "../core/failure.hpp"

namespace turtlewire::python {

// Call once, when this module is imported; throws nb::python_error.
void load_error_classes();

// Sets the Python error for a question that has no answer. `buffer` is the Python object that was
// asked; it tells the names of frames, should somebody want a hint. Always returns null, for
// `return raise(...)`.
PyObject* raise(const Failure& failure, Question question, PyObject* buffer);
PyObject* raise_cdr_error(const std::string& what);

}  // namespace turtlewire::python
