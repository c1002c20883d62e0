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
  bool reparented() const { return samples_.parent_changes() > 0; }
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
    for (std::size_t i = 0; reparented() && i < samples_.size(); ++i) visit(samples_.parent(i));
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
  InsertStatus insert(const Sample& sample, FrameId parent, Stamp keep) {
    if (samples_.empty()) {
      append(sample, parent);
      return InsertStatus::added;
    }
    if (append_newer(sample, parent, keep)) [[likely]]
      return InsertStatus::added;
    if (sample.stamp < earlier(samples_.newest(), keep)) return InsertStatus::too_old;
    return insert_late(sample, parent);
  }

  // Inserts a sample that is newer than all others; false if it is not, and then only the samples
  // that are too old are gone. Needs a sample.
  bool append_newer(const Sample& sample, FrameId parent, Stamp keep) {
    prune(earlier(samples_.newest(), keep));
    if (sample.stamp <= samples_.newest()) return false;
    append(sample, parent);
    return true;
  }

  // Inserts further samples, up to the first that is not newer than all before, but no more than
  // fit into one block; returns their number. `write` gets the memory for them, and returns how
  // many it has written, one at least. Needs a sample.
  template <typename Write>
  std::size_t append_newer(std::span<const Stamp> stamps, FrameId parent, Stamp keep, Write write) {
    Stamp newest = samples_.newest();
    prune(earlier(newest, keep));
    if (stamps.empty() || stamps.front() <= newest) return 0;
    const std::span<Sample> room = samples_.room();
    std::size_t count = 0;
    for (; count < std::min(room.size(), stamps.size()) && stamps[count] > newest; ++count)
      newest = stamps[count];
    count = write(room.first(count));
    samples_.add_written(count, parent);
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
    const std::size_t last = samples_.size() - 1;
    if (t == kLatest || t == samples_.newest()) return stored(last);
    if (last == 0) return {};
    if (t > samples_.newest()) return {ReadStatus::future};
    if (t <= samples_.oldest())
      return t == samples_.oldest() ? stored(0) : Reading{ReadStatus::past};
    const std::size_t i = samples_.last_at_or_before(t);
    return samples_.parent(i) == samples_.parent(i + 1) ? between(i, t) : stored(i);
  }

  // As read, but up to `limit` before the oldest and after the newest sample: extrapolates the
  // motion between the two outermost samples.
  Reading read_beyond(Stamp t, Stamp limit) const {
    const Reading reading = read(t);
    if (reading.status != ReadStatus::future && reading.status != ReadStatus::past) return reading;
    const bool after = reading.status == ReadStatus::future;
    const std::size_t i = after ? samples_.size() - 2 : 0;
    const bool is_far =
        after ? samples_.newest() < earlier(t, limit) : t < earlier(samples_.oldest(), limit);
    if (is_far || samples_.parent(i) != samples_.parent(i + 1) ||
        samples_.stamp(i) == samples_.stamp(i + 1))
      return reading;
    return between<exact_weights>(i, t);
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

  // The pose of one sample.
  Reading stored(std::size_t i) const {
    return {ReadStatus::ok, samples_.parent(i), samples_[i].pose};
  }
  // The pose at `t` by the motion between a sample and the next.
  template <auto Arc = arc_weights>
  Reading between(std::size_t i, Stamp t) const {
    return {ReadStatus::ok, samples_.parent(i), interpolated<Arc>(samples_.pair(i), t)};
  }

  template <auto Arc = arc_weights>
  Pose interpolated(const Samples::Pair& pair, Stamp t) const {
    const Pose &older = pair.older->pose, &newer = pair.newer->pose;
    return has_scaling_ ? interpolate_scaling<Arc>(older, newer, pair.ratio(t))
                        : interpolate<Arc>(older, newer, pair.ratio(t));
  }

  void append(const Sample& sample, FrameId parent) {
    samples_.push_back(sample, parent);
    parent_ = parent;
    note_infinity(sample.pose.translation);
  }

  InsertStatus insert_late(const Sample& sample, FrameId parent) {
    const Stamp stamp = sample.stamp;
    std::size_t end = samples_.size();
    if (stamp < samples_.newest())
      end = stamp < samples_.oldest() ? 0 : samples_.last_at_or_before(stamp) + 1;
    std::size_t begin = end;
    while (begin > 0 && samples_.stamp(begin - 1) == stamp) {
      --begin;
      if (samples_.parent(begin) == parent && samples_[begin].pose == sample.pose)
        return InsertStatus::duplicate;
    }
    if (end - begin >= kMostPerStamp) {
      samples_.replace(end - 1, sample, parent);
      count_dropped(stamp);
    } else {
      samples_.insert(end, sample, parent);
    }
    parent_ = samples_.parent(samples_.size() - 1);
    note_infinity(sample.pose.translation);
    return InsertStatus::added;
  }

  void count_dropped(Stamp stamp) {
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

  void prune(Stamp limit) {
    if (samples_.oldest() >= limit) return;
    while (samples_.oldest() < limit) samples_.pop_front();
    std::erase_if(floods_, [&](const Flood& flood) { return flood.stamp < limit; });
  }

  void clear_samples() {
    samples_.clear();
    floods_.clear();
    parent_ = cleared_parent_ = 0;
  }

  LinkKind kind_ = LinkKind::none;
  bool has_infinity_ = false;
  bool has_scaling_ = false;
  FrameId parent_ = 0;
  FrameId cleared_parent_ = 0;
  Sender sender_;
  Samples samples_;
  Pose static_pose_;
  std::vector<Flood> floods_;
  std::vector<Sender> former_senders_;
};

}  // namespace turtlewire
