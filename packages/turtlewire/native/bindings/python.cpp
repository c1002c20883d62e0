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

// Works on a tuple: an element's __float__ may change the list that it is in.
bool numbers_of(PyObject* sequence, double* values, Py_ssize_t count, const char* what) {
  return taking_gil([=] {
    PyObject* items = PySequence_Tuple(sequence);
    if (items == nullptr) return false;
    bool fits = tuple_size(items) == count;
    if (!fits) PyErr_Format(PyExc_ValueError, "%s must have %zd numbers", what, count);
    for (Py_ssize_t i = 0; fits && i < count; ++i) {
      values[i] = PyFloat_AsDouble(tuple_item(items, i));
      fits = values[i] != -1.0 || PyErr_Occurred() == nullptr;
    }
    Py_DECREF(items);
    return fits;
  });
}

Stamp nanoseconds_of(nb::handle object, const char* what) {
  Stamp value = 0;
  if (!nanoseconds_of(object.ptr(), value, what)) throw nb::python_error();
  return value;
}

}  // namespace turtlewire::python
