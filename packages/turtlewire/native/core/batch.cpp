#include "batch.hpp"

#include <algorithm>
#include <limits>

namespace turtlewire {
namespace {

constexpr std::size_t kScalarBelow = 12;  // fewer lookups are quicker one by one
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Pose kNoPose{{kNan, kNan, kNan}, {kNan, kNan, kNan, kNan}};

void prefetch(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  static_cast<void>(address);
#endif
}

// The two samples around a time that a link covers, looked for from index `guess` on; twice the
// newest one at its own time.
Samples::Pair pair_at(const Samples& samples, Stamp t, std::size_t guess) {
  if (t == samples.newest()) return {&samples.back(), &samples.back()};
  return t == samples.oldest() ? samples.pair(0) : samples.around(t, guess);
}

void find_in_order(const Samples& samples, const Stamp* times, std::size_t& hint,
                   Samples::Pair* pairs) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    hint = samples.last_at_or_before(times[i], hint);
    pairs[i] = pair_at(samples, times[i], hint);
  }
}

// The samples of all guesses are fetched before the first one is read.
void find_in_any_order(const Samples& samples, const Stamp* times, Samples::Pair* pairs) {
  std::size_t guesses[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) {
    guesses[i] = samples.guess(times[i]);
    const Sample* guessed = &samples[guesses[i]];
    prefetch(guessed);
    prefetch(guessed + 1);
  }
  for (std::size_t i = 0; i < kLanes; ++i) pairs[i] = pair_at(samples, times[i], guesses[i]);
}

}  // namespace

BatchLookup::BatchLookup(SharedBuffer& shared, std::string_view target, std::string_view source,
                         Stamp beyond)
    : shared_(shared), target_(target), source_(source), beyond_(beyond) {}

bool BatchLookup::resolve(const Tree& tree) {
  if (source_id_ != 0 && epoch_ == tree.path_epoch()) return true;
  unresolved_ = tree.resolve(target_, target_id_);
  if (unresolved_ == Status::ok) unresolved_ = tree.resolve(source_, source_id_);
  if (unresolved_ != Status::ok) source_id_ = 0;
  return unresolved_ == Status::ok;
}

Stamp BatchLookup::latest() {
  const SharedBuffer::View tree(shared_);
  Stamp t = kLatest;
  if (resolve(*tree)) tree->latest_common_time(target_id_, source_id_, t, nullptr);
  return t;
}

void BatchLookup::block(std::span<const Stamp> stamps, Lanes& poses, Status* statuses) {
  std::fill_n(statuses, stamps.size(), Status::ok);
  if (target_ == source_) {
    poses.fill({});
    return;
  }
  if (known_block(stamps, poses, statuses)) return;
  const SharedBuffer::Access access(shared_);
  if (resolve(*access)) {
    answer(*access, access->path(target_id_, source_id_), stamps, poses, statuses);
  } else {
    std::fill_n(statuses, stamps.size(), unresolved_);
    poses.fill(kNoPose);
  }
}

// Answers with the lock shared; false if the path must first be built, or a name is unknown.
bool BatchLookup::known_block(std::span<const Stamp> stamps, Lanes& poses, Status* statuses) {
  const SharedBuffer::View tree(shared_);
  const Path* path = resolve(*tree) ? tree->known_path(target_id_, source_id_) : nullptr;
  if (path != nullptr) answer(*tree, *path, stamps, poses, statuses);
  return path != nullptr;
}

void BatchLookup::answer(const Tree& tree, const Path& path, std::span<const Stamp> stamps,
                         Lanes& poses, Status* statuses) {
  epoch_ = tree.path_epoch();
  if (path.version != version_) {
    up_hints_.assign(path.up.size(), 0);
    down_hints_.assign(path.down.size(), 0);
    version_ = path.version;
  }
  if (stamps.size() < kScalarBelow || !path.direct) {
    scalar_block(tree, path, stamps, poses, statuses);
  } else {
    direct_block(tree, path, stamps, poses, statuses);
  }
}

void BatchLookup::scalar_block(const Tree& tree, const Path& path, std::span<const Stamp> stamps,
                               Lanes& poses, Status* statuses) {
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    Pose pose;
    statuses[i] = find(tree, path, stamps[i], pose);
    poses.set(i, statuses[i] == Status::ok ? pose : kNoPose);
  }
}

Status BatchLookup::find(const Tree& tree, const Path& path, Stamp t, Pose& pose) const {
  const Status status = tree.lookup(path, t, pose, nullptr);
  if (status == Status::ok || beyond_ == 0 || t == kLatest) return status;
  const Rule rule{.t = t, .beyond = beyond_};
  return tree.lookup(path.target, path.source, rule, pose, nullptr, nullptr);
}

void BatchLookup::direct_block(const Tree& tree, const Path& path, std::span<const Stamp> stamps,
                               Lanes& poses, Status* statuses) {
  Stamp times[kLanes];
  bool missing[kLanes] = {};
  const Stamp latest = turtlewire::latest_common_time(path);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Stamp t = stamps[std::min(i, stamps.size() - 1)];
    times[i] = t != kLatest ? t : latest;
  }
  arm(path.up, times, up_hints_, missing, poses);
  if (!path.down.empty()) {
    Lanes down;
    arm(path.down, times, down_hints_, missing, down);
    kernels().between(down, poses);
  }
  if (!tree.rules().keeps_rotations) kernels().canonicalize(poses);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if (!missing[i]) continue;
    Pose pose;
    statuses[i] = find(tree, path, times[i], pose);  // tf2's order decides which link it blames
    poses.set(i, statuses[i] == Status::ok ? pose : kNoPose);
  }
}

// An arm without steps is the identity.
void BatchLookup::arm(const std::vector<Step>& steps, const Stamp* stamps, Hints& hints,
                      bool* missing, Lanes& result) {
  if (steps.empty()) result.fill({});
  for (std::size_t s = 0; s < steps.size(); ++s) {
    Lanes step;
    Lanes& pose = s == 0 ? result : step;
    if (steps[s].link == nullptr) {
      pose.fill(steps[s].fixed);
    } else {
      read_link(*steps[s].link, stamps, hints[s], missing, pose);
    }
    if (s > 0) kernels().compose(step, result);
  }
}

void BatchLookup::read_link(const Link& link, const Stamp* stamps, std::size_t& hint, bool* missing,
                            Lanes& result) {
  const Samples& samples = link.samples();
  Stamp times[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) {
    missing[i] |= !link.covers(stamps[i]);
    times[i] = stamps[i] == kLatest || missing[i] ? samples.newest() : stamps[i];
  }
  Samples::Pair pairs[kLanes];
  if (std::is_sorted(times, times + kLanes)) {
    find_in_order(samples, times, hint, pairs);
  } else {
    find_in_any_order(samples, times, pairs);
  }
  Lanes older, newer;
  double ratios[kLanes], spans[kLanes], cosines[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) {
    const Sample &first = *pairs[i].older, &second = *pairs[i].newer;
    older.set(i, first.pose);
    newer.set(i, second.pose);
    ratios[i] = static_cast<double>(elapsed(first.stamp, times[i]));
    spans[i] =
        static_cast<double>(elapsed(first.stamp, second.stamp) + (second.stamp == first.stamp));
  }
  for (std::size_t i = 0; i < kLanes; ++i) ratios[i] /= spans[i];
  kernels().interpolate(older, newer, ratios, result, cosines);
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (cosines[i] <= kNineTermsCosine)
      result.set(i, interpolate(older.pose(i), newer.pose(i), ratios[i]));
  }
}

// ---------------------------------------------------------------- all frames

namespace {

// root_from_frame of all frames at one time, each link read once.
class Forest {
 public:
  Forest(const Tree& tree, Stamp t) : tree_(tree), t_(t), nodes_(tree.frames().size()) {}

  // False if some link above the frame has no pose at the time, or the frames loop.
  bool root_from(FrameId frame, FrameId& root, Pose& pose) {
    line_.clear();
    while (nodes_[frame].state == State::unseen) {
      nodes_[frame].state = State::open;
      line_.push_back(frame);
      const Link& link = tree_.link(frame);
      if (link.has_scaling()) break;
      if (link.kind() == LinkKind::none) {
        nodes_[frame] = {State::known, frame, {}};
        line_.pop_back();
        break;
      }
      nodes_[frame].link = link.read(t_);
      if (nodes_[frame].link.status != ReadStatus::ok) break;
      frame = nodes_[frame].link.parent;
    }
    Node above = nodes_[frame];
    if (above.state == State::open) above.state = State::failed;  // no pose there, or a loop
    for (; !line_.empty(); line_.pop_back()) {
      Node& node = nodes_[line_.back()];
      const bool fits = above.state == State::known && node.link.status == ReadStatus::ok;
      node = {fits ? State::known : State::failed, above.root,
              fits ? above.root_from * node.link.pose : Pose{}, node.link};
      above = node;
    }
    root = above.root;
    pose = above.root_from;
    return above.state == State::known;
  }

 private:
  enum class State : std::uint8_t { unseen, open, known, failed };
  struct Node {
    State state = State::unseen;
    FrameId root = 0;
    Pose root_from;
    Reading link;
  };

  const Tree& tree_;
  Stamp t_;
  std::vector<Node> nodes_;
  std::vector<FrameId> line_;
};

}  // namespace

Status lookup_all(SharedBuffer& shared, std::string_view target, Stamp t,
                  std::vector<FramePose>& found, Failure& failure) {
  found.clear();
  const SharedBuffer::Access access(shared);
  Tree& tree = *access;
  FrameId target_id = 0, target_root = 0, root = 0;
  if (const Status status = tree.resolve(target, target_id); status != Status::ok) {
    failure.status = status;
    failure.name = target;
    return status;
  }
  Forest forest(tree, t);
  Pose root_from_target, root_from_frame;
  const bool at_once = t != kLatest && forest.root_from(target_id, target_root, root_from_target);
  for (const FrameId frame : tree.known_frames()) {
    Pose pose;
    Stamp stamp = t;
    if (frame == target_id) {
      if (t == kLatest) stamp = tree.link(frame).reached();
    } else if (at_once && forest.root_from(frame, root, root_from_frame) && root == target_root) {
      pose = between(root_from_target, root_from_frame);
      pose.rotation = tree.stored(pose.rotation);
    } else if (tree.lookup(tree.path(target_id, frame), stamp, pose, nullptr) != Status::ok) {
      continue;
    }
    found.push_back({std::string(tree.frames()[frame]), stamp, pose});
  }
  return Status::ok;
}

// ---------------------------------------------------------------- velocities

namespace {

constexpr double kNanosecond = 1e-9;

// The axis times the angle of a rotation, by the shorter way.
Vec3 rotation_vector(const Quat& q) {
  const double sign = q.w < 0.0 ? -1.0 : 1.0;
  const double sine = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  const double factor = sine < 1e-9 ? 2.0 : 2.0 * std::atan2(sine, sign * q.w) / sine;
  return {sign * factor * q.x, sign * factor * q.y, sign * factor * q.z};
}

// The body's mean motion from one time to another: the chord of the point's way, and the turn in
// the observer's axes.
Velocity mean_velocity(const Pose& first, const Pose& last, const Vec3& fixed_point,
                       Stamp interval) {
  const double per_second = 1.0 / (kNanosecond * static_cast<double>(interval));
  const Vec3 way = (last.translation + rotate(last.rotation, fixed_point)) -
                   (first.translation + rotate(first.rotation, fixed_point));
  return {per_second * way,
          per_second * rotation_vector(last.rotation * conjugate(first.rotation))};
}

// As in ROS 2, whose time 0 is no time of data, an interval that would begin at 0 or before it
// begins 10 microseconds after it.
Stamp interval_start(Stamp end, Stamp interval) {
  constexpr Stamp kFirst = 10'000;
  const Stamp start = earlier(end, interval);
  return end > kFirst ? std::max(start, kFirst) : start;
}

// The end of an interval around `t`: at most the latest data, or `t` if that is later.
Stamp interval_end(Stamp t, Stamp half, Stamp latest) {
  if (t > latest) return t;
  return elapsed(t, latest) < static_cast<std::uint64_t>(half) ? latest : t + half;
}

}  // namespace

std::optional<Request> lookup_velocities(SharedBuffer& shared, const VelocityRequest& request,
                                         std::span<const Stamp> stamps, Velocity* velocities,
                                         Status* statuses) {
  BatchLookup motion(shared, request.observer, request.tracking);
  BatchLookup axes(shared, request.axes, request.observer);
  BatchLookup point(shared, request.tracking, request.point_frame);
  const Stamp reached = motion.latest();
  const Stamp latest =
      reached != kLatest ? reached : 0;  // any time is as good between static links
  std::optional<Request> fault;
  Lanes first, last, turn, body;
  for (std::size_t begin = 0; begin < stamps.size(); begin += kLanes) {
    const std::size_t n = std::min(kLanes, stamps.size() - begin);
    Stamp starts[kLanes], ends[kLanes], times[kLanes];
    Status status[4][kLanes];
    for (std::size_t i = 0; i < n; ++i) {
      times[i] = stamps[begin + i] != kLatest ? stamps[begin + i] : latest;
      ends[i] = interval_end(times[i], request.interval / 2, latest);
      starts[i] = interval_start(ends[i], request.interval);
    }
    motion.block({ends, n}, last, status[0]);
    motion.block({starts, n}, first, status[1]);
    axes.block({times, n}, turn, status[2]);
    point.block({times, n}, body, status[3]);
    const Request asked[4] = {{request.observer, request.tracking},
                              {request.observer, request.tracking},
                              {request.axes, request.observer},
                              {request.tracking, request.point_frame}};
    const Stamp* asked_times[4] = {ends, starts, times, times};
    for (std::size_t i = 0; i < n; ++i) {
      const Pose at = body.pose(i);
      const Vec3 fixed_point = at.translation + rotate(at.rotation, request.point);
      const Velocity seen =
          mean_velocity(first.pose(i), last.pose(i), fixed_point, ends[i] - starts[i]);
      const Quat to_axes = turn.pose(i).rotation;
      velocities[begin + i] = {rotate(to_axes, seen.linear), rotate(to_axes, seen.angular)};
      std::size_t step = 0;
      while (step < 3 && status[step][i] == Status::ok) ++step;
      statuses[begin + i] = status[step][i];
      if (statuses[begin + i] == Status::ok) continue;
      velocities[begin + i] = {kNoPose.translation, kNoPose.translation};
      if (!fault) {
        fault = asked[step];
        fault->t = asked_times[step][i];
      }
    }
  }
  return fault;
}

}  // namespace turtlewire
