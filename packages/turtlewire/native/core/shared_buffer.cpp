#include "shared_buffer.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace turtlewire {

Pose ReceivedTransform::pose() const {
  unsigned char bytes[7 * sizeof(double)];
  std::memcpy(bytes, numbers, sizeof bytes);
  if (swapped) {
    for (unsigned char* number = bytes; number != bytes + sizeof bytes; number += sizeof(double))
      std::reverse(number, number + sizeof(double));
  }
  double v[7];
  std::memcpy(v, bytes, sizeof v);
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
}

Added SharedBuffer::add(std::span<const ReceivedTransform> transforms, std::string_view authority,
                        bool is_static) {
  const std::scoped_lock lock(mutex_);
  const SourceId sender = tree_.sender(authority);
  const std::size_t refused_before = tree_.refusals().kinds();
  Added added;
  added.listened_to = listeners_ > 0;
  for (const ReceivedTransform& r : transforms) {
    const Verdict verdict = tree_.set(r.parent, r.child, r.stamp, r.pose(), sender, is_static);
    added.accepted += verdict == Verdict::accepted;
    added.lacks_room = added.lacks_room || verdict == Verdict::too_many_frames;
  }
  added.new_refusal = tree_.refusals().kinds() != refused_before;
  if (added.accepted > 0) wake_waiters();
  return added;
}

Status SharedBuffer::resolve(std::string_view name, Argument argument, FrameId& id,
                             Failure& failure) const {
  const Status status = tree_.resolve(name, id);
  if (status != Status::ok) {
    failure.status = status;
    failure.argument = argument;
    failure.name = name;
  }
  return status;
}

// Whether there was an answer along a path that was known, so that the lock could be shared.
bool SharedBuffer::find_known(const Request& request, Found& found) {
  const View tree(*this);
  FrameId target = 0, source = 0;
  if (tree->resolve(request.target, target) != Status::ok ||
      tree->resolve(request.source, source) != Status::ok)
    return false;
  const Path* path = tree->known_path(target, source);
  found = {request.t, {}};
  return path != nullptr &&
         tree->lookup(*path, found.stamp, found.target_from_source, nullptr) == Status::ok;
}

// One step, the lock held. A frame in itself is the identity, whether it exists or not.
Status SharedBuffer::find(const Request& request, Found& found, Failure& failure) {
  FrameId target = 0, source = 0;
  found = {request.t, {}};
  if (request.target == request.source) {
    if (request.t == kLatest && tree_.resolve(request.source, source) == Status::ok)
      found.stamp = tree_.link(source).reached();
    return Status::ok;
  }
  Status status = resolve(request.target, Argument::target, target, failure);
  if (status == Status::ok) status = resolve(request.source, Argument::source, source, failure);
  if (status != Status::ok) return status;
  failure.latest = request.t == kLatest;
  return find(target, source, request.beyond, found, failure);
}

Status SharedBuffer::find(FrameId target, FrameId source, Stamp beyond, Found& found,
                          Failure& failure) {
  const Status status =
      tree_.lookup(tree_.path(target, source), found.stamp, found.target_from_source, &failure);
  // Without a latest common time, there is no time to extrapolate to.
  if (status == Status::ok || beyond == 0 || found.stamp == kLatest) return status;
  const bool latest = failure.latest;
  failure = {};
  failure.latest = latest;
  const Rule rule{.t = found.stamp, .beyond = beyond};
  return tree_.lookup(target, source, rule, found.target_from_source, nullptr, &failure);
}

Status SharedBuffer::test(const Request& request, Failure& failure) {
  FrameId target = 0, source = 0;
  if (request.target == request.source) return Status::ok;
  Status status = resolve(request.target, Argument::target, target, failure);
  if (status == Status::ok) status = resolve(request.source, Argument::source, source, failure);
  if (status != Status::ok) return status;
  failure.latest = request.t == kLatest;
  if (request.beyond != 0) {
    Found found{request.t, {}};
    return find(target, source, request.beyond, found, failure);
  }
  return tree_.can_transform(tree_.path(target, source), request.t, &failure);
}

Status SharedBuffer::lookup(const Request& request, Found& found, Failure& failure) {
  if constexpr (kReaderLocks > 1) {
    if (find_known(request, found)) return Status::ok;
  }
  const std::scoped_lock lock(mutex_);
  return find(request, found, failure);
}

Status SharedBuffer::lookup(const FullRequest& r, Found& found, Failure& failure) {
  const std::scoped_lock lock(mutex_);
  FrameId id = 0;
  Status status = resolve(r.target, Argument::target, id, failure);
  if (status == Status::ok) status = resolve(r.source, Argument::source, id, failure);
  if (status == Status::ok) status = resolve(r.fixed, Argument::fixed, id, failure);
  if (status != Status::ok) return status;
  Found fixed_from_source;
  status = find({r.fixed, r.source, r.source_time, r.beyond}, fixed_from_source, failure);
  if (status == Status::ok)
    status = find({r.target, r.fixed, r.target_time, r.beyond}, found, failure);
  if (status != Status::ok) return status;
  // In every release by way of matrices, which normalise.
  if (tree_.rules().keeps_rotations)
    found.target_from_source.rotation = canonical(found.target_from_source.rotation);
  const Pose pose = found.target_from_source * fixed_from_source.target_from_source;
  found.target_from_source = {pose.translation, canonical(pose.rotation)};
  return Status::ok;
}

Status SharedBuffer::can_transform(const Request& request, Failure& failure) {
  const std::scoped_lock lock(mutex_);
  return test(request, failure);
}

Status SharedBuffer::can_transform(const FullRequest& r, Failure& failure) {
  const std::scoped_lock lock(mutex_);
  FrameId id = 0;
  Status status = resolve(r.target, Argument::target, id, failure);
  if (status == Status::ok) status = resolve(r.source, Argument::source, id, failure);
  if (status == Status::ok) status = resolve(r.fixed, Argument::fixed, id, failure);
  if (status != Status::ok) return status;
  status = test({r.target, r.fixed, r.target_time, r.beyond}, failure);
  // tf2 continues past a cleared static link, and then reports the failure of the other half.
  if (status != Status::ok && status != Status::no_static_data) return status;
  Failure other;
  const Status last = test({r.fixed, r.source, r.source_time, r.beyond}, other);
  if (last == Status::ok) return status;
  failure = std::move(other);
  return last;
}

Status SharedBuffer::latest_common_time(std::string_view target, std::string_view source, Stamp& t,
                                        Failure& failure) {
  const std::scoped_lock lock(mutex_);
  FrameId target_id = 0, source_id = 0;
  Status status = resolve(target, Argument::target, target_id, failure);
  if (status == Status::ok) status = resolve(source, Argument::source, source_id, failure);
  if (status == Status::ok) status = tree_.latest_common_time(target_id, source_id, t, &failure);
  return status;
}

bool SharedBuffer::worth_waiting(const Failure& failure) const {
  switch (failure.status) {
    case Status::empty_name:
    case Status::slash_name:
      return false;
    case Status::no_data:
    case Status::past:
      return failure.latest || failure.emptied ||
             failure.requested >= earlier(failure.newest, tree_.keep());
    default:
      return true;
  }
}

}  // namespace turtlewire
