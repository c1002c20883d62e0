// Raises the exceptions of turtlewire.errors.
#pragma once

#include <Python.h>

#include <cstddef>
#include <optional>
#include <string>

#include "../core/failure.hpp"

namespace turtlewire::python {

// Call once, when this module is imported; throws nb::python_error.
void load_error_classes();

// Sets the Python error for a question that has no answer. `buffer` is the Python object that was
// asked; it supplies the names of frames for the hint. Always returns null, for
// `return raise(...)`.
PyObject* raise(const Failure& failure, Question question, PyObject* buffer);
// The same for one of many stamps; the hint then mentions the argument `errors`.
PyObject* raise_in_batch(const Failure& failure, PyObject* buffer);
// The exception itself, not raised; null with a Python error set if there is no memory for it.
PyObject* make_error(const Failure& failure, Question question, PyObject* buffer);
// Sets the InvalidTransformError for a transform that was refused; `row` is its place in a batch.
PyObject* raise(const Refusal& refusal, std::optional<std::size_t> row = std::nullopt);
PyObject* raise_cdr_error(const std::string& what);

}  // namespace turtlewire::python
