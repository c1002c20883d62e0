// Bytes that belong to Python.
#pragma once

#include <cstddef>
#include <span>

#include "python.hpp"

namespace turtlewire::python {

// The bytes of any object with the buffer protocol, for as long as this lives.
class Bytes {
 public:
  Bytes() = default;
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;
  ~Bytes() {
    if (view_.obj != nullptr) PyBuffer_Release(&view_);
  }
  // False with a Python error set if the object has no bytes.
  bool read(PyObject* object) {
    if (!PyBytes_CheckExact(object)) return PyObject_GetBuffer(object, &view_, PyBUF_SIMPLE) == 0;
    view_.obj = Py_NewRef(object);  // as PyObject_GetBuffer() would do it
    view_.buf = bytes_start(object);
    view_.len = PyBytes_Size(object);
    return true;
  }
  const unsigned char* data() const { return static_cast<const unsigned char*>(view_.buf); }
  std::size_t size() const { return static_cast<std::size_t>(view_.len); }
  std::span<const unsigned char> span() const { return {data(), size()}; }

 private:
  Py_buffer view_{};
};

}  // namespace turtlewire::python
