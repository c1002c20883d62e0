// Inside of tuples and bytes: CPython's macros where a wheel is for one version, and the functions
// of the stable ABI where it is for all later ones.
#pragma once

#include <Python.h>

namespace turtlewire::python {

#if defined(Py_LIMITED_API)
inline Py_ssize_t tuple_size(PyObject* tuple) { return PyTuple_Size(tuple); }
inline PyObject* tuple_item(PyObject* tuple, Py_ssize_t i) { return PyTuple_GetItem(tuple, i); }
inline void set_tuple_item(PyObject* tuple, Py_ssize_t i, PyObject* item) {
  PyTuple_SetItem(tuple, i, item);
}
inline char* bytes_start(PyObject* bytes) { return PyBytes_AsString(bytes); }
#else
inline Py_ssize_t tuple_size(PyObject* tuple) { return PyTuple_GET_SIZE(tuple); }
inline PyObject* tuple_item(PyObject* tuple, Py_ssize_t i) { return PyTuple_GET_ITEM(tuple, i); }
inline void set_tuple_item(PyObject* tuple, Py_ssize_t i, PyObject* item) {
  PyTuple_SET_ITEM(tuple, i, item);
}
inline char* bytes_start(PyObject* bytes) { return PyBytes_AS_STRING(bytes); }
#endif

}  // namespace turtlewire::python
