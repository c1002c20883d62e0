#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "buffer_methods.hpp"
#include "errors.hpp"

namespace turtlewire::python {
namespace {

using PoseRows = nb::ndarray<const double, nb::shape<-1, 7>, nb::c_contig, nb::device::cpu>;

struct Run {
  std::string parent;
  std::vector<Stamp> stamps;
  std::vector<Pose> poses;
};

std::vector<Run> runs_of(const Tree& tree, const Link& link) {
  std::vector<Run> runs;
  if (link.is_static())
    return {{std::string(tree.frames()[link.parent()]), {0}, {link.static_pose()}}};
  for (std::size_t i = 0; i < link.samples().size(); ++i) {
    const Sample& sample = link.samples()[i];
    const std::string_view parent = tree.frames()[link.samples().parent(i)];
    if (runs.empty() || runs.back().parent != parent) runs.push_back({std::string(parent), {}, {}});
    runs.back().stamps.push_back(sample.stamp);
    runs.back().poses.push_back(sample.pose);
  }
  return runs;
}

constexpr Parameters<1> kSamples{"samples", 1, 1, {"child_frame"}};

nb::list samples(BufferObject& self, const Values<1>& given) {
  const std::string_view child = text_of(nb::handle(given[0]), "child_frame");
  std::vector<Run> runs;
  Failure failure;
  {
    const SharedBuffer::Access access(self.shared);
    FrameId id = 0;
    failure.status = access->resolve(child, id);
    failure.name = child;
    if (failure.status == Status::ok) runs = runs_of(*access, access->link(id));
  }
  if (failure.status != Status::ok) throw_failure(self, failure, Question::lookup);
  nb::list list;
  for (const Run& run : runs) {
    const auto stamps = new_array<Stamp>({run.stamps.size()});
    const auto poses = new_array<double>({run.stamps.size(), 7});
    std::copy(run.stamps.begin(), run.stamps.end(), stamps.data());
    for (std::size_t i = 0; i < run.poses.size(); ++i) {
      const auto& [t, q] = run.poses[i];
      const double row[7] = {t.x, t.y, t.z, q.x, q.y, q.z, q.w};
      std::copy_n(row, 7, poses.data() + 7 * i);
    }
    list.append(make_answer("Samples", nb::make_tuple(text(run.parent), stamps, poses)));
  }
  return list;
}

nb::ndarray<nb::numpy, Stamp> stamps(BufferObject& self, std::string_view child) {
  std::vector<Stamp> found;
  Failure failure;
  {
    const SharedBuffer::Access access(self.shared);
    FrameId id = 0;
    failure.status = access->resolve(child, id);
    failure.name = child;
    if (failure.status == Status::ok && !access->link(id).is_static()) {
      const auto& samples = access->link(id).samples();
      found.resize(samples.size());
      for (std::size_t i = 0; i < found.size(); ++i) found[i] = samples.stamp(i);
    }
  }
  if (failure.status != Status::ok) throw_failure(self, failure, Question::lookup);
  const auto result = new_array<Stamp>({found.size()});
  std::copy(found.begin(), found.end(), result.data());
  return result;
}

// (N, 7) from poses or matrices.
nb::object pose_rows(PyObject* poses, bool skip) {
  return checked(taking_gil([=]() -> PyObject* {
    PyObject* module = PyImport_ImportModule("turtlewire.tf.pose_rows");
    if (module == nullptr) return nullptr;
    PyObject* make = PyObject_GetAttrString(module, "pose_rows");
    Py_DECREF(module);
    if (make == nullptr) return nullptr;
    PyObject* arguments = PyTuple_Pack(1, poses);
    PyObject* keywords = Py_BuildValue("{sO}", "skip", skip ? Py_True : Py_False);
    PyObject* result = arguments && keywords ? PyObject_Call(make, arguments, keywords) : nullptr;
    Py_XDECREF(keywords);
    Py_XDECREF(arguments);
    Py_DECREF(make);
    return result;
  }));
}

// Samples of one link, to be added in the order of the rows.
struct Batch {
  std::string_view parent, child, sender;
  const Stamps& stamps;
  const PoseRows& rows;

  std::size_t size() const { return stamps.shape(0); }
  Stamp stamp(std::size_t i) const { return stamps.data()[i]; }
  std::span<const Stamp> stamps_from(std::size_t i) const {
    return {stamps.data() + i, size() - i};
  }
  std::span<const PoseRow> rows_from(std::size_t i) const {
    return {reinterpret_cast<const PoseRow*>(rows.data()) + i, size() - i};
  }
  Pose pose(std::size_t i) const {
    const double* v = rows.data() + 7 * i;
    return {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
  }
};

// The first row that the buffer would not hold when all are added. Samples that are accepted but
// then too old by a later one of the batch count as old.
std::optional<std::pair<std::size_t, Verdict>> first_refused(const Tree& tree, const Batch& batch) {
  if (batch.size() == 0) return std::nullopt;
  Stamp newest = *std::max_element(batch.stamps.data(), batch.stamps.data() + batch.size());
  const Link* link = tree.find_link(batch.child);
  if (link != nullptr && !link->samples().empty()) newest = std::max(newest, link->newest());
  const Stamp limit = earlier(newest, tree.keep());
  const Verdict first = tree.judge(batch.parent, batch.child, batch.pose(0));
  if (first != Verdict::accepted) return std::pair(std::size_t{0}, first);
  const std::size_t accepted = tree.count_accepted(batch.rows_from(0));
  for (std::size_t i = 0; i < accepted; ++i) {
    if (batch.stamp(i) < limit) return std::pair(i, Verdict::old_data);
  }
  if (accepted == batch.size()) return std::nullopt;
  return std::pair(accepted, tree.judge(batch.pose(accepted)));
}

// Returns how many of the rows the buffer now holds.
std::size_t add_rows(Tree& tree, const Batch& batch, SourceId sender) {
  std::vector<Stamp> refused;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Stamp t = batch.stamp(i);
    if (tree.set(batch.parent, batch.child, t, batch.pose(i), sender, false) != Verdict::accepted)
      refused.push_back(t);
    else
      i += tree.append(batch.stamps_from(i + 1), batch.rows_from(i + 1));
  }
  if (refused.size() == batch.size()) return 0;
  const Stamp oldest = tree.find_link(batch.child)->oldest();
  const auto held = [oldest](std::span<const Stamp> stamps) {
    return std::count_if(stamps.begin(), stamps.end(), [oldest](Stamp t) { return t >= oldest; });
  };
  return static_cast<std::size_t>(held({batch.stamps.data(), batch.size()}) - held(refused));
}

constexpr Parameters<6> kSetTransforms{
    "set_transforms", 4, 4, {"parent_frame", "child_frame", "stamps", "poses", "errors", "sender"}};

nb::object set_transforms(BufferObject& self, const Values<6>& given) {
  const std::string_view parent = text_of(nb::handle(given[0]), "parent_frame"),
                         child = text_of(nb::handle(given[1]), "child_frame");
  const bool skips = choice_of(given[4], "errors", "raise", "skip") == 1;
  const std::string_view sender =
      given[5] == nullptr ? kUnknownSender : text_of(nb::handle(given[5]), "sender");
  const Stamps stamps = stamps_of(given[2]);
  const nb::object array = pose_rows(given[3], skips);
  const auto rows = nb::cast<PoseRows>(array);
  check_shape(rows, {stamps.shape(0), 7}, "poses");
  const Batch batch{parent, child, sender, stamps, rows};
  std::optional<std::pair<std::size_t, Verdict>> refused;
  std::size_t kept = 0;
  {
    const Unlocked unlocked;
    const SharedBuffer::Access access(self.shared);
    const SourceId id = access->sender(sender);
    if (!skips) refused = first_refused(*access, batch);
    if (refused) {
      const auto [i, verdict] = *refused;
      access->refuse(verdict, parent, child, batch.stamp(i), batch.pose(i), id);
    } else {
      kept = add_rows(*access, batch, id);
      if (kept > 0) access.wake_waiters();
    }
  }
  if (refused) {
    const auto [i, verdict] = *refused;
    raise(Refusal{verdict, parent, child, sender, batch.stamp(i), batch.pose(i)}, i);
    throw nb::python_error();
  }
  if (kept > 0) self.call_listeners();
  return nb::int_(kept);
}

}  // namespace

std::array<PyMethodDef, 2> history_methods() {
  return {{
      buffer_method<kSamples, samples>(
          "samples($self, child_frame)\n--\n\n"
          "The whole history of one frame, oldest first.\n\n"
          "Returns:\n"
          "    For each run of samples with one parent Samples: the parent, the stamps (N,) in "
          "nanoseconds, and the poses (N, 7).\n"
          "    A static transform is one sample with stamp 0."),
      buffer_method<kSetTransforms, set_transforms>(
          "set_transforms($self, parent_frame, child_frame, stamps, poses, *, errors='raise', "
          "sender='default_authority')\n--\n\n"
          "set_transform for many samples of one frame.\n\n"
          "Args:\n"
          "    parent_frame: The parent.\n"
          "    child_frame: The child.\n"
          "    stamps: Times, shape (N,): integers of nanoseconds, or datetime64.\n"
          "    poses: x, y, z, qx, qy, qz, qw, shape (N, 7); or matrices, shape (N, 4, 4).\n"
          "    errors: 'raise' adds all samples or none; 'skip' leaves out those that "
          "set_transform "
          "refuses.\n"
          "    sender: The name that `links` shows.\n\n"
          "Returns:\n"
          "    How many of the samples the buffer now holds.\n\n"
          "Raises:\n"
          "    InvalidTransformError: A sample is refused, or older than the cache time by the "
          "newest of the batch; `row` is its index.\n"
          "    ValueError: `stamps` or `poses` have another shape."),
  }};
}

void add_history_methods(nb::class_<BufferObject>& cls) {
  cls.def("_stamps", &stamps, nb::arg("child_frame"),
          "The times of a frame's samples in nanoseconds, oldest first: int64, shape (N,); none "
          "for a static transform.");
}

}  // namespace turtlewire::python
