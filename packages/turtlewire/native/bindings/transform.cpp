#include "transform.hpp"

#include <structmember.h>

#include <cstddef>
#include <tuple>

namespace turtlewire::python {
namespace {

struct TransformObject {
  PyObject_HEAD;
  PyObject* target_frame;
  PyObject* source_frame;
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

constexpr char kArrays[] = "turtlewire.tf.arrays", kProducts[] = "turtlewire.tf.products";

// NumPy is imported there, only when an array or a picture is asked for.
template <typename... Objects>
PyObject* call_helper(const char* home, const char* helper, Objects... arguments) {
  constexpr const char* formats[] = {"()", "(O)", "(OO)", "(OOO)", "(OOOO)", "(OOOOO)"};
  return call_python(home, helper, formats[sizeof...(arguments)], arguments...);
}

constexpr Parameters<5> kTransform{
    "Transform", 3, 4, {"target_frame", "source_frame", "translation", "rotation", "stamp_ns"}};

PyObject* create(PyTypeObject*, PyObject* arguments, PyObject* keywords) {
  static constinit const Signature signature(kTransform);
  Values<5> given;
  if (!signature.read_all(arguments, keywords, given)) return nullptr;
  const auto [target, source, translation, rotation, moment] = given;
  double t[3], q[4] = {0, 0, 0, 1};
  Stamp stamp = kLatest;
  std::string_view name;
  if (!text_of(target, name, "target_frame") || !text_of(source, name, "source_frame") ||
      !numbers_of(translation, t, 3, "translation") ||
      (rotation != nullptr && !numbers_of(rotation, q, 4, "rotation")) ||
      !moment_of(moment, stamp, "stamp_ns")) {
    return nullptr;
  }
  const Quat turn{q[0], q[1], q[2], q[3]};
  if (dot(turn, turn) == 0) {
    PyErr_SetString(PyExc_ValueError,
                    "rotation must not be (0, 0, 0, 0); the identity is (0, 0, 0, 1)");
    return nullptr;
  }
  return make_transform(target, source, {stamp, {{t[0], t[1], t[2]}, turn}});
}

void destroy(PyObject* self) {
  PyTypeObject* type = Py_TYPE(self);
  Py_DECREF(cast(self)->target_frame);
  Py_DECREF(cast(self)->source_frame);
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

PyObject* stamp_ns(PyObject* self, void*) {
  const Stamp stamp = cast(self)->stamp;
  if (stamp == kLatest) Py_RETURN_NONE;
  return PyLong_FromLongLong(stamp);
}

PyObject* inverse_of(PyObject* self, PyObject*) {
  const TransformObject* transform = cast(self);
  const Pose back = inverse(transform->pose);
  return make_transform(transform->source_frame, transform->target_frame,
                        {transform->stamp, {back.translation, canonical(back.rotation)}});
}

PyObject* reduce(PyObject* self, PyObject*) { return call_helper(kArrays, "reduced", self); }

PyObject* represent(PyObject* self) {
  const TransformObject* transform = cast(self);
  PyObject* t = translation(self, nullptr);
  PyObject* q = rotation(self, nullptr);
  PyObject* stamp = stamp_ns(self, nullptr);
  PyObject* text = nullptr;
  if (t != nullptr && q != nullptr && stamp != nullptr) {
    text = PyUnicode_FromFormat("Transform(%R, %R, %R, %R, stamp_ns=%R)", transform->target_frame,
                                transform->source_frame, t, q, stamp);
  }
  Py_XDECREF(t);
  Py_XDECREF(q);
  Py_XDECREF(stamp);
  return text;
}

PyObject* compare(PyObject* a, PyObject* b, int operation) {
  if ((operation != Py_EQ && operation != Py_NE) || Py_TYPE(b) != transform_type)
    Py_RETURN_NOTIMPLEMENTED;
  const TransformObject *x = cast(a), *y = cast(b);
  const bool equal = x->stamp == y->stamp && x->pose == y->pose &&
                     PyUnicode_Compare(x->target_frame, y->target_frame) == 0 &&
                     PyUnicode_Compare(x->source_frame, y->source_frame) == 0;
  return PyBool_FromLong(equal == (operation == Py_EQ));
}

// Calls a helper in Python for a method that reads the arguments `Names`; None for omitted ones.
template <const auto& Names, const char* Home, const char* Helper>
PyObject* asked(PyObject* self, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static constinit const Signature signature(Names);
  Values<Names.names.size()> given;
  if (!signature.read(arguments, count, keywords, given)) return nullptr;
  return std::apply(
      [self](auto... each) { return call_helper(Home, Helper, self, or_none(each).ptr()...); },
      given);
}
template <const auto& Names, const char* Home, const char* Helper>
PyMethodDef helped(const char* doc) {
  return fast_method<asked<Names, Home, Helper>>(Names.method, doc);
}

constexpr char kPoseArray[] = "pose_array", kApplied[] = "applied", kOfMatrix[] = "of_matrix",
               kInterpolated[] = "interpolated";
constexpr Parameters<2> kArray{"__array__", 0, 2, {"dtype", "copy"}};
constexpr Parameters<1> kApply{"apply", 1, 1, {"points"}};
constexpr Parameters<2> kInterpolate{"interpolate", 2, 2, {"other", "stamp_ns"}};
constexpr Parameters<4> kFromMatrix{
    "from_matrix", 3, 3, {"target_frame", "source_frame", "matrix", "stamp_ns"}};

PyObject* as_matrix(PyObject* self, PyObject*) { return call_helper(kArrays, "pose_matrix", self); }

// The slot is asked for both operands; the right one may be anything.
PyObject* product(PyObject* left, PyObject* right) {
  if (Py_TYPE(left) != transform_type) Py_RETURN_NOTIMPLEMENTED;
  return call_helper(kProducts, "product", left, right);
}

PyObject* as_html(PyObject* self, PyObject*) {
  return call_helper("turtlewire.tf.notebook", "transform_html", self);
}

PyObject* euler(PyObject* self, void*) { return call_helper(kArrays, "euler_angles", self); }

constexpr auto kPose = static_cast<Py_ssize_t>(offsetof(TransformObject, pose));
constexpr Py_ssize_t number(int i) { return kPose + i * static_cast<Py_ssize_t>(sizeof(double)); }

PyMemberDef members[] = {
    {"target_frame", T_OBJECT, offsetof(TransformObject, target_frame), READONLY,
     "The target frame, in which the pose is."},
    {"source_frame", T_OBJECT, offsetof(TransformObject, source_frame), READONLY,
     "The source frame: whose pose it is."},
    {"x", T_DOUBLE, number(0), READONLY, "Translation along x, in metres."},
    {"y", T_DOUBLE, number(1), READONLY, "Translation along y, in metres."},
    {"z", T_DOUBLE, number(2), READONLY, "Translation along z, in metres."},
    {nullptr, 0, 0, 0, nullptr},
};

PyGetSetDef properties[] = {
    {"stamp_ns", stamp_ns, nullptr,
     "The time of the pose, in nanoseconds; None if only static links were used.", nullptr},
    {"euler", euler, nullptr, "Roll, pitch and yaw, in radians.", nullptr},
    {"translation", translation, nullptr, "(x, y, z) in metres.", nullptr},
    {"rotation", rotation, nullptr, "The unit quaternion (x, y, z, w).", nullptr},
    {nullptr, nullptr, nullptr, nullptr, nullptr},
};

PyMethodDef class_method(PyMethodDef method) {
  method.ml_flags |= METH_CLASS;
  return method;
}

PyMethodDef methods[] = {
    {"inverse", inverse_of, METH_NOARGS,
     "inverse($self)\n--\n\nThe transform the other way round: source_from_target."},
    helped<kInterpolate, kProducts, kInterpolated>(
        "interpolate($self, other, stamp_ns)\n--\n\n"
        "The transform at a time between two of the same frames: lerp and slerp, as tf2 does."),
    helped<kApply, kArrays, kApplied>(
        "apply($self, points)\n--\n\n"
        "Points of the source frame, shape (..., 3), in the target frame."),
    class_method(helped<kFromMatrix, kArrays, kOfMatrix>(
        "from_matrix($type, target_frame, source_frame, matrix, *, stamp_ns=None)\n--\n\n"
        "The transform of a homogeneous 4x4 matrix.\n\n"
        "Raises:\n"
        "    InvalidTransformError: The matrix is not a rotation and a translation.")),
    {"as_matrix", as_matrix, METH_NOARGS,
     "as_matrix($self)\n--\n\nThe 4x4 matrix that acts on column vectors from the left."},
    helped<kArray, kArrays, kPoseArray>("__array__($self, dtype=None, copy=None)\n--\n\n"
                                        "The seven numbers x, y, z, qx, qy, qz, qw."),
    {"_repr_html_", as_html, METH_NOARGS,
     "_repr_html_($self)\n--\n\nNumbers and a picture, for notebooks."},
    {"__reduce__", reduce, METH_NOARGS, nullptr},
    {nullptr, nullptr, 0, nullptr},
};

const char kDoc[] =
    "Transform(target_frame, source_frame, translation, rotation=(0, 0, 0, 1), *, stamp_ns=None)"
    "\n--\n\n"
    "The pose of `source_frame` in `target_frame` at one time: "
    "`target_from_source`.\n\n"
    "Immutable. It takes data of the source frame into the target frame. Translation in metres; "
    "rotation a unit\n"
    "quaternion in the order x, y, z, w. `numpy.asarray(transform)` gives the seven numbers.\n\n"
    "Raises:\n"
    "    ValueError: The rotation has length 0. Other lengths are corrected where it is used.";

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
#if defined(Py_GIL_DISABLED)
  // A count above 32 bits makes the class immortal. Otherwise all threads that make transforms
  // would write to its reference count, each time waiting for the others' cores.
  Py_SET_REFCNT(reinterpret_cast<PyObject*>(transform_type), PY_SSIZE_T_MAX);
#endif
  return PyObject_SetAttrString(module.ptr(), "Transform",
                                reinterpret_cast<PyObject*>(transform_type)) == 0;
}

PyObject* make_transform(PyObject* target, PyObject* source, const Found& found) {
  auto* transform = PyObject_New(TransformObject, transform_type);
  if (transform == nullptr) return nullptr;
  transform->target_frame = Py_NewRef(target);
  transform->source_frame = Py_NewRef(source);
  transform->stamp = found.stamp;
  transform->pose = found.target_from_source;
  return reinterpret_cast<PyObject*>(transform);
}

}  // namespace turtlewire::python
