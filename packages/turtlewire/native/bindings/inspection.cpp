#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "buffer_methods.hpp"
#include "errors.hpp"
#include "transform.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

// The names of two frames; raises if one has no UTF-8.
Request frames_of(PyObject* target, PyObject* source) {
  Request request;
  if (!text_of(target, request.target, "target_frame") ||
      !text_of(source, request.source, "source_frame")) {
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

constexpr Parameters<4> kLookupNewest{
    "lookup_newest", 2, 2, {"target_frame", "source_frame", "max_age_ns", "now_ns"}};

nb::object lookup_newest(BufferObject& self, const Values<4>& given) {
  const Request names = frames_of(given[0], given[1]);
  const nb::handle age = or_none(given[2]);
  const Stamp now = moment_of(nb::handle(given[3]), "now_ns");
  const Stamp max_age = age.is_none() ? kForever : nanoseconds_of(age, "max_age_ns");
  if (!age.is_none() && now == kLatest)
    throw nb::value_error("max_age_ns needs now_ns, the present by the clock of the stamps");
  if (max_age < 0) throw nb::value_error("max_age_ns must not be negative");
  Found found;
  Failure failure;
  {
    const SharedBuffer::Access access(self.shared);
    std::vector<FrameId> used;
    FrameId target_id = 0, source_id = 0;
    const Tree& tree = *access;
    if (resolve_both(tree, names.target, names.source, target_id, source_id, failure) &&
        target_id != source_id) {
      const Rule rule{.t = now, .newest = true, .max_age = max_age};
      failure.status =
          tree.lookup(target_id, source_id, rule, found.target_from_source, &used, &failure);
    }
    for (const FrameId frame : used) {
      const Stamp newest = tree.link(frame).reached();
      if (newest != kLatest && (found.stamp == kLatest || newest < found.stamp))
        found.stamp = newest;
    }
  }
  if (failure.status != Status::ok) throw_failure(self, failure, Question::lookup);
  return nb::steal(make_transform(given[0], given[1], found));
}

// When lookups answer: from the oldest common time to the latest; None if always.
constexpr Parameters<2> kTimeRange{"time_range", 2, 2, {"target_frame", "source_frame"}};

nb::object time_range(BufferObject& self, const Values<2>& given) {
  const Request names = frames_of(given[0], given[1]);
  Failure failure;
  Stamp oldest = kLatest, newest = kLatest;
  {
    const SharedBuffer::Access access(self.shared);
    std::vector<FrameId> used;
    FrameId target_id = 0, source_id = 0;
    const Tree& tree = *access;
    if (resolve_both(tree, names.target, names.source, target_id, source_id, failure) &&
        target_id != source_id) {
      failure.status = tree.latest_common_time(target_id, source_id, newest, &failure);
      Pose unused;
      if (failure.status == Status::ok)
        failure.status =
            tree.lookup(target_id, source_id, Rule{.t = newest}, unused, &used, &failure);
    }
    for (const FrameId frame : used) {
      if (!tree.link(frame).is_static()) oldest = std::max(oldest, tree.link(frame).oldest());
    }
  }
  if (failure.status != Status::ok) throw_failure(self, failure, Question::lookup);
  if (newest == kLatest || oldest == kLatest) return nb::none();
  return nb::make_tuple(oldest, newest);
}

constexpr Parameters<1> kRemoveFrame{"remove_frame", 1, 1, {"child_frame"}};

nb::bool_ remove_frame(BufferObject& self, const Values<1>& given) {
  const std::string_view child = text_of(nb::handle(given[0]), "child_frame");
  const SharedBuffer::Access access(self.shared);
  FrameId id = 0;
  return nb::bool_(access->resolve(child, id) == Status::ok && !access->remove({&id, 1}).empty());
}

constexpr Parameters<1> kRemoveStale{"remove_stale", 1, 1, {"before_ns"}};

nb::list remove_stale(BufferObject& self, const Values<1>& given) {
  const Stamp before = nanoseconds_of(nb::handle(given[0]), "before_ns");
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
// turtlewire.tf.links and turtlewire.tf.faults

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
                       link.samples().parent_changes(),
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
      "old_data", "reserved_name",  "bad_name",       "too_many_frames", "denormalized"};
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
    all[nb::steal(to_python(child))] = nb::make_tuple(counts, nb::steal(to_python(last)));
  }
  return all;
}

// How many pairs of a frame and a reason were refused, without the lack of room.
std::size_t refusal_kinds(BufferObject& self) {
  const SharedBuffer::Access access(self.shared);
  return access->refusals().kinds();
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

}  // namespace

std::array<PyMethodDef, 4> inspection_methods() {
  return {{
      buffer_method<kLookupNewest, lookup_newest>(
          "lookup_newest($self, target_frame, source_frame, *, max_age_ns=None, now_ns=None)"
          "\n--\n\n"
          "The transform made of the newest data of each link, whatever its time.\n\n"
          "lookup_transform takes all links at one time, the newest that all of them know; one "
          "link that is late makes the whole answer late. Here each link gives its newest "
          "pose.\n\n"
          "Args:\n"
          "    target_frame: The frame in which the answer is expressed.\n"
          "    source_frame: The frame whose pose is asked for.\n"
          "    max_age_ns: How old the newest data of a link may be at `now_ns`; None allows any "
          "age.\n"
          "    now_ns: The present, by the clock of the stamps.\n\n"
          "Returns:\n"
          "    The Transform, stamped with the oldest of the times used.\n\n"
          "Raises:\n"
          "    TransformException: A frame is unknown, the frames are not connected, or a link is "
          "too old."),
      buffer_method<kTimeRange, time_range>(
          "time_range($self, target_frame, source_frame)\n--\n\n"
          "The oldest and the newest time at which lookup_transform gives an answer.\n\n"
          "Returns:\n"
          "    Both times in nanoseconds; None if only static links lie between the frames, which "
          "answer at all times.\n\n"
          "Raises:\n"
          "    TransformException: A frame is unknown, the frames are not connected, or their "
          "links have no time in common."),
      buffer_method<kRemoveFrame, remove_frame>(
          "remove_frame($self, child_frame)\n--\n\n"
          "Forgets how a frame lies in its parent: its history or its static transform.\n\n"
          "Names that are then unused are also forgotten.\n\n"
          "Returns:\n"
          "    Whether there was anything to forget."),
      buffer_method<kRemoveStale, remove_stale>(
          "remove_stale($self, before_ns)\n--\n\n"
          "Removes all frames that move and have no data since a time; returns their names."),
  }};
}

void add_inspection_methods(nb::class_<BufferObject>& cls) {
  cls.def("_describe_links", &describe_links, "most"_a)
      .def("_describe_refusals", &describe_refusals)
      .def("_refusal_kinds", &refusal_kinds)
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
