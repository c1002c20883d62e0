// The tree of frames and the questions that tf2 answers about it. Not locked: see SharedBuffer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "failure.hpp"
#include "link.hpp"
#include "names.hpp"
#include "path.hpp"

namespace turtlewire {

inline constexpr int kMaxGraphDepth = 1000;  // tf2 takes more hops for a loop

class Buffer {
 public:
  explicit Buffer(Stamp keep);

  Stamp keep() const { return keep_; }

  // -- in
  // Adds one sample. `pose` is as received; a leading '/' of the names is dropped. `stored_pose` of a refusal's text is
  // `pose`.
  Verdict set(std::string_view parent, std::string_view child, Stamp stamp, const Pose& pose, SourceId source,
              bool is_static);
  // Forgets all samples; frames, static transforms and senders stay, as in tf2.
  void clear();
  SourceId sender(std::string_view name) { return senders_.intern(name); }

  // -- names
  const Names& frames() const { return frames_; }
  // ok, empty_name, slash_name or unknown_frame
  Status resolve(std::string_view name, FrameId& id) const;

  // -- out
  // The way from source to target, made anew when the tree has changed; stays valid until the next change of the tree.
  const Path& path(FrameId target, FrameId source);
  bool is_current(const Path& path) const { return path.version == version_; }
  // Counts the times that all paths were thrown away: pointers to paths of another epoch dangle.
  std::uint64_t path_epoch() const { return path_epoch_; }

  // target_from_source at `t`. t = 0 asks for the latest common time, and is replaced by it.
  Status lookup(const Path& path, Stamp& t, Pose& target_from_source, Failure* failure) const;
  Status can_transform(const Path& path, Stamp t, Failure* failure) const;
  Status latest_common_time(FrameId target, FrameId source, Stamp& t, Failure* failure) const;
  // The link above a frame.
  const Link& link(FrameId frame) const { return *links_[frame]; }
  // Its newest stamp; 0 if there is none.
  Stamp newest(FrameId frame) const { return links_[frame]->newest(); }

  std::string frames_as_string() const;
  std::string frames_as_yaml(double now) const;
  std::string frames_as_dot(double now) const;

 private:
  struct Climb;

  FrameId frame(std::string_view name);
  FrameId predicted(FrameId id, std::string_view name) const;
  FrameId root(FrameId frame) const;
  void build(Path& path) const;
  bool ancestors(FrameId frame, std::vector<FrameId>& line) const;
  void add_step(std::vector<Step>& arm, const Link& link) const;
  Status walk(FrameId target, FrameId source, Stamp& t, Pose* target_from_source, Failure* failure) const;
  Status fail_loop(Failure* failure) const;
  Status fail_connection(FrameId first, FrameId second, Failure* failure) const;
  Status fail_reading(const Climb& climb, FrameId target, FrameId source, Failure* failure) const;
  std::string dot_edge(FrameId child, const Link& link, double now) const;
  std::string name(FrameId id) const;
  std::string sender_of(FrameId child) const;

  Stamp keep_;
  Names frames_{"NO_PARENT"};
  Names senders_{"no recorded authority"};
  std::vector<std::unique_ptr<Link>> links_;  // by child frame; paths point to them
  Link* last_link_;                           // of the sample before this one
  std::uint64_t version_ = 1;
  std::unordered_map<std::uint64_t, std::unique_ptr<Path>> paths_;
  std::uint64_t path_epoch_ = 0;
};

}  // namespace turtlewire
