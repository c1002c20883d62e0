#include "batch.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "../core/batch.hpp"
#include "arrays.hpp"
#include "errors.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

using Output = nb::ndarray<double, nb::c_contig, nb::device::cpu>;
using Statuses = nb::ndarray<std::uint8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using NewArray = nb::ndarray<nb::numpy, double>;

// The given array, or a new one; `begin` is its first number.
nb::object output(nb::object out, std::initializer_list<std::size_t> shape, double*& begin) {
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

// The given array of statuses, or one that is thrown away.
class StatusOutput {
 public:
  StatusOutput(nb::object given, std::size_t n) : wanted_(!given.is_none()) {
    if (!wanted_) {
      own_.resize(n);
      return;
    }
    if (!is_array(given, array_))
      throw nb::type_error("status must be a writable, C-contiguous uint8 array");
    check_shape(array_, {n}, "status");
  }

  bool wanted() const { return wanted_; }
  Status* begin() { return wanted_ ? reinterpret_cast<Status*>(array_.data()) : own_.data(); }

 private:
  bool wanted_;
  Statuses array_;
  std::vector<Status> own_;
};
static_assert(sizeof(Status) == sizeof(std::uint8_t));

void check_signals() {
  if (taking_gil(PyErr_CheckSignals) != 0) throw nb::python_error();
}

// Raises what a single lookup at the first stamp without an answer raises.
[[noreturn]] void raise_first(BufferObject& self, std::string_view target, std::string_view source,
                              Stamp t, Status status) {
  Found found;
  Failure failure;
  if (self.shared.lookup(Request{target, source, t}, found, failure) == Status::ok) {
    failure.status = status;  // the data has changed since
    failure.target = target;
    failure.source = source;
    failure.requested = t;
  }
  raise(failure, Question::lookup, nb::find(self).ptr());
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

// Runs over all stamps in blocks without the GIL; the index of the first stamp without an answer if
// that ends it.
template <typename Each>
std::optional<std::size_t> for_blocks(BatchLookup& lookup, const Stamps& stamps,
                                      StatusOutput& status, Each each) {
  const Unlocked unlocked;
  Lanes poses;
  const std::size_t size = stamps.shape(0);
  for (std::size_t begin = 0; begin < size; begin += kLanes) {
    const std::size_t n = std::min(kLanes, size - begin);
    Status* statuses = status.begin() + begin;
    lookup.block({stamps.data() + begin, n}, poses, statuses);
    if (!status.wanted()) {
      const Status* fault =
          std::find_if(statuses, statuses + n, [](Status s) { return s != Status::ok; });
      if (fault != statuses + n) return begin + static_cast<std::size_t>(fault - statuses);
    }
    each(begin, n, poses);
  }
  return std::nullopt;
}

nb::object lookup_batch(BufferObject& self, std::string_view target, std::string_view source,
                        nb::handle stamps_object, bool matrices, nb::object out,
                        nb::object status_object) {
  const Stamps stamps = stamps_of(stamps_object);
  const std::size_t n = stamps.shape(0);
  double* begin = nullptr;
  nb::object result = matrices ? output(out, {n, 4, 4}, begin) : output(out, {n, 7}, begin);
  StatusOutput status(status_object, n);
  BatchLookup lookup(self.shared, target, source);
  const auto write = [&](std::size_t first, std::size_t count, const Lanes& poses) {
    if (matrices) {
      write_matrices(poses, count, begin + 16 * first);
    } else {
      write_poses(poses, count, begin + 7 * first);
    }
  };
  const auto fault = for_blocks(lookup, stamps, status, write);
  if (fault) raise_first(self, target, source, stamps.data()[*fault], status.begin()[*fault]);
  check_signals();
  return result;
}

// ---------------------------------------------------------------- all frames

nb::tuple lookup_all(BufferObject& self, std::string_view target, nb::handle when) {
  const Stamp t = nanoseconds_of(when, "stamp_ns");
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
  return nb::make_tuple(frames, poses, stamps);
}

bool is_datetime(nb::handle object) {
  // nanobind's inst_name() leaves the module out where a class is not made by Python code.
  const nb::handle type = object.type();
  const nb::str name = nb::str("{}.{}").format(type.attr("__module__"), type.attr("__name__"));
  return std::string_view(name.c_str()) == "numpy.datetime64" ||
         nb::hasattr(object, "to_datetime64");
}

// The time, if it is one and no array: an int, one of NumPy's integers, or a datetime64.
std::optional<Stamp> single_stamp(nb::handle object) {
  if (is_datetime(object)) return nanoseconds_of(object, "stamps");
  if (!PyIndex_Check(object.ptr()) || PySequence_Check(object.ptr())) return std::nullopt;
  const Stamp value = taking_gil([object] { return PyLong_AsLongLong(object.ptr()); });
  if (value == -1 && PyErr_Occurred() != nullptr) throw nb::python_error();
  return value;
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

// Numbers to read where others may be written: the same ones, or a copy if an input would be lost
// before it is read.
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

// What the points go through after their own lookup: into the target at its own time.
Pose target_from_fixed(BufferObject& self, std::string_view target, std::string_view fixed,
                       Stamp t) {
  Found found;
  Failure failure;
  if (self.shared.lookup(Request{target, fixed, t}, found, failure) != Status::ok) {
    raise(failure, Question::lookup, nb::find(self).ptr());
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
                       nb::handle when, nb::object out, nb::object status_object) {
  const std::size_t n = points.shape(0);
  T* begin = nullptr;
  nb::object result = out;
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
    if (!status_object.is_none()) throw nb::value_error("status is for a stamp for each point");
    const Pose own = target_from_fixed(self, own_target, way.source, *one);
    const Unlocked unlocked;
    move_all(last * own, input.begin(), begin, n);
    return result;
  }
  const Stamps stamps = stamps_of(when);
  if (stamps.shape(0) != n) throw nb::value_error("stamps must be one int, or one for each point");
  StatusOutput status(status_object, n);
  BatchLookup lookup(self.shared, own_target, way.source);
  Lanes outer;
  outer.fill(last);
  const auto fault =
      for_blocks(lookup, stamps, status, [&](std::size_t first, std::size_t count, Lanes& poses) {
        if (way.fixed) kernels().compose(outer, poses);
        move_each(poses, input.begin() + 3 * first, begin + 3 * first, count);
      });
  if (fault)
    raise_first(self, own_target, way.source, stamps.data()[*fault], status.begin()[*fault]);
  check_signals();
  return result;
}

nb::object transform_points(BufferObject& self, std::string_view target, std::string_view source,
                            nb::handle points, nb::handle stamps,
                            std::optional<std::string_view> fixed_frame, nb::handle target_time,
                            nb::object out, nb::object status) {
  const Stamp target_stamp = nanoseconds_of(target_time, "target_stamp_ns");
  if (!fixed_frame && target_stamp != 0) {
    throw nb::value_error("target_stamp_ns needs fixed_frame, the frame that joins the two times");
  }
  const Deskew way{target, source, fixed_frame, target_stamp};
  Points<float> single;
  if (is_array(points, single)) return move_points<float>(self, way, single, stamps, out, status);
  Points<double> doubles;
  const nb::object array = contiguous_array(points, "float64");
  if (!is_array(array, doubles)) throw nb::value_error("points must have the shape (N, 3)");
  return move_points<double>(self, way, doubles, stamps, out, status);
}

// ---------------------------------------------------------------- velocities

nb::object lookup_velocity(BufferObject& self, std::string_view tracking, std::string_view observer,
                           nb::handle when, Stamp interval, std::optional<std::string_view> axes,
                           nb::handle where, std::optional<std::string_view> point_frame,
                           nb::object out, nb::object status_object) {
  if (interval <= 0) throw nb::value_error("interval_ns must be positive");
  double point[3];
  if (!numbers_of(where.ptr(), point, 3, "point")) throw nb::python_error();
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
  StatusOutput status(status_object, stamps.size());
  std::optional<Request> fault;
  {
    const Unlocked unlocked;
    static_assert(sizeof(Velocity) == 6 * sizeof(double));
    fault = lookup_velocities(self.shared, request, stamps, reinterpret_cast<Velocity*>(begin),
                              status.begin());
  }
  if (fault && !status.wanted())
    raise_first(self, fault->target, fault->source, fault->t, Status::no_data);
  return result;
}

}  // namespace

void add_batch_methods(nb::class_<BufferObject>& cls) {
  cls.def(
         "lookup_batch", &lookup_batch, "target_frame"_a, "source_frame"_a, "stamps"_a,
         nb::kw_only(), "matrices"_a = false, "out"_a = nb::none(), "status"_a = nb::none(),
         "lookup_transform at many times.\n\n"
         "Args:\n"
         "    target_frame: The frame in which the answers are expressed.\n"
         "    source_frame: The frame whose poses are asked for.\n"
         "    stamps: Times in nanoseconds, int64, shape (N,); 0 asks for the latest common time.\n"
         "    matrices: Answer with homogeneous matrices instead of poses.\n"
         "    out: A float64 array to write to, of the shape of the result.\n"
         "    status: A uint8 array of shape (N,): it receives a `LookupStatus` for each stamp (0 "
         "is success), rows\n"
         "        without an answer become NaN, and nothing is raised for them.\n\n"
         "Returns:\n"
         "    (N, 7): x, y, z, qx, qy, qz, qw in metres and unit quaternions; or (N, 4, 4).\n\n"
         "Raises:\n"
         "    TransformException: Without `status`, what lookup_transform raises at the first "
         "stamp without an answer.")
      .def("lookup_all", &lookup_all, "target_frame"_a, "stamp_ns"_a = 0,
           "The poses of all frames in one frame at one time.\n\n"
           "Args:\n"
           "    target_frame: The frame in which the answers are expressed.\n"
           "    stamp_ns: The time; 0 asks for the latest time common to the target and each "
           "frame.\n\n"
           "Returns:\n"
           "    The names of the M frames that have a pose then, their poses (M, 7), and the times "
           "(M,) in nanoseconds.")
      .def("transform_points", &transform_points, "target_frame"_a, "source_frame"_a, "points"_a,
           "stamps"_a = 0, nb::kw_only(), "fixed_frame"_a = nb::none(), "target_stamp_ns"_a = 0,
           "out"_a = nb::none(), "status"_a = nb::none(),
           "Expresses points of the source frame in the target frame.\n\n"
           "Args:\n"
           "    target_frame: The frame to express them in.\n"
           "    source_frame: The frame that they are in.\n"
           "    points: Shape (N, 3), in metres; float32 stays float32, all else becomes float64.\n"
           "    stamps: One time in nanoseconds for all, or int64 of shape (N,): each point's own "
           "time.\n"
           "    fixed_frame: A frame that does not move, such as odom: points are taken from the "
           "source at their own "
           "times\n"
           "        into it, and from it into the target at `target_stamp_ns` (the deskewing of a "
           "lidar's sweep).\n"
           "    target_stamp_ns: The time of the target with a fixed frame; 0 is the latest.\n"
           "    out: An array like `points` to write to; it may be `points` itself or overlap it.\n"
           "    status: As in lookup_batch, with a stamp for each point; points without an answer "
           "become NaN.\n\n"
           "Returns:\n"
           "    (N, 3) points in the target frame.\n\n"
           "Raises:\n"
           "    TransformException: A lookup has no answer.")
      .def(
          "lookup_velocity", &lookup_velocity, "tracking_frame"_a, "observation_frame"_a,
          "stamps"_a = 0, nb::kw_only(), "interval_ns"_a = 100'000'000,
          "reference_frame"_a = nb::none(), "point"_a = nb::make_tuple(0.0, 0.0, 0.0),
          "point_frame"_a = nb::none(), "out"_a = nb::none(), "status"_a = nb::none(),
          "How a body moves: the velocity of a point that is fixed to it, and its angular "
          "velocity.\n\n"
          "The mean over an interval around the time, or over the interval before the latest data "
          "where the middle "
          "would\n"
          "lie beyond it.\n\n"
          "Args:\n"
          "    tracking_frame: The body that moves.\n"
          "    observation_frame: The observer, who is taken for at rest.\n"
          "    stamps: A time in nanoseconds, 0 being the latest; or int64 of shape (N,).\n"
          "    interval_ns: The length of the interval.\n"
          "    reference_frame: The frame in whose axes the answer is given; the observation frame "
          "without it.\n"
          "    point: The point (x, y, z) whose velocity is asked for, in metres.\n"
          "    point_frame: The frame in which the point is given; the tracking frame without it.\n"
          "    out: A float64 array to write to, of the shape of the result.\n"
          "    status: As in lookup_batch.\n\n"
          "Returns:\n"
          "    vx, vy, vz in m/s and wx, wy, wz in rad/s: shape (6,), or (N, 6) for an array of "
          "stamps.\n\n"
          "Raises:\n"
          "    TransformException: A lookup has no answer.");
}

}  // namespace turtlewire::python
