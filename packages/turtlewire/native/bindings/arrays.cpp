#include "arrays.hpp"

#include <nanobind/stl/string.h>

namespace turtlewire::python {
namespace {

nb::object checked(PyObject* result) {
  if (result == nullptr) throw nb::python_error();
  return nb::steal(result);
}

// NumPy's `function`, which converts what it is given.
nb::object convert(const char* function, nb::handle object, const char* dtype) {
  return checked(taking_gil([=]() -> PyObject* {
    PyObject* numpy = PyImport_ImportModule("numpy");
    if (numpy == nullptr) return nullptr;
    PyObject* array = PyObject_CallMethod(numpy, function, "(Oz)", object.ptr(), dtype);
    Py_DECREF(numpy);
    return array;
  }));
}

// datetime64 of any unit as int64 nanoseconds.
nb::object of_datetimes(const nb::object& array) {
  return checked(taking_gil([&array]() -> PyObject* {
    PyObject* module = PyImport_ImportModule("turtlewire.tf.datetimes");
    if (module == nullptr) return nullptr;
    PyObject* result = PyObject_CallMethod(module, "nanoseconds_array", "(O)", array.ptr());
    Py_DECREF(module);
    return result;
  }));
}

void check_maximum(const nb::object& array) {
  const nb::object maximum =
      checked(taking_gil([&array] { return PyObject_CallMethod(array.ptr(), "max", nullptr); }));
  if (PyLong_AsLongLong(maximum.ptr()) == -1 && PyErr_Occurred() != nullptr) {
    PyErr_SetString(PyExc_OverflowError, "stamps do not fit into 64 bits (int64 nanoseconds)");
    throw nb::python_error();
  }
}

}  // namespace

nb::object contiguous_array(nb::handle object, const char* dtype) {
  return convert("ascontiguousarray", object, dtype);
}

Stamps stamps_of(nb::handle object) {
  Stamps stamps;
  if (is_array(object, stamps)) return stamps;
  nb::object array = convert("asarray", object, nullptr);
  if (nb::cast<std::string>(array.attr("dtype").attr("kind")) == "M") array = of_datetimes(array);
  const std::string kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
  const bool is_empty = nb::cast<std::size_t>(array.attr("size")) == 0;
  if (kind != "i" && kind != "u" && !is_empty)
    throw nb::type_error("stamps must be integers (nanoseconds)");
  if (kind == "u" && !is_empty) check_maximum(array);
  const nb::object plain = contiguous_array(array, "int64");
  if (nb::cast<int>(plain.attr("ndim")) != 1 || nb::cast<int>(array.attr("ndim")) != 1) {
    throw nb::value_error("stamps must be one-dimensional");
  }
  return nb::cast<Stamps>(plain);
}

}  // namespace turtlewire::python
