#include "arrays.hpp"

#include <nanobind/stl/string.h>

namespace turtlewire::python {
namespace {

Stamps integers_of(nb::handle object) {
  Stamps stamps;
  if (is_array(object, stamps)) return stamps;
  return nb::cast<Stamps>(checked_array("stamp_array", object));
}

}  // namespace

nb::object checked_array(const char* function, nb::handle object) {
  PyObject* array = taking_gil([=]() -> PyObject* {
    PyObject* module = PyImport_ImportModule("turtlewire.tf.array_arguments");
    if (module == nullptr) return nullptr;
    PyObject* result = PyObject_CallMethod(module, function, "(O)", object.ptr());
    Py_DECREF(module);
    return result;
  });
  if (array == nullptr) throw nb::python_error();
  return nb::steal(array);
}

nb::object make_answer(const char* name, const nb::tuple& fields) {
  const nb::object answer = nb::steal(taking_gil([&]() -> PyObject* {
    PyObject* module = PyImport_ImportModule("turtlewire.tf.answers");
    if (module == nullptr) return nullptr;
    PyObject* type = PyObject_GetAttrString(module, name);
    Py_DECREF(module);
    PyObject* made = type == nullptr ? nullptr : PyObject_CallObject(type, fields.ptr());
    Py_XDECREF(type);
    return made;
  }));
  if (!answer.is_valid()) throw nb::python_error();
  return answer;
}

Stamps stamps_of(nb::handle object) {
  const Stamps stamps = integers_of(object);
  const Stamp* const end = stamps.data() + stamps.shape(0);
  if (std::find(stamps.data(), end, kLatest) != end)
    throw nb::value_error("a time is NaT (not a time)");
  return stamps;
}

}  // namespace turtlewire::python
