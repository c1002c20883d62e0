// Many lookups at once: the locks, searches and arithmetic of 64 at a time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernels.hpp"
#include "shared_buffer.hpp"

namespace turtlewire {

// target_from_source at many times. The buffer is locked only for each block, so other threads get
// the lock in between; the answers of a block belong to one state of the buffer. Without an answer,
// the pose is NaN, and the status is the reason.
class BatchLookup {
 public:
  // `beyond`: as in Request.
  BatchLookup(SharedBuffer& shared, std::string_view target, std::string_view source,
              Stamp beyond = 0);

  // At most kLanes stamps; kLatest asks for the latest common time.
  void block(std::span<const Stamp> stamps, Lanes& poses, Status* statuses);
  // The latest common time; kLatest also if there is none.
  Stamp latest();

 private:
  // The places of a dynamic link's last hits: for stamps that come in order.
  using Hints = std::vector<std::size_t>;

  bool resolve(const Tree& tree);  // false if a name is unknown
  bool known_block(std::span<const Stamp> stamps, Lanes& poses, Status* statuses);
  void answer(const Tree& tree, const Path& path, std::span<const Stamp> stamps, Lanes& poses,
              Status* statuses);
  Status find(const Tree& tree, const Path& path, Stamp t, Pose& pose) const;
  void scalar_block(const Tree& tree, const Path& path, std::span<const Stamp> stamps, Lanes& poses,
                    Status* statuses);
  void direct_block(const Tree& tree, const Path& path, std::span<const Stamp> stamps, Lanes& poses,
                    Status* statuses);
  void arm(const std::vector<Step>& steps, const Stamp* stamps, Hints& hints, bool* missing,
           Lanes& result);
  void read_link(const Link& link, const Stamp* stamps, std::size_t& hint, bool* missing,
                 Lanes& result);

  SharedBuffer& shared_;
  std::string target_, source_;
  Stamp beyond_;
  FrameId target_id_ = 0, source_id_ = 0;
  Status unresolved_ = Status::ok;
  std::uint64_t epoch_ = 0, version_ = 0;
  Hints up_hints_, down_hints_;
};

// The poses of all frames that have one, in `target` at one time; kLatest takes the latest common
// time of each.
struct FramePose {
  std::string frame;
  Stamp stamp;
  Pose target_from_frame;
};
Status lookup_all(SharedBuffer& shared, std::string_view target, Stamp t,
                  std::vector<FramePose>& found, Failure& failure);

// A request for the velocity of a frame relative to an observer.
struct VelocityRequest {
  std::string_view tracking, observer;  // the frame that moves; the frame that counts as fixed
  std::string_view axes;                // the frame in whose axes the answer is given
  std::string_view point_frame;  // the point moves with `tracking`; it is given in this frame
  Vec3 point;
  Stamp interval;  // the time over which the mean is taken, around the stamp, or before the latest
                   // data
};
struct Velocity {
  Vec3 linear, angular;
};
// The first lookup that has no answer, if any; its names are those of the request.
std::optional<Request> lookup_velocities(SharedBuffer& shared, const VelocityRequest& request,
                                         std::span<const Stamp> stamps, Velocity* velocities,
                                         Status* statuses);

}  // namespace turtlewire
