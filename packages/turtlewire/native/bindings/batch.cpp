#include "../core/batch.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "arrays.hpp"
#include "buffer_methods.hpp"
#include "errors.hpp"

namespace turtlewire::python {
namespace {

using Output = nb::ndarray<double, nb::c_contig, nb::device::cpu>;
using NewArray = nb::ndarray<nb::numpy, double>;

// The given array, or a new one; `begin` is its first number.
nb::object output(PyObject* given, std::initializer_list<std::size_t> shape, double*& begin) {
  const nb::object out = nb::borrow(or_none(given));
  if (out.is_none()) {
    const NewArray array = new_array<double>(shape);
    begin = array.data();
    return nb::cast(array);
  }
  Output array;
  if (!is_array(out, array))
    throw nb::type_error("out must be a writable, C-contiguous float64 array");
  check_shape(array, shape, "out");
  begin = array.data();
  return out;
}

// The treatment of rows without an answer: an exception for the first one, or NaN.
enum class Errors : std::uint8_t { raise, nan };

Errors errors_of(PyObject* name) {
  return choice_of(name, "errors", "raise", "nan") == 0 ? Errors::raise : Errors::nan;
}

Stamp beyond_of(PyObject* object) {
  const Stamp beyond = nanoseconds_or(object, 0, "extrapolate_ns");
  if (beyond < 0) throw nb::value_error("extrapolate_ns must not be negative");
  return beyond;
}

// An optional frame: missing, or None.
std::optional<std::string_view> frame_if(PyObject* object, const char* what) {
  if (object == nullptr || object == Py_None) return std::nullopt;
  return text_of(nb::handle(object), what);
}

void check_signals() {
  if (taking_gil(PyErr_CheckSignals) != 0) throw nb::python_error();
}

// Raises the error that a single lookup at the first stamp without an answer raises.
[[noreturn]] void raise_first(BufferObject& self, const Request& request, Status status) {
  Found found;
  Failure failure;
  if (self.shared.lookup(request, found, failure) == Status::ok) {
    failure.status = status;  // the data has changed since
    failure.target = request.target;
    failure.source = request.source;
    failure.requested = request.t;
  }
  raise_in_batch(failure, nb::find(self).ptr());
  throw nb::python_error();
}

void write_poses(const Lanes& lanes, std::size_t n, double* out) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 7; ++k) out[7 * i + k] = lanes.v[k][i];
  }
}

void write_matrices(const Lanes& lanes, std::size_t n, double* out) {
  for (std::size_t i = 0; i < n; ++i) {
    const auto& [t, q] = lanes.pose(i);
    const double m[16] = {1 - 2 * (q.y * q.y + q.z * q.z),
                          2 * (q.x * q.y - q.w * q.z),
                          2 * (q.x * q.z + q.w * q.y),
                          t.x,
                          2 * (q.x * q.y + q.w * q.z),
                          1 - 2 * (q.x * q.x + q.z * q.z),
                          2 * (q.y * q.z - q.w * q.x),
                          t.y,
                          2 * (q.x * q.z - q.w * q.y),
                          2 * (q.y * q.z + q.w * q.x),
                          1 - 2 * (q.x * q.x + q.y * q.y),
                          t.z,
                          0,
                          0,
                          0,
                          1};
    std::copy_n(m, 16, out + 16 * i);
  }
}

struct Fault {
  std::size_t row;
  Status status;
};

// Runs over all stamps in blocks without the GIL; the first stamp without an answer if that ends
// it.
template <typename Each>
std::optional<Fault> for_blocks(BatchLookup& lookup, const Stamps& stamps, Errors errors,
                                Each each) {
  const Unlocked unlocked;
  Lanes poses;
  Status statuses[kLanes];
  const std::size_t size = stamps.shape(0);
  for (std::size_t begin = 0; begin < size; begin += kLanes) {
    const std::size_t n = std::min(kLanes, size - begin);
    lookup.block({stamps.data() + begin, n}, poses, statuses);
    if (errors == Errors::raise) {
      const Status* fault =
          std::find_if(statuses, statuses + n, [](Status s) { return s != Status::ok; });
      if (fault != statuses + n)
        return Fault{begin + static_cast<std::size_t>(fault - statuses), *fault};
    }
    each(begin, n, poses);
  }
  return std::nullopt;
}

constexpr Parameters<7> kLookupTransforms{
    "lookup_transforms",
    3,
    3,
    {"target_frame", "source_frame", "stamps", "errors", "extrapolate_ns", "matrices", "out"}};

nb::object lookup_transforms(BufferObject& self, const Values<7>& given) {
  const auto [target_frame, source_frame, when, errors_name, extrapolate, as_matrices, out] = given;
  const std::string_view target = text_of(nb::handle(target_frame), "target_frame"),
                         source = text_of(nb::handle(source_frame), "source_frame");
  const Errors errors = errors_of(errors_name);
  const Stamp beyond = beyond_of(extrapolate);
  const bool matrices = is_true(as_matrices);
  const Stamps stamps = stamps_of(when);
  const std::size_t n = stamps.shape(0);
  double* begin = nullptr;
  nb::object result = matrices ? output(out, {n, 4, 4}, begin) : output(out, {n, 7}, begin);
  BatchLookup lookup(self.shared, target, source, beyond);
  const auto write = [&](std::size_t first, std::size_t count, const Lanes& poses) {
    if (matrices) {
      write_matrices(poses, count, begin + 16 * first);
    } else {
      write_poses(poses, count, begin + 7 * first);
    }
  };
  const auto fault = for_blocks(lookup, stamps, errors, write);
  if (fault) raise_first(self, {target, source, stamps.data()[fault->row], beyond}, fault->status);
  check_signals();
  return result;
}

// ---------------------------------------------------------------- all frames

constexpr Parameters<2> kLookupAll{"lookup_all", 1, 2, {"target_frame", "stamp_ns"}};

nb::object lookup_all(BufferObject& self, const Values<2>& given) {
  const std::string_view target = text_of(nb::handle(given[0]), "target_frame");
  const Stamp t = moment_of(nb::handle(given[1]), "stamp_ns");
  std::vector<FramePose> found;
  Failure failure;
  Status status;
  {
    const Unlocked unlocked;
    status = turtlewire::lookup_all(self.shared, target, t, found, failure);
  }
  if (status != Status::ok) {
    raise(failure, Question::lookup, nb::find(self).ptr());
    throw nb::python_error();
  }
  nb::list frames;
  const NewArray poses = new_array<double>({found.size(), 7});
  const auto stamps = new_array<Stamp>({found.size()});
  for (std::size_t i = 0; i < found.size(); ++i) {
    frames.append(found[i].frame);
    stamps.data()[i] = found[i].stamp;
    const auto& [p, q] = found[i].target_from_frame;
    const double row[7] = {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
    std::copy_n(row, 7, poses.data() + 7 * i);
  }
  return make_answer("FramePoses", nb::make_tuple(frames, poses, stamps));
}

bool is_datetime(nb::handle object) {
  // nanobind's inst_name() leaves the module out where a class is not made by Python code.
  const nb::handle type = object.type();
  const nb::str name = nb::str("{}.{}").format(type.attr("__module__"), type.attr("__name__"));
  return std::string_view(name.c_str()) == "numpy.datetime64" ||
         nb::hasattr(object, "to_datetime64");
}

// The time, if the argument is not an array: None, an int, one of NumPy's, or a datetime64.
std::optional<Stamp> single_stamp(nb::handle object) {
  if (object.is_none()) return kLatest;
  if (PyLong_CheckExact(object.ptr())) return nanoseconds_of(object, "stamps");
  if (is_datetime(object)) return moment_of(object, "stamps");
  if (!PyIndex_Check(object.ptr()) || PySequence_Check(object.ptr())) return std::nullopt;
  return nanoseconds_of(object, "stamps");
}

// ---------------------------------------------------------------- points

template <typename T>
using Points = nb::ndarray<const T, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
template <typename T>
using PointsOut = nb::ndarray<T, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

template <typename T>
void move_all(const Pose& pose, const T* in, T* out, std::size_t n) {
  const Vec3 x = rotate(pose.rotation, {1, 0, 0}), y = rotate(pose.rotation, {0, 1, 0}),
             z = rotate(pose.rotation, {0, 0, 1});
  const Vec3 t = pose.translation;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = in[3 * i], b = in[3 * i + 1], c = in[3 * i + 2];
    out[3 * i] = static_cast<T>(t.x + a * x.x + b * y.x + c * z.x);
    out[3 * i + 1] = static_cast<T>(t.y + a * x.y + b * y.y + c * z.y);
    out[3 * i + 2] = static_cast<T>(t.z + a * x.z + b * y.z + c * z.z);
  }
}

template <typename T>
void move_each(const Lanes& poses, const T* in, T* out, std::size_t n) {
  double points[3 * kLanes] = {};
  std::copy_n(in, 3 * n, points);
  kernels().apply(poses, points);
  std::transform(points, points + 3 * n, out, [](double value) { return static_cast<T>(value); });
}

// Input numbers that the output may overlap: the same memory, or a copy if an input would be
// overwritten before it is read.
template <typename T>
class Input {
 public:
  Input(const T* begin, const T* written, std::size_t n) : begin_(begin) {
    const std::less<const T*> before;
    if (begin == written || !before(begin, written + n) || !before(written, begin + n)) return;
    copy_.assign(begin, begin + n);
    begin_ = copy_.data();
  }
  const T* begin() const { return begin_; }

 private:
  const T* begin_;
  std::vector<T> copy_;
};

// The second transform of the points, after their own lookup: into the target at its own time.
Pose target_from_fixed(BufferObject& self, std::string_view target, std::string_view fixed,
                       Stamp t) {
  Found found;
  Failure failure;
  if (self.shared.lookup(Request{target, fixed, t}, found, failure) != Status::ok) {
    raise_in_batch(failure, nb::find(self).ptr());
    throw nb::python_error();
  }
  return found.target_from_source;
}

struct Deskew {
  std::string_view target, source;
  std::optional<std::string_view> fixed;
  Stamp target_stamp;
};

template <typename T>
nb::object move_points(BufferObject& self, const Deskew& way, const Points<T>& points,
                       nb::handle when, nb::handle out, Errors errors) {
  const std::size_t n = points.shape(0);
  T* begin = nullptr;
  nb::object result = nb::borrow(out);
  if (out.is_none()) {
    const auto array = new_array<T>({n, 3});
    begin = array.data();
    result = nb::cast(array);
  } else {
    PointsOut<T> array;
    if (!is_array(out, array)) {
      throw nb::type_error(
          "out must be a writable, C-contiguous (N, 3) array of the same type as points");
    }
    check_shape(array, {n, 3}, "out");
    begin = array.data();
  }
  const Input<T> input(points.data(), begin, 3 * n);
  const std::string_view own_target = way.fixed.value_or(way.target);
  const Pose last =
      way.fixed ? target_from_fixed(self, way.target, *way.fixed, way.target_stamp) : Pose{};
  if (const auto one = single_stamp(when)) {
    const Pose own = target_from_fixed(self, own_target, way.source, *one);
    const Unlocked unlocked;
    move_all(last * own, input.begin(), begin, n);
    return result;
  }
  const Stamps stamps = stamps_of(when);
  if (stamps.shape(0) != n) {
    const std::string text =
        "stamps must be one time, or one for each point: " + std::to_string(n) + " points have " +
        std::to_string(stamps.shape(0)) + " stamps";
    throw nb::value_error(text.c_str());
  }
  BatchLookup lookup(self.shared, own_target, way.source);
  Lanes outer;
  outer.fill(last);
  const auto fault =
      for_blocks(lookup, stamps, errors, [&](std::size_t first, std::size_t count, Lanes& poses) {
        if (way.fixed) kernels().compose(outer, poses);
        move_each(poses, input.begin() + 3 * first, begin + 3 * first, count);
      });
  if (fault) raise_first(self, {own_target, way.source, stamps.data()[fault->row]}, fault->status);
  check_signals();
  return result;
}

constexpr Parameters<8> kTransformPoints{"transform_points",
                                         3,
                                         4,
                                         {"target_frame", "source_frame", "points", "stamps",
                                          "fixed_frame", "target_stamp_ns", "errors", "out"}};

nb::object transform_points(BufferObject& self, const Values<8>& given) {
  const nb::handle points = given[2], stamps = or_none(given[3]), out = or_none(given[7]);
  const std::string_view target = text_of(nb::handle(given[0]), "target_frame"),
                         source = text_of(nb::handle(given[1]), "source_frame");
  const auto fixed_frame = frame_if(given[4], "fixed_frame");
  const Errors errors = errors_of(given[6]);
  const Stamp target_stamp = moment_of(nb::handle(given[5]), "target_stamp_ns");
  if (!fixed_frame && target_stamp != kLatest) {
    throw nb::value_error("target_stamp_ns needs fixed_frame, the frame that joins the two times");
  }
  const Deskew way{target, source, fixed_frame, target_stamp};
  Points<float> single;
  if (is_array(points, single)) return move_points<float>(self, way, single, stamps, out, errors);
  Points<double> doubles;
  if (is_array(points, doubles))
    return move_points<double>(self, way, doubles, stamps, out, errors);
  const nb::object array = checked_array("point_array", points);
  if (is_array(array, single)) return move_points<float>(self, way, single, stamps, out, errors);
  return move_points<double>(self, way, nb::cast<Points<double>>(array), stamps, out, errors);
}

// ---------------------------------------------------------------- velocities

constexpr Parameters<9> kLookupVelocity{"lookup_velocity",
                                        2,
                                        3,
                                        {"target_frame", "source_frame", "stamps", "interval_ns",
                                         "axes_frame", "point", "point_frame", "errors", "out"}};

nb::object lookup_velocity(BufferObject& self, const Values<9>& given) {
  const nb::handle when = or_none(given[2]);
  PyObject* const out = given[8];
  const std::string_view observer = text_of(nb::handle(given[0]), "target_frame"),
                         tracking = text_of(nb::handle(given[1]), "source_frame");
  const auto axes = frame_if(given[4], "axes_frame"),
             point_frame = frame_if(given[6], "point_frame");
  const Errors errors = errors_of(given[7]);
  const Stamp interval = nanoseconds_or(given[3], 100'000'000, "interval_ns");
  if (interval <= 0) throw nb::value_error("interval_ns must be positive");
  double point[3] = {};
  if (given[5] != nullptr && !numbers_of(given[5], point, 3, "point")) throw nb::python_error();
  const VelocityRequest request{tracking,
                                observer,
                                axes.value_or(observer),
                                point_frame.value_or(tracking),
                                {point[0], point[1], point[2]},
                                interval};
  const std::optional<Stamp> single = single_stamp(when);
  const Stamps many = single ? Stamps() : stamps_of(when);
  const std::span<const Stamp> stamps =
      single ? std::span(&*single, 1) : std::span(many.data(), many.shape(0));
  double* begin = nullptr;
  nb::object result = single ? output(out, {6}, begin) : output(out, {stamps.size(), 6}, begin);
  std::vector<Status> statuses(stamps.size());
  std::optional<Request> fault;
  {
    const Unlocked unlocked;
    static_assert(sizeof(Velocity) == 6 * sizeof(double));
    fault = lookup_velocities(self.shared, request, stamps, reinterpret_cast<Velocity*>(begin),
                              statuses.data());
  }
  if (fault && errors == Errors::raise) raise_first(self, *fault, Status::no_data);
  return result;
}

}  // namespace

std::array<PyMethodDef, 4> batch_methods() {
  return {{
      buffer_method<kLookupTransforms, lookup_transforms>(
          "lookup_transforms($self, target_frame, source_frame, stamps, *, errors='raise', "
          "extrapolate_ns=0, matrices=False, out=None)\n--\n\n"
          "lookup_transform at many times.\n\n"
          "Args:\n"
          "    target_frame: The frame in which the answers are expressed.\n"
          "    source_frame: The frame whose poses are asked for.\n"
          "    stamps: Times, shape (N,): integers of nanoseconds, or datetime64; 0 is the time "
          "0.\n"
          "    errors: 'raise' raises at the first stamp without an answer, 'nan' makes such rows "
          "NaN; `explain` says why one has none.\n"
          "    extrapolate_ns: As in lookup_transform.\n"
          "    matrices: Answer with homogeneous matrices instead of poses.\n"
          "    out: A float64 array to write to, of the shape of the result.\n\n"
          "Returns:\n"
          "    (N, 7): x, y, z, qx, qy, qz, qw in metres and unit quaternions; or (N, 4, 4).\n\n"
          "Raises:\n"
          "    TransformException: What lookup_transform raises at the first stamp without an "
          "answer."),
      buffer_method<kLookupAll, lookup_all>(
          "lookup_all($self, target_frame, stamp_ns=None)\n--\n\n"
          "The poses of all frames in one frame at one time.\n\n"
          "Args:\n"
          "    target_frame: The frame in which the answers are expressed.\n"
          "    stamp_ns: The time; None asks for the latest time common to the target and each "
          "frame.\n\n"
          "Returns:\n"
          "    FramePoses: the names of the M frames that have a pose then, their poses (M, 7), "
          "and the times (M,) in nanoseconds, NaT's value for the latest time of static links."),
      buffer_method<kTransformPoints, transform_points>(
          "transform_points($self, target_frame, source_frame, points, stamps=None, *, "
          "fixed_frame=None, target_stamp_ns=None, errors='raise', out=None)\n--\n\n"
          "Expresses points of the source frame in the target frame.\n\n"
          "Args:\n"
          "    target_frame: The frame to express them in.\n"
          "    source_frame: The frame that they are in.\n"
          "    points: Shape (N, 3), in metres; float32 stays float32, all else becomes float64.\n"
          "    stamps: One time for all, None being the latest; or each point's own time, shape "
          "(N,).\n"
          "    fixed_frame: A frame that does not move, such as odom: points are taken from the "
          "source at their own times into it, and from it into the target at `target_stamp_ns` "
          "(the deskewing of a lidar's sweep).\n"
          "    target_stamp_ns: The time of the target with a fixed frame; None is the latest.\n"
          "    errors: 'raise' raises for the first point without an answer, 'nan' makes such "
          "points NaN, with a stamp for each point.\n"
          "    out: An array like `points` to write to; it may be `points` itself or overlap "
          "it.\n\n"
          "Returns:\n"
          "    (N, 3) points in the target frame.\n\n"
          "Raises:\n"
          "    TransformException: A lookup has no answer."),
      buffer_method<kLookupVelocity, lookup_velocity>(
          "lookup_velocity($self, target_frame, source_frame, stamps=None, *, "
          "interval_ns=100000000, axes_frame=None, point=(0.0, 0.0, 0.0), point_frame=None, "
          "errors='raise', out=None)\n--\n\n"
          "How a body moves: the velocity of a point that is fixed to it, and its angular "
          "velocity.\n\n"
          "The mean over an interval around the time, or over the interval before the latest data "
          "if the middle would lie beyond it.\n\n"
          "Args:\n"
          "    target_frame: The observer, who is taken for at rest.\n"
          "    source_frame: The body that moves.\n"
          "    stamps: A time, None being the latest; or times, shape (N,).\n"
          "    interval_ns: The length of the interval.\n"
          "    axes_frame: The frame in whose axes the answer is given; by default the target.\n"
          "    point: The point (x, y, z) whose velocity is asked for, in metres.\n"
          "    point_frame: The frame in which the point is given; by default the source.\n"
          "    errors: 'raise' raises for the first time without an answer, 'nan' makes such rows "
          "NaN.\n"
          "    out: A float64 array to write to, of the shape of the result.\n\n"
          "Returns:\n"
          "    vx, vy, vz in m/s and wx, wy, wz in rad/s: shape (6,), or (N, 6) for an array of "
          "stamps.\n\n"
          "Raises:\n"
          "    TransformException: A lookup has no answer."),
  }};
}

}  // namespace turtlewire::python
