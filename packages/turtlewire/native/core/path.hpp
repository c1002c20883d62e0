// The path between two frames, prepared once for each shape of the tree.
#pragma once

#include <cstdint>
#include <vector>

#include "link.hpp"

namespace turtlewire {

// A dynamic link, or (link == nullptr) a run of static links multiplied out.
struct Step {
  const Link* link = nullptr;
  Pose fixed;
};

// From the source up to the nearest common ancestor, and from the target up to it.
struct Path {
  FrameId target = 0, source = 0;
  std::uint64_t version = 0;  // of the tree it was made for; 0: never made
  // Whether the steps give the answer. If not (frames unconnected, a loop, links with changing
  // parents, emptied links or infinite values on the way to the root), each lookup walks the tree
  // as tf2 does.
  bool direct = false;
  Stamp no_time = kLatest;  // as in the tree
  std::vector<Step> up, down;
};

// The newest time that every dynamic link of the path has reached; kLatest if all are static.
inline Stamp latest_common_time(const Path& path) {
  Stamp latest = kLatest;
  for (const auto* arm : {&path.up, &path.down}) {
    for (const Step& step : *arm) {
      if (step.link == nullptr) continue;
      const Stamp newest = step.link->newest();
      if (newest != path.no_time && (latest == kLatest || newest < latest)) latest = newest;
    }
  }
  return latest;
}

// The pose of one step, where it is stored or in `room`; null when its link has no data at `t`.
inline const Pose* pose_at(const Step& step, Stamp t, Pose& room) {
  return step.link != nullptr ? step.link->pose_at(t, room) : &step.fixed;
}

// The pose of one step if it is stored; null if its link may have to interpolate.
inline const Pose* stored_at(const Step& step, Stamp t) {
  if (step.link == nullptr) return &step.fixed;
  const Samples& samples = step.link->samples();
  return !samples.empty() && samples.newest() == t ? &samples.back().pose : nullptr;
}

// top_from_start of one arm; false when a link has no data at `t`. The product of the first steps
// whose poses are stored, often of all, stays in registers. A pose just computed is not copied:
// copies are made in larger pieces than it was written in, for which processors wait.
inline bool follow(const std::vector<Step>& arm, Stamp t, Pose& result) {
  if (arm.empty()) return true;
  std::size_t i = 1;
  if (const Pose* pose = stored_at(arm.front(), t); pose != nullptr) {
    Pose top = *pose;
    for (; i < arm.size() && (pose = stored_at(arm[i], t)) != nullptr; ++i) top = *pose * top;
    result = top;
  } else {
    pose = pose_at(arm.front(), t, result);
    if (pose == nullptr) return false;
    if (pose != &result) result = *pose;
  }
  Pose room;
  for (; i < arm.size(); ++i) {
    const Pose* pose = pose_at(arm[i], t, room);
    if (pose == nullptr) return false;
    result = *pose * result;
  }
  return true;
}

// target_from_source; false when a link has no data at `t`.
inline bool follow(const Path& path, Stamp t, Pose& target_from_source) {
  if (path.up.empty()) target_from_source = {};
  if (!follow(path.up, t, target_from_source)) return false;
  if (path.down.empty()) return true;
  Pose down;
  if (!follow(path.down, t, down)) return false;
  target_from_source = between(down, target_from_source);
  return true;
}

inline bool covers(const Path& path, Stamp t) {
  for (const auto* arm : {&path.up, &path.down}) {
    for (const Step& step : *arm) {
      if (step.link != nullptr && !step.link->covers(t)) return false;
    }
  }
  return true;
}

}  // namespace turtlewire
