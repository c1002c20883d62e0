// A link of the tree: the pose of a child frame in its parent, over time (dynamic) or static.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "interpolate.hpp"
#include "samples.hpp"

namespace turtlewire {

enum class LinkKind : std::uint8_t {
  none,
  dynamic_link,
  static_link
};  // none: nothing was ever sent; a root

enum class ReadStatus : std::uint8_t { ok, no_data, future, past };

enum class InsertStatus : std::uint8_t { added, duplicate, too_old };

// A sender of a link's samples, and the parent that it names.
struct Sender {
  SourceId id = 0;
  FrameId parent = 0;
  std::uint64_t samples = 0;
  Stamp newest = 0;
};

struct Reading {
  ReadStatus status = ReadStatus::no_data;
  FrameId parent = 0;
  Pose pose{};
};

class Link {
 public:
  explicit Link(Arena& arena) : samples_(arena) {}

  static constexpr std::size_t kMostSenders =
      16;  // beyond it the one that has been silent longest is forgotten

  FrameId follower = 0;  // the child that came after this one last time: saves hashing its name

  // Beyond this many values of one stamp only the first, the last and the count are kept: memory
  // stays bounded.
  static constexpr std::size_t kMostPerStamp = 1000;

  LinkKind kind() const { return kind_; }
  bool is_static() const { return kind_ == LinkKind::static_link; }
  bool has_data() const { return parent_ != 0; }
  // The parent of the newest sample; 0 without data.
  FrameId parent() const { return parent_; }
  // The same, but of a static link that was cleared its last one: the search for the latest common
  // time of Lyrical's tf2 still goes that way.
  FrameId last_parent() const { return parent_ != 0 ? parent_ : cleared_parent_; }
  // Samples of different parents are in the history, so the tree depends on the time asked for.
  bool reparented() const { return parent_changes_ > 0; }
  // An infinite translation was accepted (tf2 does): it spoils every walk through this link.
  bool has_infinity() const { return has_infinity_; }
  // A rotation was stored that is not unit, as tf2 does since Kilted: poses on the way scale.
  bool has_scaling() const { return has_scaling_; }
  void note_scaling() { has_scaling_ = true; }
  void note_infinity(const Vec3& translation) {
    has_infinity_ = has_infinity_ || !is_finite(translation);
  }
  const Pose& static_pose() const { return static_pose_; }
  const Samples& samples() const { return samples_; }

  // The number of values that tf2 would hold, those of a flooded stamp included.
  std::size_t length() const {
    std::size_t n = is_static() ? 1 : samples_.size();
    for (const Flood& flood : floods_) n += flood.dropped;
    return n;
  }
  // Of a history; 0 without one.
  Stamp oldest() const { return samples_.oldest(); }
  Stamp newest() const { return samples_.newest(); }

  // The newest time of a dynamic link; kLatest for a static one.
  Stamp reached() const { return samples_.empty() ? kLatest : samples_.newest(); }

  // What is wrong with the link's own state; empty if nothing is.
  std::string fault() const;

  // Calls `visit` with each parent in the data; once at least.
  template <typename Visit>
  void for_parents(Visit visit) const {
    if (last_parent() != 0) visit(last_parent());
    for (std::size_t i = 0; parent_changes_ > 0 && i < samples_.size(); ++i)
      visit(samples_[i].parent);
  }

  // Everything that a path between two frames depends on, except the samples: equal shapes have
  // equal paths.
  std::uint64_t shape() const {
    const auto flags = static_cast<std::uint64_t>(kind_) |
                       static_cast<std::uint64_t>(has_data()) << 2 |
                       static_cast<std::uint64_t>(reparented()) << 3 |
                       static_cast<std::uint64_t>(has_infinity_) << 4 |
                       static_cast<std::uint64_t>(has_scaling_) << 5;
    return flags << 32 | parent_;
  }

  // Turns the link into the other kind, which loses its history, as in tf2.
  void become(LinkKind kind) {
    if (kind == kind_) return;
    clear_samples();
    kind_ = kind;
    has_infinity_ = has_scaling_ = false;
  }

  void set_static(FrameId parent, const Pose& pose) {
    parent_ = parent;
    static_pose_ = pose;
    has_infinity_ = !is_finite(pose.translation);
    has_scaling_ = false;
  }

  // tf2's order of steps: drop samples that are too old by the newest stamp so far, refuse older
  // ones than that, and insert a sample with a repeated stamp after the earlier ones.
  InsertStatus insert(Stamp stamp, const Sample& sample, Stamp keep) {
    if (samples_.empty()) {
      append(stamp, sample);
      return InsertStatus::added;
    }
    if (append_newer(stamp, sample, keep)) [[likely]]
      return InsertStatus::added;
    if (stamp < earlier(samples_.newest(), keep)) return InsertStatus::too_old;
    return insert_late(stamp, sample);
  }

  // Inserts a sample that is newer than all others; false if it is not, and then only the samples
  // that are too old are gone. Needs a sample.
  bool append_newer(Stamp stamp, const Sample& sample, Stamp keep) {
    prune(earlier(samples_.newest(), keep));
    if (stamp <= samples_.newest()) return false;
    append(stamp, sample);
    return true;
  }

  // Inserts further samples, up to the first that is not newer than all before, but no more than
  // fit into one block; returns their number. `write` gets the memory for their poses, and returns
  // how many it has written, one at least. Needs a sample.
  template <typename Write>
  std::size_t append_newer(std::span<const Stamp> stamps, FrameId parent, Stamp keep, Write write) {
    Stamp newest = samples_.newest();
    prune(earlier(newest, keep));
    if (stamps.empty() || stamps.front() <= newest) return 0;
    const Samples::Room room = samples_.room();
    std::size_t count = 0;
    for (; count < std::min(room.size, stamps.size()) && stamps[count] > newest; ++count)
      room.stamps[count] = newest = stamps[count];
    count = write(std::span(room.samples, count));
    parent_changes_ += samples_.back().parent != parent;
    samples_.add_written(count);
    parent_ = parent;
    if (count > 1) prune(earlier(stamps[count - 2], keep));
    return count;
  }

  // Counts an accepted sample for its sender.
  void count_sender(SourceId id, FrameId parent, Stamp stamp) {
    if (sender_.id != id || sender_.parent != parent || sender_.samples == 0) [[unlikely]]
      change_sender(id, parent);
    ++sender_.samples;
    sender_.newest = stamp;
  }
  // The same for more samples of the last sender.
  void count_more(std::size_t samples, Stamp newest) {
    sender_.samples += samples;
    sender_.newest = newest;
  }
  // Of the last accepted sample.
  SourceId sender() const { return sender_.id; }
  FrameId parent_of_sender() const { return sender_.parent; }
  std::vector<Sender> senders() const {
    std::vector<Sender> all = former_senders_;
    if (sender_.samples > 0) all.push_back(sender_);
    return all;
  }
  // How often the parent changes in the history kept.
  std::size_t parent_changes() const { return parent_changes_; }

  // Forgets everything but the follower.
  void reset() {
    clear_samples();
    kind_ = LinkKind::none;
    has_infinity_ = has_scaling_ = false;
    static_pose_ = {};
    sender_ = {};
    former_senders_ = {};
  }

  // Clears the history, and the static pose unless it is kept.
  void clear(bool static_stays) {
    if (is_static() && static_stays) return;
    const FrameId parent = last_parent();
    clear_samples();
    if (is_static()) cleared_parent_ = parent;
    has_infinity_ = has_scaling_ = false;
  }

  // The pose at `t`; kLatest means the newest.
  Reading read(Stamp t) const {
    if (!has_data()) return {};
    if (is_static()) return {ReadStatus::ok, parent_, static_pose_};
    if (t == kLatest) return sample_reading(samples_.back());
    if (samples_.size() == 1)
      return samples_.newest() == t ? sample_reading(samples_.back()) : Reading{};
    if (t >= samples_.newest())
      return t == samples_.newest() ? sample_reading(samples_.back()) : Reading{ReadStatus::future};
    if (t <= samples_.oldest())
      return t == samples_.oldest() ? sample_reading(samples_.front()) : Reading{ReadStatus::past};
    const Samples::Pair pair = samples_.around(t);
    if (pair.older->parent != pair.newer->parent) return sample_reading(*pair.older);
    return {ReadStatus::ok, pair.older->parent, interpolated(pair, t)};
  }

  // As read, but up to `limit` before the oldest and after the newest sample: extrapolates the
  // motion between the two outermost samples.
  Reading read_beyond(Stamp t, Stamp limit) const {
    const Reading reading = read(t);
    if (reading.status != ReadStatus::future && reading.status != ReadStatus::past) return reading;
    const bool after = reading.status == ReadStatus::future;
    const std::size_t i = after ? samples_.size() - 2 : 0;
    const Stamp gap = after ? t - samples_.newest() : samples_.oldest() - t;
    const Samples::Pair pair = samples_.pair(i);
    if (gap > limit || pair.older->parent != pair.newer->parent ||
        pair.older_stamp == pair.newer_stamp)
      return reading;
    return {ReadStatus::ok, pair.older->parent, interpolated(pair, t)};
  }

  // Whether a dynamic link of one parent has a pose at `t`, without computing it.
  bool covers(Stamp t) const {
    if (samples_.size() < 2) return !samples_.empty() && (t == kLatest || t == samples_.newest());
    return t == kLatest || (t <= samples_.newest() && t >= samples_.oldest());
  }

  // The pose of a dynamic link of one parent, where it is stored or in `room`; null when it has
  // none at `t`.
  const Pose* pose_at(Stamp t, Pose& room) const {
    if (samples_.empty()) return nullptr;
    if (t == samples_.newest() || t == kLatest) return &samples_.back().pose;
    if (t == samples_.oldest()) return &samples_.front().pose;
    if (t > samples_.newest() || t < samples_.oldest()) return nullptr;
    room = interpolated(samples_.around(t), t);
    return &room;
  }

 private:
  struct Flood {
    Stamp stamp;
    std::size_t dropped;
  };

  static Reading sample_reading(const Sample& sample) {
    return {ReadStatus::ok, sample.parent, sample.pose};
  }

  Pose interpolated(const Samples::Pair& pair, Stamp t) const {
    const Pose &older = pair.older->pose, &newer = pair.newer->pose;
    return has_scaling_ ? interpolate_scaling(older, newer, pair.ratio(t))
                        : interpolate(older, newer, pair.ratio(t));
  }

  void append(Stamp stamp, const Sample& sample) {
    if (!samples_.empty() && samples_.back().parent != sample.parent) ++parent_changes_;
    samples_.push_back(stamp, sample);
    note(sample);
  }

  InsertStatus insert_late(Stamp stamp, const Sample& sample) {
    std::size_t end = samples_.size();
    if (stamp < samples_.newest())
      end = stamp < samples_.oldest() ? 0 : samples_.last_at_or_before(stamp) + 1;
    std::size_t begin = end;
    while (begin > 0 && samples_.stamp(begin - 1) == stamp) {
      --begin;
      if (samples_[begin].parent == sample.parent && samples_[begin].pose == sample.pose)
        return InsertStatus::duplicate;
    }
    if (end - begin >= kMostPerStamp) {
      replace_last_of_flood(end - 1, stamp, sample);
    } else {
      samples_.insert(end, stamp, sample);
    }
    if (parent_changes_ > 0 || sample.parent != parent_) count_parent_changes();
    note(sample);
    return InsertStatus::added;
  }

  void replace_last_of_flood(std::size_t i, Stamp stamp, const Sample& sample) {
    samples_[i] = sample;
    const auto known = std::find_if(floods_.begin(), floods_.end(),
                                    [&](const Flood& f) { return f.stamp == stamp; });
    if (known != floods_.end()) {
      ++known->dropped;
    } else {
      floods_.push_back({stamp, 1});
    }
  }

  void change_sender(SourceId id, FrameId parent) {
    if (sender_.samples > 0) former_senders_.push_back(sender_);
    const auto known =
        std::find_if(former_senders_.begin(), former_senders_.end(),
                     [&](const Sender& s) { return s.id == id && s.parent == parent; });
    sender_ = known != former_senders_.end() ? *known : Sender{id, parent};
    if (known != former_senders_.end()) former_senders_.erase(known);
    if (former_senders_.size() < kMostSenders) return;
    former_senders_.erase(
        std::min_element(former_senders_.begin(), former_senders_.end(),
                         [](const Sender& a, const Sender& b) { return a.newest < b.newest; }));
  }

  void note(const Sample& sample) {
    parent_ = samples_.back().parent;
    note_infinity(sample.pose.translation);
  }

  void prune(Stamp limit) {
    if (samples_.oldest() >= limit) return;
    while (samples_.oldest() < limit) {
      if (parent_changes_ > 0 && samples_[0].parent != samples_[1].parent) --parent_changes_;
      samples_.pop_front();
    }
    std::erase_if(floods_, [&](const Flood& flood) { return flood.stamp < limit; });
  }

  void count_parent_changes() {
    parent_changes_ = 0;
    for (std::size_t i = 1; i < samples_.size(); ++i)
      parent_changes_ += samples_[i].parent != samples_[i - 1].parent;
  }

  void clear_samples() {
    samples_.clear();
    floods_.clear();
    parent_changes_ = 0;
    parent_ = cleared_parent_ = 0;
  }

  LinkKind kind_ = LinkKind::none;
  bool has_infinity_ = false;
  bool has_scaling_ = false;
  FrameId parent_ = 0;
  FrameId cleared_parent_ = 0;
  Sender sender_;
  std::size_t parent_changes_ = 0;
  Samples samples_;
  Pose static_pose_;
  std::vector<Flood> floods_;
  std::vector<Sender> former_senders_;
};

}  // namespace turtlewire
