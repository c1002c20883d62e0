// The few helpers around the raw Python interface that the hot methods need.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <string_view>

#include "../core/samples.hpp"
#include "concrete.hpp"
#include "gil.hpp"

namespace turtlewire::python {

namespace nb = nanobind;

// A hot method in the vectorcall convention, as the method table wants it. No C++ exception may
// pass through Python.
using FastMethod = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);
template <FastMethod Method>
PyObject* guarded(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                  PyObject* keywords) {
  try {
    return Method(self, arguments, count, keywords);
  } catch (const std::bad_alloc&) {
    return PyErr_NoMemory();
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
    return nullptr;
  }
}
template <FastMethod Method>
PyMethodDef fast_method(const char* name, const char* doc) {
  const FastMethod method = guarded<Method>;
  return {name, reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(method)),
          METH_FASTCALL | METH_KEYWORDS, doc};
}

// Positional and keyword arguments of a hot method, in the order of the names; missing optional
// ones are null.
template <std::size_t N>
class Signature {
 public:
  Signature(const char* method, std::size_t required, const std::array<const char*, N>& names)
      : method_(method), required_(required) {
    for (std::size_t i = 0; i < N; ++i) names_[i] = PyUnicode_InternFromString(names[i]);
  }

  bool read(PyObject* const* arguments, Py_ssize_t count, PyObject* keywords,
            std::array<PyObject*, N>& values) const {
    values.fill(nullptr);
    if (static_cast<std::size_t>(count) > N) {
      PyErr_Format(PyExc_TypeError, "%s() takes at most %zu arguments (%zd given)", method_, N,
                   count);
      return false;
    }
    for (Py_ssize_t i = 0; i < count; ++i) values[static_cast<std::size_t>(i)] = arguments[i];
    if (keywords != nullptr && !read_keywords(arguments + count, keywords, values)) return false;
    for (std::size_t i = 0; i < required_; ++i) {
      if (values[i] == nullptr) {
        PyErr_Format(PyExc_TypeError, "%s() is missing the argument '%U'", method_, names_[i]);
        return false;
      }
    }
    return true;
  }

 private:
  bool read_keywords(PyObject* const* given, PyObject* keywords,
                     std::array<PyObject*, N>& values) const {
    for (Py_ssize_t k = 0; k < tuple_size(keywords); ++k) {
      PyObject* keyword = tuple_item(keywords, k);
      std::size_t i = 0;
      while (i < N && names_[i] != keyword && PyUnicode_Compare(names_[i], keyword) != 0) ++i;
      if (i == N) {
        PyErr_Format(PyExc_TypeError, "%s() got an unexpected keyword argument '%U'", method_,
                     keyword);
        return false;
      }
      if (values[i] != nullptr) {
        PyErr_Format(PyExc_TypeError, "%s() got multiple values for argument '%U'", method_,
                     keyword);
        return false;
      }
      values[i] = given[k];
    }
    return true;
  }

  const char* method_;
  std::size_t required_;
  std::array<PyObject*, N> names_;
};

// False, with the TypeError for an object that is no str.
bool raise_no_text(PyObject* object, const char* what);

// A string's own bytes; they live as long as the object. False with a TypeError or
// UnicodeEncodeError set.
inline bool text_of(PyObject* object, std::string_view& text, const char* what) {
  if (!PyUnicode_Check(object)) {
    return raise_no_text(object, what);
  }
  Py_ssize_t size = 0;
  const char* bytes = PyUnicode_AsUTF8AndSize(object, &size);
  if (bytes == nullptr) return false;
  text = {bytes, static_cast<std::size_t>(size)};
  return true;
}

// As PyLong_AsLongLong(), which takes a detour through an array of bytes for ints of stamps' size.
inline std::int64_t to_int64(PyObject* object) {
  if (PyLong_CheckExact(object)) {
    int overflow = 0;
    const long long value = PyLong_AsLongLongAndOverflow(object, &overflow);
    if (overflow == 0) [[likely]]
      return value;
  }
  return taking_gil([object] { return PyLong_AsLongLong(object); });
}

// Nanoseconds from an int (or what has __index__) or a datetime64; a null object leaves the
// default. False with a Python error set. The second function goes on where to_int64 has failed.
bool nanoseconds_of_other(PyObject* object, Stamp& value, const char* what);
inline bool nanoseconds_of(PyObject* object, Stamp& value, const char* what) {
  if (object == nullptr) return true;
  value = to_int64(object);
  if (value != -1 || PyErr_Occurred() == nullptr) [[likely]]
    return true;
  return nanoseconds_of_other(object, value, what);
}

// So many numbers from a sequence. False with a Python error set.
bool numbers_of(PyObject* sequence, double* values, Py_ssize_t count, const char* what);

// The same for functions of nanobind: throws if there is a Python error.
Stamp nanoseconds_of(nb::handle object, const char* what);

}  // namespace turtlewire::python
