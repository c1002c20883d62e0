#include "inspection.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "errors.hpp"
#include "transform.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

using PoseRows = nb::ndarray<const double, nb::shape<-1, 7>, nb::c_contig, nb::device::cpu>;

nb::str text(std::string_view value) { return nb::str(value.data(), value.size()); }

[[noreturn]] void raise_failure(BufferObject& self, const Failure& failure) {
  raise(failure, Question::lookup, nb::find(self).ptr());
  throw nb::python_error();
}

// The names of two frames; raises if one has no UTF-8.
Request frames_of(const nb::str& target, const nb::str& source) {
  Request request;
  if (!text_of(target.ptr(), request.target, "target_frame") ||
      !text_of(source.ptr(), request.source, "source_frame")) {
    throw nb::python_error();
  }
  return request;
}

// Both names as frames; raises if one is none. Call with the lock held.
bool resolve_both(const Tree& tree, std::string_view target, std::string_view source,
                  FrameId& target_id, FrameId& source_id, Failure& failure) {
  failure.status = tree.resolve(target, target_id);
  failure.name = target;
  if (failure.status != Status::ok) return false;
  failure.argument = Argument::source;
  failure.status = tree.resolve(source, source_id);
  failure.name = source;
  return failure.status == Status::ok;
}

nb::object extrapolate_transform(BufferObject& self, nb::str target, nb::str source,
                                 nb::handle when, Stamp limit) {
  const Request names = frames_of(target, source);
  const Stamp t = nanoseconds_of(when, "stamp_ns");
  if (limit < 0) throw nb::value_error("limit_ns must not be negative");
  Found found{t, {}};
  Failure failure;
  {
    const SharedBuffer::Access access(self.shared);
    FrameId target_id = 0, source_id = 0;
    const Tree& tree = *access;
    if (resolve_both(tree, names.target, names.source, target_id, source_id, failure) &&
        target_id != source_id) {
      failure.status = tree.lookup(target_id, source_id, Rule{.t = t, .beyond = limit},
                                   found.target_from_source, nullptr, &failure);
    }
  }
  if (failure.status != Status::ok) raise_failure(self, failure);
  return nb::steal(make_transform(target.ptr(), source.ptr(), found));
}

nb::tuple lookup_latest(BufferObject& self, nb::str target, nb::str source, Stamp max_age,
                        nb::handle present) {
  const Request names = frames_of(target, source);
  const Stamp now = nanoseconds_of(present, "now_ns");
  if (max_age != 0 && now == 0)
    throw nb::value_error("max_age_ns needs now_ns, the present by the clock of the stamps");
  Found found;
  Failure failure;
  std::vector<FrameId> used;
  std::vector<std::pair<std::string, Stamp>> stamps;
  {
    const SharedBuffer::Access access(self.shared);
    FrameId target_id = 0, source_id = 0;
    const Tree& tree = *access;
    if (resolve_both(tree, names.target, names.source, target_id, source_id, failure) &&
        target_id != source_id) {
      const Rule rule{.t = now, .newest = true, .max_age = max_age};
      failure.status =
          tree.lookup(target_id, source_id, rule, found.target_from_source, &used, &failure);
    }
    for (const FrameId frame : used) {
      const Link& link = tree.link(frame);
      if (!link.is_static()) stamps.emplace_back(tree.frames()[frame], link.newest());
    }
  }
  if (failure.status != Status::ok) raise_failure(self, failure);
  nb::dict by_child;
  for (const auto& [child, stamp] : stamps) {
    by_child[text(child)] = stamp;
    found.stamp = found.stamp == 0 ? stamp : std::min(found.stamp, stamp);
  }
  return nb::make_tuple(nb::steal(make_transform(target.ptr(), source.ptr(), found)), by_child);
}

bool remove_frame(BufferObject& self, std::string_view child) {
  const SharedBuffer::Access access(self.shared);
  FrameId id = 0;
  return access->resolve(child, id) == Status::ok && !access->remove({&id, 1}).empty();
}

nb::list remove_stale(BufferObject& self, nb::handle since) {
  const Stamp before = nanoseconds_of(since, "before_ns");
  std::vector<std::string> removed;
  {
    const SharedBuffer::Access access(self.shared);
    Tree& tree = *access;
    std::vector<FrameId> stale;
    for (const FrameId frame : tree.known_frames()) {
      const Link& link = tree.link(frame);
      if (link.kind() == LinkKind::dynamic_link && link.newest() < before) stale.push_back(frame);
    }
    removed = tree.remove(stale);
  }
  nb::list names;
  for (const std::string& name : removed) names.append(text(name));
  return names;
}

// ---------------------------------------------------------------- descriptions, for
// turtlewire.tf.inspection

struct LinkDescription {
  std::string child, parent;
  bool is_static;
  std::size_t length;
  Stamp oldest, newest;
  std::size_t parent_changes, bytes;
  std::vector<std::tuple<std::string, std::string, std::uint64_t, Stamp>> senders;
};

nb::list describe_links(BufferObject& self, std::size_t most) {
  std::vector<LinkDescription> links;
  {
    const SharedBuffer::Access access(self.shared);
    const Tree& tree = *access;
    const auto name = [&](FrameId id) { return std::string(tree.frames()[id]); };
    for (const FrameId frame : tree.known_frames()) {
      const Link& link = tree.link(frame);
      if (link.kind() == LinkKind::none) continue;
      if (links.size() == most) break;
      links.push_back({name(frame),
                       name(link.parent()),
                       link.is_static(),
                       link.has_data() ? link.length() : 0,
                       link.oldest(),
                       link.newest(),
                       link.parent_changes(),
                       link.samples().bytes(),
                       {}});
      for (const Sender& sender : link.senders()) {
        links.back().senders.emplace_back(tree.sender_name(sender.id), name(sender.parent),
                                          sender.samples, sender.newest);
      }
    }
  }
  nb::list list;
  for (const LinkDescription& d : links) {
    nb::list senders;
    for (const auto& [who, parent, samples, newest] : d.senders) {
      senders.append(nb::make_tuple(text(who), text(parent), samples, newest));
    }
    list.append(nb::make_tuple(text(d.child), text(d.parent), d.is_static, d.length, d.oldest,
                               d.newest, d.parent_changes, d.bytes, senders));
  }
  return list;
}

// By child frame: the counts by kind of refusal, and the text of the last one.
nb::dict describe_refusals(BufferObject& self) {
  static constexpr const char* kinds[kVerdicts] = {
      "accepted", "self_transform", "no_child_frame", "no_parent_frame", "nan_value",
      "old_data", "reserved_name",  "bad_name",       "too_many_frames"};
  std::map<std::string, RefusalRecord, std::less<>> records;
  {
    const SharedBuffer::Access access(self.shared);
    records = access->refusals().by_child();
  }
  nb::dict all;
  for (const auto& [child, record] : records) {
    nb::dict counts;
    for (std::size_t kind = 1; kind < kVerdicts; ++kind) {
      if (record.counts[kind] > 0) counts[kinds[kind]] = record.counts[kind];
    }
    const std::string last = explain(
        Refusal{record.last, record.parent, child, record.authority, record.stamp, record.pose});
    PyObject* decoded =
        PyUnicode_DecodeUTF8(last.data(), static_cast<Py_ssize_t>(last.size()), "replace");
    PyObject* key =
        PyUnicode_DecodeUTF8(child.data(), static_cast<Py_ssize_t>(child.size()), "replace");
    all[nb::steal(key)] = nb::make_tuple(counts, nb::steal(decoded));
  }
  return all;
}

// How many messages could not be decoded, what was wrong with the last one, and who sent it.
nb::tuple describe_malformed(BufferObject& self) {
  MalformedMessages malformed;
  std::string sender;
  {
    const SharedBuffer::Access access(self.shared);
    malformed = access->refusals().malformed();
    if (malformed.count > 0) sender = access->sender_name(malformed.source);
  }
  return nb::make_tuple(malformed.count, text(malformed.last), text(sender));
}

void rename_sender(BufferObject& self, std::string_view name, std::string_view shown) {
  const SharedBuffer::Access access(self.shared);
  access->rename_sender(name, shown);
}

// ---------------------------------------------------------------- whole histories

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
    const std::string_view parent = tree.frames()[sample.parent];
    if (runs.empty() || runs.back().parent != parent) runs.push_back({std::string(parent), {}, {}});
    runs.back().stamps.push_back(link.samples().stamp(i));
    runs.back().poses.push_back(sample.pose);
  }
  return runs;
}

nb::list samples(BufferObject& self, std::string_view child) {
  std::vector<Run> runs;
  Failure failure;
  {
    const SharedBuffer::Access access(self.shared);
    FrameId id = 0;
    failure.status = access->resolve(child, id);
    failure.name = child;
    if (failure.status == Status::ok) runs = runs_of(*access, access->link(id));
  }
  if (failure.status != Status::ok) raise_failure(self, failure);
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
    list.append(nb::make_tuple(text(run.parent), stamps, poses));
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
  if (failure.status != Status::ok) raise_failure(self, failure);
  const auto result = new_array<Stamp>({found.size()});
  std::copy(found.begin(), found.end(), result.data());
  return result;
}

std::size_t set_transforms(BufferObject& self, std::string_view parent, std::string_view child,
                           nb::handle stamps_object, nb::handle poses_object,
                           std::string_view authority) {
  const Stamps stamps = stamps_of(stamps_object);
  PoseRows rows;
  const nb::object array = contiguous_array(poses_object, "float64");
  if (!is_array(array, rows)) throw nb::value_error("poses must have the shape (N, 7)");
  check_shape(rows, {stamps.shape(0), 7}, "poses");
  std::size_t accepted = 0;
  {
    const Unlocked unlocked;
    const SharedBuffer::Access access(self.shared);
    const SourceId sender = access->sender(authority);
    for (std::size_t i = 0; i < stamps.shape(0); ++i) {
      const double* v = rows.data() + 7 * i;
      const Pose pose{{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
      accepted +=
          access->set(parent, child, stamps.data()[i], pose, sender, false) == Verdict::accepted;
    }
    if (accepted > 0) access.wake_waiters();
  }
  if (accepted > 0) self.call_listeners();
  return accepted;
}

}  // namespace

void add_inspection_methods(nb::class_<BufferObject>& cls) {
  cls.def("extrapolate_transform", &extrapolate_transform, "target_frame"_a, "source_frame"_a,
          "stamp_ns"_a, "limit_ns"_a,
          "lookup_transform, but a time up to `limit_ns` outside of a link's data is answered as "
          "well.\n\n"
          "The motion between the two outermost samples of the link is taken to go on. tf2 never "
          "does this; a lookup "
          "that\n"
          "does not name a limit never does either.\n\n"
          "Raises:\n"
          "    TransformException: As lookup_transform; the time lies still further outside.")
      .def("lookup_latest", &lookup_latest, "target_frame"_a, "source_frame"_a, nb::kw_only(),
           "max_age_ns"_a = 0, "now_ns"_a = 0,
           "The transform made of the newest data of each link, whatever its time.\n\n"
           "lookup_transform at time 0 takes all links at one time, the newest that all of them "
           "know; one link that is\n"
           "late makes the whole answer late. Here each link gives its newest pose.\n\n"
           "Args:\n"
           "    target_frame: The frame in which the answer is expressed.\n"
           "    source_frame: The frame whose pose is asked for.\n"
           "    max_age_ns: How old the newest data of a link may be at `now_ns`; 0 allows any "
           "age.\n"
           "    now_ns: The present, by the clock of the stamps.\n\n"
           "Returns:\n"
           "    The Transform, stamped with the oldest of the times used, and those times by child "
           "frame.\n\n"
           "Raises:\n"
           "    TransformException: A frame is unknown, the frames are not connected, or a link is "
           "too old.")
      .def("remove_frame", &remove_frame, "child_frame"_a,
           "Forgets how a frame lies in its parent: its history or its static transform.\n\n"
           "Names that then stand for nothing are forgotten too.\n\n"
           "Returns:\n"
           "    Whether there was anything to forget.")
      .def("remove_stale", &remove_stale, "before_ns"_a,
           "Removes all frames that move and have no data since a time; returns their names.")
      .def("samples", &samples, "child_frame"_a,
           "The whole history of one frame, oldest first.\n\n"
           "Returns:\n"
           "    For each run of samples with one parent: the parent, the stamps (N,) in "
           "nanoseconds, and the poses (N, "
           "7).\n"
           "    A static transform is one sample with stamp 0.")
      .def("stamps", &stamps, "child_frame"_a,
           "The times of a frame's samples in nanoseconds, oldest first: int64, shape (N,); none "
           "for a static transform.")
      .def("set_transforms", &set_transforms, "parent_frame"_a, "child_frame"_a, "stamps"_a,
           "poses"_a, "authority"_a = "default_authority",
           "set_transform for many samples of one frame.\n\n"
           "Args:\n"
           "    parent_frame: The parent.\n"
           "    child_frame: The child.\n"
           "    stamps: Times in nanoseconds, int64, shape (N,).\n"
           "    poses: x, y, z, qx, qy, qz, qw, shape (N, 7).\n"
           "    authority: Who says so.\n\n"
           "Returns:\n"
           "    How many were accepted.")
      .def("_describe_links", &describe_links, "most"_a)
      .def("_describe_refusals", &describe_refusals)
      .def("_describe_malformed", &describe_malformed)
      .def("_rename_sender", &rename_sender, "name"_a, "shown"_a,
           "Shows another name for a sender, in what it has sent already as well.")
      .def(
          "_fault",
          [](BufferObject& self) {
            const SharedBuffer::Access access(self.shared);
            return access->fault();
          },
          "What is wrong with the buffer's own state; for tests.");
}

}  // namespace turtlewire::python
