#include "python.hpp"

namespace turtlewire::python {
namespace {

// What turtlewire.tf.datetimes makes of an object that is no int; it raises for most.
PyObject* from_datetime(PyObject* object, const char* what) {
  return taking_gil([=]() -> PyObject* {
    PyObject* module = PyImport_ImportModule("turtlewire.tf.datetimes");
    if (module == nullptr) return nullptr;
    PyObject* result = PyObject_CallMethod(module, "nanoseconds", "(Os)", object, what);
    Py_DECREF(module);
    return result;
  });
}

}  // namespace

bool raise_no_text(PyObject* object, const char* what) {
  PyObject* name = PyObject_GetAttrString(reinterpret_cast<PyObject*>(Py_TYPE(object)), "__name__");
  if (name != nullptr) PyErr_Format(PyExc_TypeError, "%s must be str, not %U", what, name);
  Py_XDECREF(name);
  return false;
}

bool nanoseconds_of_other(PyObject* object, Stamp& value, const char* what) {
  if (!PyErr_ExceptionMatches(PyExc_TypeError)) return false;
  PyErr_Clear();
  PyObject* number = from_datetime(object, what);
  if (number == nullptr) return false;
  value = PyLong_AsLongLong(number);
  Py_DECREF(number);
  return value != -1 || PyErr_Occurred() == nullptr;
}

Stamp nanoseconds_of(nb::handle object, const char* what) {
  Stamp value = 0;
  if (!nanoseconds_of(object.ptr(), value, what)) throw nb::python_error();
  return value;
}

}  // namespace turtlewire::python
