#include "transform.hpp"

#include <structmember.h>

#include <cstddef>

namespace turtlewire::python {
namespace {

struct TransformObject {
  PyObject_HEAD;
  PyObject* frame_id;        // the target
  PyObject* child_frame_id;  // the source
  Stamp stamp;
  Pose pose;
};

PyTypeObject* transform_type = nullptr;

TransformObject* cast(PyObject* self) { return reinterpret_cast<TransformObject*>(self); }

PyObject* floats(std::initializer_list<double> values) {
  PyObject* tuple = PyTuple_New(static_cast<Py_ssize_t>(values.size()));
  if (tuple == nullptr) return nullptr;
  Py_ssize_t i = 0;
  for (const double value : values) {
    PyObject* item = PyFloat_FromDouble(value);
    if (item == nullptr) {
      Py_DECREF(tuple);
      return nullptr;
    }
    set_tuple_item(tuple, i++, item);
  }
  return tuple;
}

PyObject* create(PyTypeObject*, PyObject* arguments, PyObject* keywords) {
  static const char* names[] = {"frame_id",    "child_frame_id", "stamp_ns",
                                "translation", "rotation",       nullptr};
  PyObject *frame_id, *child_frame_id;
  long long stamp;
  Pose pose;
  auto& [t, q] = pose;
  if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "UUL(ddd)(dddd)", const_cast<char**>(names),
                                   &frame_id, &child_frame_id, &stamp, &t.x, &t.y, &t.z, &q.x, &q.y,
                                   &q.z, &q.w)) {
    return nullptr;
  }
  return make_transform(frame_id, child_frame_id, {stamp, pose});
}

void destroy(PyObject* self) {
  PyTypeObject* type = Py_TYPE(self);
  Py_DECREF(cast(self)->frame_id);
  Py_DECREF(cast(self)->child_frame_id);
  PyObject_Free(self);
  Py_DECREF(type);
}

PyObject* translation(PyObject* self, void*) {
  const Vec3& t = cast(self)->pose.translation;
  return floats({t.x, t.y, t.z});
}

PyObject* rotation(PyObject* self, void*) {
  const Quat& q = cast(self)->pose.rotation;
  return floats({q.x, q.y, q.z, q.w});
}

PyObject* inverse_of(PyObject* self, PyObject*) {
  const TransformObject* transform = cast(self);
  const Pose back = inverse(transform->pose);
  return make_transform(transform->child_frame_id, transform->frame_id,
                        {transform->stamp, {back.translation, canonical(back.rotation)}});
}

PyObject* reduce(PyObject* self, PyObject*) {
  const TransformObject* transform = cast(self);
  return Py_BuildValue("O(OOLNN)", Py_TYPE(self), transform->frame_id, transform->child_frame_id,
                       static_cast<long long>(transform->stamp), translation(self, nullptr),
                       rotation(self, nullptr));
}

PyObject* represent(PyObject* self) {
  const TransformObject* transform = cast(self);
  PyObject* t = translation(self, nullptr);
  PyObject* q = rotation(self, nullptr);
  PyObject* text = nullptr;
  if (t != nullptr && q != nullptr) {
    text = PyUnicode_FromFormat(
        "Transform(frame_id=%R, child_frame_id=%R, stamp_ns=%lld, translation=%R, rotation=%R)",
        transform->frame_id, transform->child_frame_id, static_cast<long long>(transform->stamp), t,
        q);
  }
  Py_XDECREF(t);
  Py_XDECREF(q);
  return text;
}

PyObject* compare(PyObject* a, PyObject* b, int operation) {
  if ((operation != Py_EQ && operation != Py_NE) || Py_TYPE(b) != transform_type)
    Py_RETURN_NOTIMPLEMENTED;
  const TransformObject *x = cast(a), *y = cast(b);
  const bool equal = x->stamp == y->stamp && x->pose == y->pose &&
                     PyUnicode_Compare(x->frame_id, y->frame_id) == 0 &&
                     PyUnicode_Compare(x->child_frame_id, y->child_frame_id) == 0;
  return PyBool_FromLong(equal == (operation == Py_EQ));
}

// NumPy is imported there, only when an array or a picture is asked for.
PyObject* call_helper(const char* home, const char* helper, PyObject* self, PyObject* arguments,
                      PyObject* keywords) {
  return taking_gil([=]() -> PyObject* {
    PyObject* module = PyImport_ImportModule(home);
    if (module == nullptr) return nullptr;
    PyObject* function = PyObject_GetAttrString(module, helper);
    Py_DECREF(module);
    if (function == nullptr) return nullptr;
    PyObject* first = PyTuple_Pack(1, self);
    PyObject* all = first == nullptr ? nullptr : PySequence_Concat(first, arguments);
    PyObject* result = all == nullptr ? nullptr : PyObject_Call(function, all, keywords);
    Py_XDECREF(all);
    Py_XDECREF(first);
    Py_DECREF(function);
    return result;
  });
}

PyObject* as_array(PyObject* self, PyObject* arguments, PyObject* keywords) {
  return call_helper("turtlewire.tf.arrays", "pose_array", self, arguments, keywords);
}

PyObject* call_helper(const char* home, const char* helper, PyObject* self) {
  PyObject* nothing = PyTuple_New(0);
  if (nothing == nullptr) return nullptr;
  PyObject* result = call_helper(home, helper, self, nothing, nullptr);
  Py_DECREF(nothing);
  return result;
}

PyObject* as_matrix(PyObject* self, PyObject*) {
  return call_helper("turtlewire.tf.arrays", "pose_matrix", self);
}

// The slot is asked for both operands; the right one may be anything.
PyObject* product(PyObject* left, PyObject* right) {
  if (Py_TYPE(left) != transform_type) Py_RETURN_NOTIMPLEMENTED;
  PyObject* arguments = PyTuple_Pack(1, right);
  if (arguments == nullptr) return nullptr;
  PyObject* result = call_helper("turtlewire.tf.products", "product", left, arguments, nullptr);
  Py_DECREF(arguments);
  return result;
}

PyObject* interpolated(PyObject* self, PyObject* arguments, PyObject* keywords) {
  return call_helper("turtlewire.tf.products", "interpolated", self, arguments, keywords);
}

PyObject* as_html(PyObject* self, PyObject*) {
  return call_helper("turtlewire.tf.notebook", "transform_html", self);
}

constexpr auto kPose = static_cast<Py_ssize_t>(offsetof(TransformObject, pose));
constexpr Py_ssize_t number(int i) { return kPose + i * static_cast<Py_ssize_t>(sizeof(double)); }

PyMemberDef members[] = {
    {"frame_id", T_OBJECT, offsetof(TransformObject, frame_id), READONLY,
     "The target frame, in which the pose is."},
    {"child_frame_id", T_OBJECT, offsetof(TransformObject, child_frame_id), READONLY,
     "The source frame: whose pose it is."},
    {"stamp_ns", T_LONGLONG, offsetof(TransformObject, stamp), READONLY,
     "The time of the pose, in nanoseconds."},
    {"x", T_DOUBLE, number(0), READONLY, "Translation along x, in metres."},
    {"y", T_DOUBLE, number(1), READONLY, "Translation along y, in metres."},
    {"z", T_DOUBLE, number(2), READONLY, "Translation along z, in metres."},
    {"qx", T_DOUBLE, number(3), READONLY, "x of the unit quaternion."},
    {"qy", T_DOUBLE, number(4), READONLY, "y of the unit quaternion."},
    {"qz", T_DOUBLE, number(5), READONLY, "z of the unit quaternion."},
    {"qw", T_DOUBLE, number(6), READONLY, "w of the unit quaternion."},
    {nullptr, 0, 0, 0, nullptr},
};

PyGetSetDef properties[] = {
    {"translation", translation, nullptr, "(x, y, z) in metres.", nullptr},
    {"rotation", rotation, nullptr, "The unit quaternion (x, y, z, w).", nullptr},
    {nullptr, nullptr, nullptr, nullptr, nullptr},
};

PyMethodDef methods[] = {
    {"inverse", inverse_of, METH_NOARGS,
     "inverse($self)\n--\n\nThe transform the other way round: source_from_target."},
    {"interpolate", reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(interpolated)),
     METH_VARARGS | METH_KEYWORDS,
     "interpolate($self, other, stamp_ns)\n--\n\n"
     "The transform at a time between two of the same frames: lerp and slerp, as tf2 does."},
    {"as_matrix", as_matrix, METH_NOARGS,
     "as_matrix($self)\n--\n\nThe 4x4 matrix that acts on column vectors from the left."},
    {"__array__", reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(as_array)),
     METH_VARARGS | METH_KEYWORDS,
     "__array__($self, dtype=None, copy=None)\n--\n\nThe seven numbers x, y, z, qx, qy, qz, qw."},
    {"_repr_html_", as_html, METH_NOARGS,
     "_repr_html_($self)\n--\n\nNumbers and a picture, for notebooks."},
    {"__reduce__", reduce, METH_NOARGS, nullptr},
    {nullptr, nullptr, 0, nullptr},
};

const char kDoc[] =
    "Transform(frame_id, child_frame_id, stamp_ns, translation, rotation)\n--\n\n"
    "The pose of `child_frame_id` (source) in `frame_id` (target) at one time: "
    "`target_from_source`.\n\n"
    "Immutable. It takes data of the source frame into the target frame. Translation in metres; "
    "rotation a unit\n"
    "quaternion in the order x, y, z, w. `numpy.asarray(transform)` gives the seven numbers.";

PyType_Slot slots[] = {
    {Py_tp_doc, const_cast<char*>(kDoc)},
    {Py_tp_new, reinterpret_cast<void*>(create)},
    {Py_tp_dealloc, reinterpret_cast<void*>(destroy)},
    {Py_tp_repr, reinterpret_cast<void*>(represent)},
    {Py_tp_richcompare, reinterpret_cast<void*>(compare)},
    {Py_tp_hash, reinterpret_cast<void*>(PyObject_HashNotImplemented)},
    {Py_tp_members, members},
    {Py_tp_getset, properties},
    {Py_tp_methods, methods},
    {Py_nb_matrix_multiply, reinterpret_cast<void*>(product)},
    {0, nullptr},
};

PyType_Spec spec = {"turtlewire.Transform", sizeof(TransformObject), 0, Py_TPFLAGS_DEFAULT, slots};

}  // namespace

bool add_transform_type(nb::module_& module) {
  transform_type = reinterpret_cast<PyTypeObject*>(PyType_FromSpec(&spec));
  if (transform_type == nullptr) return false;
  return PyObject_SetAttrString(module.ptr(), "Transform",
                                reinterpret_cast<PyObject*>(transform_type)) == 0;
}

PyObject* make_transform(PyObject* target, PyObject* source, const Found& found) {
  auto* transform = PyObject_New(TransformObject, transform_type);
  if (transform == nullptr) return nullptr;
  transform->frame_id = Py_NewRef(target);
  transform->child_frame_id = Py_NewRef(source);
  transform->stamp = found.stamp;
  transform->pose = found.target_from_source;
  return reinterpret_cast<PyObject*>(transform);
}

}  // namespace turtlewire::python
