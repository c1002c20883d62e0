#include "tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace turtlewire {
namespace {

constexpr std::size_t kMostPaths = 1 << 16;
constexpr double kLengthTolerance = 10e-3;  // of a quaternion's squared length, in tf2

Verdict judge_names(std::string_view parent, std::string_view child) {
  if (child == parent) return Verdict::self_transform;
  if (child.empty()) return Verdict::no_child_frame;
  if (parent.empty()) return Verdict::no_parent_frame;
  if (child == kNoParent || parent == kNoParent) return Verdict::reserved_name;
  if (!is_frame_name(child) || !is_frame_name(parent)) return Verdict::bad_name;
  return Verdict::accepted;
}

std::string_view without_slash(std::string_view name) {
  if (!name.empty() && name.front() == '/') name.remove_prefix(1);
  return name;
}

// Whether all rules accept the pose, and its translation changes no path.
bool is_usual(const Pose& pose) {
  return std::fabs(dot(pose.rotation, pose.rotation) - 1.0) < kLengthTolerance &&
         is_finite(pose.translation);
}

Pose pose_of(const PoseRow& row) {
  return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}};
}

}  // namespace

// ---------------------------------------------------------------- in

Tree::Tree(Stamp keep, std::size_t max_frames) : keep_(keep), max_frames_(max_frames) {
  links_.push_back(std::make_unique<Link>(arena_));
  last_link_ = links_.front().get();
}

FrameId Tree::frame(std::string_view name) {
  const FrameId id = frames_.intern(name);
  if (links_.size() < frames_.size()) {
    links_.push_back(std::make_unique<Link>(arena_));
    is_known_.push_back(false);
  }
  if (!is_known_[id]) known_frames_.push_back(id);
  is_known_[id] = true;
  return id;
}

bool Tree::has_room(std::string_view parent, std::string_view child) const {
  if (max_frames_ == 0) return true;
  std::size_t count = known_frames_.size();
  for (const std::string_view name : {parent, child}) {
    const auto id = frames_.find(name);
    count += !id || !is_known_[*id];
  }
  return count <= max_frames_ || count == known_frames_.size();
}

SourceId Tree::sender(std::string_view name) {
  if (!same_name(name, last_sender_name_)) {
    const SourceId id = senders_.intern(name);
    last_sender_name_ = name;
    last_sender_ = id;
  }
  return last_sender_;
}

FrameId Tree::predicted(FrameId id, std::string_view name) const {
  return id != 0 && same_name(frames_[id], name) ? id : 0;
}

Verdict Tree::set(std::string_view parent, std::string_view child, Stamp stamp, const Pose& pose,
                  SourceId source, bool is_static) {
  parent = without_slash(parent);
  child = without_slash(child);
  FrameId child_id = predicted(last_link_->follower, child);
  FrameId parent_id = child_id != 0 ? predicted(links_[child_id]->parent(), parent) : 0;
  if (parent_id == 0) [[unlikely]] {
    const Verdict verdict = judge_names(parent, child);
    if (verdict != Verdict::accepted) return refuse(verdict, parent, child, stamp, pose, source);
  }
  const Sample sample{stamp, {pose.translation, stored(pose.rotation)}};
  if (const Verdict verdict = judge_stored(sample.pose); verdict != Verdict::accepted) [[unlikely]]
    return refuse(verdict, parent, child, stamp, pose, source);
  if (parent_id == 0) [[unlikely]] {
    if (!has_room(parent, child)) {
      is_full_ = true;
      return refuse(Verdict::too_many_frames, parent, child, stamp, pose, source);
    }
    child_id = frame(child);
    parent_id = frame(parent);
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
    added = link.insert(sample, parent_id, keep_) != InsertStatus::too_old;
  }
  if (rules_.keeps_rotations && added && !is_unit(sample.pose.rotation)) link.note_scaling();
  if (link.shape() != shape) [[unlikely]]
    ++version_;
  if (!added) [[unlikely]]
    return refuse(Verdict::old_data, parent, child, stamp, pose, source);
  link.count_sender(source, parent_id, stamp);
  return Verdict::accepted;
}

std::size_t Tree::append(std::span<const Stamp> stamps, std::span<const PoseRow> rows) {
  Link& link = *last_link_;
  const std::uint64_t shape = link.shape();
  const FrameId parent = link.parent_of_sender();
  std::size_t added = 0;
  const auto write = [&](std::span<Sample> room) {
    std::size_t count = 0;
    for (; count < room.size(); ++count) {
      const Pose pose = pose_of(rows[added + count]);
      if (!is_usual(pose)) [[unlikely]] {
        if (judge(pose_of(rows[added + count])) != Verdict::accepted) break;
        link.note_infinity(pose.translation);
      }
      const Quat rotation = stored(pose.rotation);
      room[count] = {stamps[added + count], {pose.translation, rotation}};
      if (rules_.keeps_rotations && !is_unit(rotation)) link.note_scaling();
    }
    return count;
  };
  while (added < rows.size() && count_accepted(rows.subspan(added, 1)) == 1) {
    const std::size_t count = link.append_newer(stamps.subspan(added), parent, keep_, write);
    if (count == 0) break;
    added += count;
  }
  if (added > 0) link.count_more(added, stamps[added - 1]);
  if (link.shape() != shape) ++version_;
  return added;
}

std::size_t Tree::count_accepted(std::span<const PoseRow> rows) const {
  std::size_t count = 0;
  for (; count < rows.size(); ++count) {
    const Pose pose = pose_of(rows[count]);
    if (!is_usual(pose) && judge(pose) != Verdict::accepted) break;
  }
  return count;
}

Verdict Tree::judge_stored(const Pose& pose) const {
  if (has_nan(pose.translation) || has_nan(pose.rotation)) return Verdict::nan_value;
  if (rules_.keeps_rotations &&
      !(std::fabs(dot(pose.rotation, pose.rotation) - 1.0) < kLengthTolerance))
    return Verdict::denormalized;
  return Verdict::accepted;
}

Verdict Tree::judge(std::string_view parent, std::string_view child, const Pose& pose) const {
  parent = without_slash(parent);
  child = without_slash(child);
  const Verdict verdict = judge_names(parent, child);
  if (verdict != Verdict::accepted) return verdict;
  if (const Verdict unfit = judge(pose); unfit != Verdict::accepted) return unfit;
  return has_room(parent, child) ? Verdict::accepted : Verdict::too_many_frames;
}

Verdict Tree::refuse(Verdict verdict, std::string_view parent, std::string_view child, Stamp stamp,
                     const Pose& pose, SourceId source) {
  refusals_.add({verdict, parent, child, senders_[source], stamp, pose});
  return verdict;
}

std::vector<std::string> Tree::remove(std::span<const FrameId> children) {
  std::vector<std::string> names;
  std::vector<FrameId> concerned;
  for (const FrameId child : children) {
    Link& link = *links_[child];
    if (link.kind() == LinkKind::none) continue;
    names.push_back(name(child));
    concerned.push_back(child);
    link.for_parents([&](FrameId parent) {
      if (concerned.back() != parent) concerned.push_back(parent);
    });
    link.reset();
  }
  if (!names.empty()) forget(std::move(concerned));
  return names;
}

// Forgets those of the frames that are neither child nor parent of a link. The name of a forgotten
// frame is freed unless it is still shown as the parent that a sender gave.
void Tree::forget(std::vector<FrameId> frames) {
  std::vector<bool> is_parent(links_.size()), is_shown(links_.size());
  for (const auto& link : links_) {
    link->for_parents([&](FrameId parent) { is_parent[parent] = true; });
    for (const Sender& sender : link->senders()) is_shown[sender.parent] = true;
  }
  for (const FrameId frame : frames) {
    if (links_[frame]->kind() == LinkKind::none && !is_parent[frame] && frame != 0)
      is_known_[frame] = false;
  }
  std::erase_if(known_frames_, [&](FrameId frame) { return !is_known_[frame]; });
  is_full_ = false;
  for (FrameId frame = 1; frame < links_.size(); ++frame) {
    if (!is_known_[frame] && !is_shown[frame] && !frames_[frame].empty()) frames_.free(frame);
  }
  drop_paths();
  ++version_;
}

void Tree::clear() {
  for (const auto& link : links_) link->clear(!rules_.clears_static);
  ++version_;
}

// ---------------------------------------------------------------- names

const Link* Tree::find_link(std::string_view child) const {
  const auto known = frames_.find(without_slash(child));
  return known && *known != 0 && is_known_[*known] ? links_[*known].get() : nullptr;
}

Status Tree::resolve(std::string_view name, FrameId& id) const {
  if (name.empty()) return Status::empty_name;
  if (name.front() == '/') return Status::slash_name;
  const auto known = frames_.find(name);
  if (!known || *known == 0 || !is_known_[*known]) return Status::unknown_frame;
  id = *known;
  return Status::ok;
}

// The top of the frame's present tree; some frame of the loop, should there be one.
FrameId Tree::root(FrameId frame) const {
  for (int depth = 0; links_[frame]->has_data() && depth < kMaxGraphDepth; ++depth)
    frame = links_[frame]->parent();
  return frame;
}

// ---------------------------------------------------------------- paths

void Tree::drop_paths() {
  paths_.clear();
  ++path_epoch_;
}

namespace {

std::uint64_t pair_of(FrameId target, FrameId source) {
  return std::uint64_t{target} << 32 | source;
}

}  // namespace

const Path* Tree::known_path(FrameId target, FrameId source) const {
  const auto known = paths_.find(pair_of(target, source));
  return known != paths_.end() && is_current(*known->second) ? known->second.get() : nullptr;
}

const Path& Tree::path(FrameId target, FrameId source) {
  if (paths_.size() >= kMostPaths) drop_paths();
  auto& known = paths_[pair_of(target, source)];
  if (!known) {
    known = std::make_unique<Path>();
    known->target = target;
    known->source = source;
  }
  if (!is_current(*known)) build(*known);
  return *known;
}

// The frames from `frame` to its root. False if a walk up this line can end otherwise than at the
// root.
bool Tree::ancestors(FrameId frame, std::vector<FrameId>& line) const {
  for (;; frame = links_[frame]->parent()) {
    line.push_back(frame);
    const Link& link = *links_[frame];
    if (link.kind() == LinkKind::none) return true;
    if (!link.has_data() || link.reparented() || link.has_infinity() || link.has_scaling() ||
        line.size() > kMaxGraphDepth)
      return false;
  }
}

void Tree::add_step(std::vector<Step>& arm, const Link& link) const {
  if (!link.is_static()) {
    arm.push_back({&link, {}});
  } else if (!arm.empty() && arm.back().link == nullptr) {
    arm.back().fixed = link.static_pose() * arm.back().fixed;
  } else {
    arm.push_back({nullptr, link.static_pose()});
  }
}

void Tree::build(Path& path) const {
  path.version = version_;
  path.no_time = rules_.no_time;
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

}  // namespace turtlewire
