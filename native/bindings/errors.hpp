// Raises the exceptions of turtlewire.errors.
#pragma once

#include <Python.h>

#include <string>

#include "../core/failure.hpp"

namespace turtlewire::python {

// Sets the Python error for a question that has no answer. Always returns null, for `return raise(...)`.
PyObject* raise(const Failure& failure, Question question);
PyObject* raise_cdr_error(const std::string& what);

}  // namespace turtlewire::python
