// The search between two frames as tf2 does it, step by step.
#include <algorithm>
#include <utility>

#include "tree.hpp"

namespace turtlewire {
namespace {

// The links of one arm or the other; those in both lie above the meeting point.
void leave_difference(std::vector<FrameId>& up, const std::vector<FrameId>& down) {
  std::vector<FrameId> both;
  for (const FrameId frame : down) {
    if (std::find(up.begin(), up.end(), frame) != up.end()) both.push_back(frame);
  }
  up.insert(up.end(), down.begin(), down.end());
  std::erase_if(
      up, [&](FrameId frame) { return std::find(both.begin(), both.end(), frame) != both.end(); });
}

}  // namespace

// ---------------------------------------------------------------- questions

Status Tree::lookup(const Path& path, Stamp& t, Pose& target_from_source, Failure* failure) const {
  if (path.direct) [[likely]] {
    const Stamp at = t != kLatest ? t : turtlewire::latest_common_time(path);
    if (follow(path, at, target_from_source)) [[likely]] {
      t = at;
      target_from_source.rotation = stored(target_from_source.rotation);
      return Status::ok;
    }
  }
  return walk(path.target, path.source, t, &target_from_source, failure);
}

Status Tree::can_transform(const Path& path, Stamp t, Failure* failure) const {
  if (path.direct && covers(path, t != kLatest ? t : turtlewire::latest_common_time(path)))
    return Status::ok;
  return walk(path.target, path.source, t, nullptr, failure);
}

void Tree::add_time(const Link& link, Stamp& earliest) const {
  const Stamp stamp = link.reached();
  if (stamp != kLatest && stamp != rules_.no_time && (earliest == kLatest || stamp < earliest))
    earliest = stamp;
}

// By the newest parent of each link, at any time.
Status Tree::latest_common_time(FrameId target, FrameId source, Stamp& t, Failure* failure) const {
  t = kLatest;
  if (target == source) {
    t = link(source).reached();
    return Status::ok;
  }
  std::vector<const Link*> line;  // of the source
  int depth = 0;
  Stamp earliest = kLatest;
  for (FrameId frame = source; links_[frame]->last_parent() != 0;) {
    const Link& link = *links_[frame];
    add_time(link, earliest);
    line.push_back(&link);
    frame = link.last_parent();
    if (frame == target) {
      t = earliest;
      return Status::ok;
    }
    if (++depth > kMaxGraphDepth) return fail_loop(failure);
  }
  depth = 0;
  earliest = kLatest;
  for (FrameId frame = target; links_[frame]->last_parent() != 0;) {
    const Link& link = *links_[frame];
    add_time(link, earliest);
    frame = link.last_parent();
    const auto meeting = std::find_if(
        line.begin(), line.end(), [&](const Link* below) { return below->last_parent() == frame; });
    if (meeting != line.end()) {
      for (auto it = line.begin(); it != meeting + 1; ++it) add_time(**it, earliest);
      t = earliest;
      return Status::ok;
    }
    if (frame == source) {
      t = earliest;
      return Status::ok;
    }
    if (++depth > kMaxGraphDepth) return fail_loop(failure);
  }
  return fail_connection(target, source, failure);
}

// ---------------------------------------------------------------- the walk of tf2

Reading Rule::read(const Link& link) const {
  if (newest) {
    const Stamp reached = link.reached();
    const bool is_old = max_age != kForever && reached != kLatest && reached < earlier(t, max_age);
    return is_old ? Reading{ReadStatus::future} : link.read(kLatest);
  }
  return beyond != 0 ? link.read_beyond(t, beyond) : link.read(t);
}

// Walks upwards from a start frame, step by step; remembers why it had to stop.
struct Tree::Climb {
  const Tree& buffer;
  const Rule& rule;
  FrameId frame;
  Pose top_from_start{};
  ReadStatus stopped = ReadStatus::ok;

  bool at_root() const { return buffer.links_[frame]->kind() == LinkKind::none; }
  // Reads the link above `frame`; false if that has no answer.
  bool read(Reading& reading) {
    reading = rule.read(*buffer.links_[frame]);
    stopped = reading.status;
    return reading.status == ReadStatus::ok;
  }
  void step(const Reading& reading, std::vector<FrameId>* used) {
    if (used != nullptr) used->push_back(frame);
    top_from_start = buffer.rules_.keeps_rotations ? compose_scaling(reading.pose, top_from_start)
                                                   : reading.pose * top_from_start;
    frame = reading.parent;
  }
};

Status Tree::walk(FrameId target, FrameId source, Stamp& t, Pose* target_from_source,
                  Failure* failure) const {
  if (t == kLatest) {
    if (const Status status = latest_common_time(target, source, t, failure); status != Status::ok)
      return status;
  }
  return climb(target, source, Rule{.t = t}, target_from_source, nullptr, failure);
}

Status Tree::lookup(FrameId target, FrameId source, const Rule& rule, Pose& target_from_source,
                    std::vector<FrameId>* used, Failure* failure) const {
  return climb(target, source, rule, &target_from_source, used, failure);
}

// Follows tf2's own order of steps, which decides what happens with links that have no data at the
// time asked for: those above the meeting point do not hurt, and of two failing legs the one whose
// link has the newer data is reported (since tf2 0.36.20).
Status Tree::climb(FrameId target, FrameId source, const Rule& rule, Pose* target_from_source,
                   std::vector<FrameId>* used, Failure* failure) const {
  Reading reading;
  Climb up{*this, rule, source};
  for (int depth = 0; !up.at_root() && up.read(reading);) {
    if (up.frame == target) {
      up.stopped = ReadStatus::ok;
      break;
    }
    up.step(reading, used);
    if (++depth > kMaxGraphDepth) return fail_loop(failure);
  }
  Climb down{*this, rule, target};
  std::vector<FrameId> down_used;
  for (int depth = 0; down.frame != up.frame && !down.at_root();) {
    if (!down.read(reading)) return fail_reading(later_failure(up, down), target, source, failure);
    if (down.frame == source) break;
    down.step(reading, used != nullptr ? &down_used : nullptr);
    if (++depth > kMaxGraphDepth) return fail_loop(failure);
  }
  const bool met = down.frame == up.frame;
  if (!met && down.frame != source) {
    if (up.stopped != ReadStatus::ok) return fail_reading(up, target, source, failure);
    return fail_connection(target, source, failure);
  }
  if (target_from_source != nullptr) {
    if (!met) up.top_from_start = {};
    const Pose p = rules_.keeps_rotations ? between_scaling(down.top_from_start, up.top_from_start)
                   : met                  ? between(down.top_from_start, up.top_from_start)
                                          : inverse(down.top_from_start);
    *target_from_source = {p.translation, stored(p.rotation)};
  }
  if (used != nullptr) {
    if (met)
      leave_difference(*used, down_used);
    else
      *used = std::move(down_used);
  }
  return Status::ok;
}

const Tree::Climb& Tree::later_failure(const Climb& up, const Climb& down) {
  const auto newest = [](const Climb& climb) { return climb.buffer.links_[climb.frame]->newest(); };
  return up.stopped != ReadStatus::ok && newest(up) >= newest(down) ? up : down;
}

Status Tree::fail_loop(Failure* failure) const {
  if (failure != nullptr) {
    failure->status = Status::loop;
    failure->frames = frames_as_string();
  }
  return Status::loop;
}

Status Tree::fail_connection(FrameId target, FrameId source, Failure* failure) const {
  if (failure != nullptr) {
    failure->status = Status::not_connected;
    failure->target = name(target);
    failure->source = name(source);
    failure->target_root = name(root(target));
    failure->source_root = name(root(source));
  }
  return Status::not_connected;
}

Status Tree::fail_reading(const Climb& climb, FrameId target, FrameId source,
                          Failure* failure) const {
  const Link& link = *links_[climb.frame];
  const Status status = climb.stopped == ReadStatus::future ? Status::future
                        : climb.stopped == ReadStatus::past ? Status::past
                        : link.is_static()                  ? Status::no_static_data
                                                            : Status::no_data;
  if (failure != nullptr) {
    failure->status = status;
    failure->target = name(target);
    failure->source = name(source);
    failure->link_child = name(climb.frame);
    failure->link_parent = name(link.parent());
    failure->emptied = !link.has_data();
    failure->is_emptied_told = rules_.tells_emptied;
    failure->requested = climb.rule.t;
    failure->oldest = link.oldest();
    failure->newest = link.newest();
  }
  return status;
}

}  // namespace turtlewire
