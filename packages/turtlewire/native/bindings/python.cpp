#include "python.hpp"

namespace turtlewire::python {
namespace {

// Raises the error of turtlewire.tf.number_errors; `items` is null without a sequence. Errors other
// than TypeError come from the caller's own objects and stay.
void raise_no_numbers(PyObject* sequence, PyObject* items, const char* what) {
  if (PyErr_Occurred() != nullptr && PyErr_ExceptionMatches(PyExc_TypeError) == 0) return;
  PyErr_Clear();
  PyObject* error = call_python("turtlewire.tf.number_errors", "numbers_error", "sOO", what,
                                sequence, items == nullptr ? Py_None : items);
  if (error == nullptr) return;
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error)), error);
  Py_DECREF(error);
}

// Raises the error that a function of turtlewire.call_errors makes.
template <typename... Arguments>
void raise_made(const char* function, const char* format, Arguments... arguments) {
  PyObject* error = call_python("turtlewire.call_errors", function, format, arguments...);
  if (error != nullptr) PyErr_SetObject(PyExc_TypeError, error);
  Py_XDECREF(error);
}

}  // namespace

PyObject* tuple_of(std::span<PyObject* const> items) {
  PyObject* tuple = PyTuple_New(static_cast<Py_ssize_t>(items.size()));
  for (std::size_t i = 0; tuple != nullptr && i < items.size(); ++i)
    set_tuple_item(tuple, static_cast<Py_ssize_t>(i), Py_NewRef(items[i]));
  return tuple;
}

bool raise_misfit(const char* method, std::span<PyObject* const> names, std::size_t required,
                  std::size_t positional, Py_ssize_t given, PyObject* keywords) {
  PyObject* all_names = tuple_of(names);
  if (all_names == nullptr) return false;
  PyObject* no_keywords = keywords == nullptr ? PyTuple_New(0) : nullptr;
  raise_made("call_error", "sOnnnO", method, all_names, required, positional, given,
             keywords == nullptr ? no_keywords : keywords);
  Py_XDECREF(no_keywords);
  Py_DECREF(all_names);
  return false;
}

bool raise_no_text(PyObject* object, const char* what) {
  raise_made("frame_error", "sO", what, object);
  return false;
}

bool raise_no_ros_time(PyObject* object, const char* what) {
  raise_made("ros_time_error", "sO", what, object);
  return false;
}

bool nanoseconds_of_other(PyObject* object, Stamp& value, const char* what) {
  if (PyErr_ExceptionMatches(PyExc_OverflowError) != 0)
    PyErr_Format(PyExc_OverflowError, "%s does not fit into 64 bits of nanoseconds", what);
  if (!PyErr_ExceptionMatches(PyExc_TypeError)) return false;
  PyErr_Clear();
  PyObject* number = call_python("turtlewire.tf.datetimes", "nanoseconds", "Os", object, what);
  if (number == nullptr) return false;
  value = PyLong_AsLongLong(number);
  Py_DECREF(number);
  return value != -1 || PyErr_Occurred() == nullptr;
}

bool raise_no_time(const char* what) {
  PyErr_Format(PyExc_ValueError, "%s is NaT (not a time)", what);
  return false;
}

// Works on a tuple: an element's __float__ may change the list that it is in.
bool numbers_of(PyObject* sequence, double* values, Py_ssize_t count, const char* what) {
  return taking_gil([=] {
    PyObject* items = PySequence_Tuple(sequence);
    bool fits = items != nullptr && tuple_size(items) == count;
    for (Py_ssize_t i = 0; fits && i < count; ++i) {
      values[i] = PyFloat_AsDouble(tuple_item(items, i));
      fits = values[i] != -1.0 || PyErr_Occurred() == nullptr;
    }
    if (!fits) raise_no_numbers(sequence, items, what);
    Py_XDECREF(items);
    return fits;
  });
}

Stamp nanoseconds_of(nb::handle object, const char* what) {
  Stamp value = 0;
  if (!nanoseconds_of(object.ptr(), value, what)) throw nb::python_error();
  return value;
}

Stamp nanoseconds_or(PyObject* object, Stamp value, const char* what) {
  if (!nanoseconds_of(object, value, what)) throw nb::python_error();
  return value;
}

bool is_true(PyObject* object) {
  const int truth = object == nullptr ? 0 : taking_gil([=] { return PyObject_IsTrue(object); });
  if (truth < 0) throw nb::python_error();
  return truth == 1;
}

int choice_of(PyObject* object, const char* what, std::string_view first, std::string_view second) {
  if (object == nullptr) return 0;
  std::string_view given;
  if (PyUnicode_Check(object)) given = text_of(nb::handle(object), what);
  if (given == first || given == second) return given == first ? 0 : 1;
  PyErr_Format(PyExc_ValueError, "%s must be '%s' or '%s', not %R", what, first.data(),
               second.data(), object);
  throw nb::python_error();
}

std::string_view text_of(nb::handle object, const char* what) {
  std::string_view text;
  if (!text_of(object.ptr(), text, what)) throw nb::python_error();
  return text;
}

Stamp moment_of(nb::handle object, const char* what) {
  Stamp value = kLatest;
  if (!moment_of(object.ptr(), value, what)) throw nb::python_error();
  return value;
}

}  // namespace turtlewire::python
