#include "buffer.hpp"

#include <algorithm>

namespace turtlewire {
namespace {

constexpr std::size_t kMostPaths = 1 << 16;

std::string_view without_slash(std::string_view name) {
  if (!name.empty() && name.front() == '/') name.remove_prefix(1);
  return name;
}

void add_time(Stamp stamp, Stamp& earliest) {
  if (stamp != 0 && (earliest == 0 || stamp < earliest)) earliest = stamp;
}

}  // namespace

// ---------------------------------------------------------------- in

Buffer::Buffer(Stamp keep) : keep_(keep) {
  links_.push_back(std::make_unique<Link>());
  last_link_ = links_.front().get();
}

FrameId Buffer::frame(std::string_view name) {
  const FrameId id = frames_.intern(name);
  if (links_.size() < frames_.size()) links_.push_back(std::make_unique<Link>());
  return id;
}

FrameId Buffer::predicted(FrameId id, std::string_view name) const { return id != 0 && frames_[id] == name ? id : 0; }

Verdict Buffer::set(std::string_view parent, std::string_view child, Stamp stamp, const Pose& pose, SourceId source,
                    bool is_static) {
  parent = without_slash(parent);
  child = without_slash(child);
  FrameId child_id = predicted(last_link_->follower, child);
  FrameId parent_id = child_id != 0 ? predicted(links_[child_id]->parent(), parent) : 0;
  if (parent_id == 0) [[unlikely]] {
    if (child == parent) return Verdict::self_transform;
    if (child.empty()) return Verdict::no_child_frame;
    if (parent.empty()) return Verdict::no_parent_frame;
    if (child == frames_[0] || parent == frames_[0]) return Verdict::reserved_name;
    if (!is_frame_name(child) || !is_frame_name(parent)) return Verdict::bad_name;
  }
  Sample sample{{pose.translation, canonical(pose.rotation)}, parent_id, source};
  if (has_nan(pose.translation) || has_nan(sample.pose.rotation)) return Verdict::nan_value;
  if (parent_id == 0) [[unlikely]] {
    child_id = frame(child);
    parent_id = sample.parent = frame(parent);
    last_link_->follower = child_id;
  }
  Link& link = *links_[child_id];
  last_link_ = &link;
  const std::uint64_t shape = link.shape();
  bool added = true;
  if (is_static) {
    if (!link.is_static() || link.static_pose() != sample.pose) ++version_;
    link.become(LinkKind::static_link);
    link.set_static(parent_id, sample.pose);
  } else {
    link.become(LinkKind::dynamic_link);
    added = link.insert(stamp, sample, keep_) != InsertStatus::too_old;
  }
  if (link.shape() != shape) [[unlikely]]
    ++version_;
  if (!added) return Verdict::old_data;
  link.sender = source;
  return Verdict::accepted;
}

void Buffer::clear() {
  for (const auto& link : links_) link->clear();
  ++version_;
}

// ---------------------------------------------------------------- names

Status Buffer::resolve(std::string_view name, FrameId& id) const {
  if (name.empty()) return Status::empty_name;
  if (name.front() == '/') return Status::slash_name;
  const auto known = frames_.find(name);
  if (!known || *known == 0) return Status::unknown_frame;
  id = *known;
  return Status::ok;
}

// The top of the frame's present tree; some frame of the loop, should there be one.
FrameId Buffer::root(FrameId frame) const {
  for (int depth = 0; links_[frame]->has_data() && depth < kMaxGraphDepth; ++depth) frame = links_[frame]->parent();
  return frame;
}

// ---------------------------------------------------------------- paths

const Path& Buffer::path(FrameId target, FrameId source) {
  if (paths_.size() >= kMostPaths) {
    paths_.clear();
    ++path_epoch_;
  }
  auto& known = paths_[static_cast<std::uint64_t>(target) << 32 | source];
  if (!known) {
    known = std::make_unique<Path>();
    known->target = target;
    known->source = source;
  }
  if (!is_current(*known)) build(*known);
  return *known;
}

// The frames from `frame` to its root. False if a walk up this line can end otherwise than at the root.
bool Buffer::ancestors(FrameId frame, std::vector<FrameId>& line) const {
  for (;; frame = links_[frame]->parent()) {
    line.push_back(frame);
    const Link& link = *links_[frame];
    if (link.kind() == LinkKind::none) return true;
    if (!link.has_data() || link.reparented() || link.has_infinity() || line.size() > kMaxGraphDepth) return false;
  }
}

void Buffer::add_step(std::vector<Step>& arm, const Link& link) const {
  if (!link.is_static()) {
    arm.push_back({&link, {}});
  } else if (!arm.empty() && arm.back().link == nullptr) {
    arm.back().fixed = link.static_pose() * arm.back().fixed;
  } else {
    arm.push_back({nullptr, link.static_pose()});
  }
}

void Buffer::build(Path& path) const {
  path.version = version_;
  path.up.clear();
  path.down.clear();
  std::vector<FrameId> from_source, from_target;
  path.direct = ancestors(path.source, from_source) && ancestors(path.target, from_target) &&
                from_source.back() == from_target.back();
  if (!path.direct) return;
  while (from_source.size() > 1 && from_target.size() > 1 &&
         from_source[from_source.size() - 2] == from_target[from_target.size() - 2]) {
    from_source.pop_back();
    from_target.pop_back();
  }
  from_source.pop_back();
  from_target.pop_back();
  for (const FrameId frame : from_source) add_step(path.up, *links_[frame]);
  for (const FrameId frame : from_target) add_step(path.down, *links_[frame]);
  if (path.down.size() == 1 && path.down.front().link == nullptr) {
    const Pose target_from_top = inverse(path.down.front().fixed);
    path.down.clear();
    if (!path.up.empty() && path.up.back().link == nullptr) {
      path.up.back().fixed = target_from_top * path.up.back().fixed;
    } else {
      path.up.push_back({nullptr, target_from_top});
    }
  }
}

// ---------------------------------------------------------------- questions

Status Buffer::lookup(const Path& path, Stamp& t, Pose& target_from_source, Failure* failure) const {
  if (path.direct) [[likely]] {
    const Stamp at = t != 0 ? t : turtlewire::latest_common_time(path);
    if (follow(path, at, target_from_source)) [[likely]] {
      t = at;
      target_from_source.rotation = canonical(target_from_source.rotation);
      return Status::ok;
    }
  }
  return walk(path.target, path.source, t, &target_from_source, failure);
}

Status Buffer::can_transform(const Path& path, Stamp t, Failure* failure) const {
  if (path.direct && covers(path, t != 0 ? t : turtlewire::latest_common_time(path))) return Status::ok;
  return walk(path.target, path.source, t, nullptr, failure);
}

// By the newest parent of each link, whatever the time; the frames of one line ask for each link's newest stamp, and a
// stamp of 0 counts as static.
Status Buffer::latest_common_time(FrameId target, FrameId source, Stamp& t, Failure* failure) const {
  t = 0;
  if (target == source) {
    t = newest(source);
    return Status::ok;
  }
  std::vector<std::pair<Stamp, FrameId>> line;  // of the source: newest stamp and parent of each link
  int depth = 0;
  Stamp earliest = 0;
  for (FrameId frame = source; links_[frame]->has_data();) {
    const Link& link = *links_[frame];
    add_time(link.newest(), earliest);
    line.emplace_back(link.newest(), link.parent());
    frame = link.parent();
    if (frame == target) {
      t = earliest;
      return Status::ok;
    }
    if (++depth > kMaxGraphDepth) return fail_loop(failure);
  }
  depth = 0;
  earliest = 0;
  for (FrameId frame = target; links_[frame]->has_data();) {
    const Link& link = *links_[frame];
    add_time(link.newest(), earliest);
    frame = link.parent();
    const auto meeting =
        std::find_if(line.begin(), line.end(), [&](const auto& entry) { return entry.second == frame; });
    if (meeting != line.end()) {
      for (auto it = line.begin(); it != meeting + 1; ++it) add_time(it->first, earliest);
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

// One step upwards after another, from a start frame; remembers why it could not go on.
struct Buffer::Climb {
  const Buffer& buffer;
  Stamp t;
  FrameId frame;
  Pose top_from_start{};
  ReadStatus stopped = ReadStatus::ok;

  // Reads the link above `frame`; false if that has no data at t.
  bool read(Reading& reading) {
    reading = buffer.links_[frame]->read(t);
    stopped = reading.status;
    return reading.status == ReadStatus::ok;
  }
  void step(const Reading& reading) {
    top_from_start = reading.pose * top_from_start;
    frame = reading.parent;
  }
};

// tf2's own order of steps, which decides what happens with links that do not reach: those above the meeting point do
// not hurt, the target's complaint comes before the source's, and the parents are those of the time asked for.
Status Buffer::walk(FrameId target, FrameId source, Stamp& t, Pose* target_from_source, Failure* failure) const {
  if (t == 0) {
    if (const Status status = latest_common_time(target, source, t, failure); status != Status::ok) return status;
  }
  Reading reading;
  Climb up{*this, t, source};
  for (int depth = 0; links_[up.frame]->kind() != LinkKind::none && up.read(reading);) {
    if (up.frame == target) {
      if (target_from_source != nullptr) {
        *target_from_source = {up.top_from_start.translation, canonical(up.top_from_start.rotation)};
      }
      return Status::ok;
    }
    up.step(reading);
    if (++depth > kMaxGraphDepth) return fail_loop(failure);
  }
  Climb down{*this, t, target};
  for (int depth = 0; down.frame != up.frame && links_[down.frame]->kind() != LinkKind::none;) {
    if (!down.read(reading)) return fail_reading(down, target, source, failure);
    if (down.frame == source) break;
    down.step(reading);
    if (++depth > kMaxGraphDepth) return fail_loop(failure);
  }
  const bool met = down.frame == up.frame;
  if (!met && down.frame != source) {
    if (up.stopped != ReadStatus::ok) return fail_reading(up, target, source, failure);
    return fail_connection(target, source, failure);
  }
  if (target_from_source != nullptr) {
    const Pose p = met ? between(down.top_from_start, up.top_from_start) : inverse(down.top_from_start);
    *target_from_source = {p.translation, canonical(p.rotation)};
  }
  return Status::ok;
}

Status Buffer::fail_loop(Failure* failure) const {
  if (failure != nullptr) {
    failure->status = Status::loop;
    failure->frames = frames_as_string();
  }
  return Status::loop;
}

Status Buffer::fail_connection(FrameId target, FrameId source, Failure* failure) const {
  if (failure != nullptr) {
    failure->status = Status::not_connected;
    failure->target = name(target);
    failure->source = name(source);
    failure->target_root = name(root(target));
    failure->source_root = name(root(source));
  }
  return Status::not_connected;
}

Status Buffer::fail_reading(const Climb& climb, FrameId target, FrameId source, Failure* failure) const {
  const Status status = climb.stopped == ReadStatus::future ? Status::future
                        : climb.stopped == ReadStatus::past ? Status::past
                                                            : Status::no_data;
  if (failure != nullptr) {
    const Link& link = *links_[climb.frame];
    failure->status = status;
    failure->target = name(target);
    failure->source = name(source);
    failure->link_child = name(climb.frame);
    failure->link_parent = name(link.parent());
    failure->emptied = !link.has_data();
    failure->requested = climb.t;
    failure->oldest = link.oldest();
    failure->newest = link.newest();
  }
  return status;
}

}  // namespace turtlewire
