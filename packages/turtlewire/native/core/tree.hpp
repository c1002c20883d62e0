// The tree of frames and the questions that tf2 answers about it. Not locked: see SharedBuffer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "failure.hpp"
#include "link.hpp"
#include "names.hpp"
#include "path.hpp"
#include "refusals.hpp"

namespace turtlewire {

inline constexpr std::string_view kNoParent = "NO_PARENT";
inline constexpr int kMaxGraphDepth = 1000;  // tf2 treats more hops as a loop

// The kind of pose that a link returns: at a time; at a time up to `beyond` outside of its data; or
// the newest, if it is not older than `max_age` at the time.
struct Rule {
  Stamp t = kLatest;
  Stamp beyond = 0;
  bool newest = false;
  Stamp max_age = kForever;

  Reading read(const Link& link) const;
};

// How the releases of tf2 differ. A new tree follows none: its links may begin at stamp 0.
struct Rules {
  Stamp no_time = kLatest;       // a newest stamp that does not count for the latest common time
  bool keeps_rotations = false;  // as they were given, if nearly unit; else by way of a matrix
  bool tells_emptied = false;    // the text of a lookup says that a link has no data at all
  bool clears_static = false;    // clear() also forgets static poses

  static Rules of_jazzy() { return {.no_time = 0}; }
  static Rules of_kilted() {
    return {.no_time = 0, .keeps_rotations = true, .tells_emptied = true};
  }
  static Rules of_lyrical() {
    return {.no_time = 0, .keeps_rotations = true, .tells_emptied = true, .clears_static = true};
  }
};

using PoseRow = std::array<double, 7>;

class Tree {
 public:
  // With `max_frames`, samples of further frames are refused; 0: no limit.
  explicit Tree(Stamp keep, std::size_t max_frames = 0);

  Stamp keep() const { return keep_; }
  std::size_t max_frames() const { return max_frames_; }
  // Whether a frame was refused because of max_frames, since frames were last removed.
  bool is_full() const { return is_full_; }

  // To be called before data comes in.
  void use(const Rules& rules) {
    rules_ = rules;
    ++version_;
  }
  const Rules& rules() const { return rules_; }
  // A rotation as the rules store it and give it as an answer.
  Quat stored(const Quat& rotation) const {
    return rules_.keeps_rotations ? rotation : canonical(rotation);
  }

  // -- in
  // Adds one sample. `pose` is as received; a leading '/' of the names is dropped.
  Verdict set(std::string_view parent, std::string_view child, Stamp stamp, const Pose& pose,
              SourceId source, bool is_static);
  // Adds further samples of the dynamic transform that set() accepted last, up to the first that is
  // not newer than all before or that set() would refuse; returns their number. A row has a
  // translation and a rotation.
  std::size_t append(std::span<const Stamp> stamps, std::span<const PoseRow> rows);
  // What `set` would say of this sample, but for its time.
  Verdict judge(std::string_view parent, std::string_view child, const Pose& pose) const;
  // The same for a further sample of the same frames.
  Verdict judge(const Pose& pose) const {
    return judge_stored({pose.translation, stored(pose.rotation)});
  }
  // The number of rows before the first that judge() refuses.
  std::size_t count_accepted(std::span<const PoseRow> rows) const;
  // Counts a transform that is not added.
  Verdict refuse(Verdict verdict, std::string_view parent, std::string_view child, Stamp stamp,
                 const Pose& pose, SourceId source);
  // Forgets all samples; frames and senders stay, and static transforms by most rules.
  void clear();
  // Forgets the links of these frames with their history and static poses, and names that are then
  // unused. Takes time in proportion to the number of all frames. Returns the names of
  // the frames that had a link.
  std::vector<std::string> remove(std::span<const FrameId> children);
  SourceId sender(std::string_view name);
  std::string_view sender_name(SourceId id) const { return senders_[id]; }
  // For a sender whose name becomes known only after its first data.
  void rename_sender(std::string_view name, std::string_view shown) {
    senders_.rename(name, shown);
  }
  const Refusals& refusals() const { return refusals_; }
  // Counts a message that could not be decoded.
  void refuse_message(std::string_view fault, SourceId source) {
    refusals_.add_malformed(fault, source);
  }

  // -- names
  const Names& frames() const { return frames_; }
  // All frames that were ever received and not removed, in order of arrival.
  const std::vector<FrameId>& known_frames() const { return known_frames_; }
  bool is_known(FrameId frame) const { return is_known_[frame]; }
  // The link above a frame, by its name in a transform; null if there never was one.
  const Link* find_link(std::string_view child) const;
  // ok, empty_name, slash_name or unknown_frame
  Status resolve(std::string_view name, FrameId& id) const;

  // -- out
  // The path from source to target, rebuilt when the tree has changed; stays valid until the next
  // change of the tree.
  const Path& path(FrameId target, FrameId source);
  bool is_current(const Path& path) const { return path.version == version_; }
  // The same path, if it is known and current; else null.
  const Path* known_path(FrameId target, FrameId source) const;
  // Counts the times that all paths were thrown away, and names freed: pointers to paths and
  // numbers of frames of another epoch mean nothing.
  std::uint64_t path_epoch() const { return path_epoch_; }

  // target_from_source at `t`. kLatest asks for the latest common time, and is replaced by it.
  Status lookup(const Path& path, Stamp& t, Pose& target_from_source, Failure* failure) const;
  Status can_transform(const Path& path, Stamp t, Failure* failure) const;
  Status latest_common_time(FrameId target, FrameId source, Stamp& t, Failure* failure) const;
  // target_from_source by other rules than tf2's for what a link answers. `used` receives the links
  // on the way.
  Status lookup(FrameId target, FrameId source, const Rule& rule, Pose& target_from_source,
                std::vector<FrameId>* used, Failure* failure) const;
  // The link above a frame.
  const Link& link(FrameId frame) const { return *links_[frame]; }

  // What is wrong with the buffer's own state; empty if nothing is.
  std::string fault() const;

  std::string frames_as_string() const;
  std::string frames_as_yaml(double now) const;
  std::string frames_as_dot(double now) const;

 private:
  struct Climb;

  Verdict judge_stored(const Pose& pose) const;
  FrameId frame(std::string_view name);
  bool has_room(std::string_view parent, std::string_view child) const;
  FrameId predicted(FrameId id, std::string_view name) const;
  void forget(std::vector<FrameId> frames);
  void drop_paths();
  FrameId root(FrameId frame) const;
  void build(Path& path) const;
  bool ancestors(FrameId frame, std::vector<FrameId>& line) const;
  void add_step(std::vector<Step>& arm, const Link& link) const;
  Status walk(FrameId target, FrameId source, Stamp& t, Pose* target_from_source,
              Failure* failure) const;
  Status climb(FrameId target, FrameId source, const Rule& rule, Pose* target_from_source,
               std::vector<FrameId>* used, Failure* failure) const;
  void add_time(const Link& link, Stamp& earliest) const;
  static const Climb& later_failure(const Climb& up, const Climb& down);
  Status fail_loop(Failure* failure) const;
  Status fail_connection(FrameId first, FrameId second, Failure* failure) const;
  Status fail_reading(const Climb& climb, FrameId target, FrameId source, Failure* failure) const;
  std::string dot_edge(FrameId child, const Link& link, double now) const;
  std::string name(FrameId id) const;
  std::string sender_of(FrameId child) const;

  Stamp keep_;
  std::size_t max_frames_;
  bool is_full_ = false;
  Rules rules_;
  Names frames_{kNoParent};
  Names senders_{"no recorded authority"};
  std::string last_sender_name_ = "no recorded authority";  // saves hashing it
  SourceId last_sender_ = 0;
  Arena arena_;                               // of the links' samples
  std::vector<std::unique_ptr<Link>> links_;  // by child frame; paths point to them
  Link* last_link_;                           // of the sample before this one
  std::vector<bool> is_known_{true};          // by frame; NO_PARENT counts as known
  std::vector<FrameId> known_frames_;
  Refusals refusals_;
  std::uint64_t version_ = 1;
  std::unordered_map<std::uint64_t, std::unique_ptr<Path>> paths_;
  std::uint64_t path_epoch_ = 0;
};

}  // namespace turtlewire
