// The history of one link: samples in order of time.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "arena.hpp"
#include "parents.hpp"
#include "pose.hpp"

namespace turtlewire {

using Stamp = std::int64_t;      // nanoseconds
using SourceId = std::uint32_t;  // who sent it

inline constexpr Stamp kForever = std::numeric_limits<Stamp>::max();
// In a question: the latest common time. In an answer: no time, as only static links were used. It
// is the value of NumPy's NaT, which is no time of data.
inline constexpr Stamp kLatest = std::numeric_limits<Stamp>::min();

// The time a span before another; the first of all times if there is none.
inline Stamp earlier(Stamp t, Stamp span) {
  constexpr Stamp first = std::numeric_limits<Stamp>::min();
  return t < first + span ? first : t - span;
}

// The nanoseconds from one stamp to another that is not before it: a Stamp may not hold them.
inline std::uint64_t elapsed(Stamp begin, Stamp end) {
  return static_cast<std::uint64_t>(end) - static_cast<std::uint64_t>(begin);
}

// As tf2 turns times and durations into seconds; its texts show the rounding.
template <std::integral Nanoseconds>
double seconds(Nanoseconds t) {
  constexpr Nanoseconds second = 1'000'000'000;
  return static_cast<double>(t / second) + 1e-9 * static_cast<double>(t % second);
}

// One cache line.
struct alignas(64) Sample {
  Stamp stamp = 0;
  Pose pose;
};
static_assert(sizeof(Sample) == 64);

// Samples sorted by stamp; those of one stamp are in order of arrival. Index 0 is the oldest. They
// lie in blocks of an arena, so that a history grows without being copied.
class Samples {
 public:
  explicit Samples(Arena& arena) : arena_(&arena) {}
  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;
  ~Samples() { clear(); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  // The samples that fit before more memory is taken, counted from the oldest one.
  std::size_t capacity() const { return room_ - head_; }
  // What the samples take, with the room for more.
  std::size_t bytes() const {
    return room_ * sizeof(Sample) + blocks_.capacity() * sizeof(Block) + parents_.bytes();
  }

  const Sample& operator[](std::size_t i) const { return at(head_ + i); }
  Stamp stamp(std::size_t i) const { return at(head_ + i).stamp; }
  FrameId parent(std::size_t i) const { return parents_[i]; }
  // How often the parent changes from one sample to the next.
  std::size_t parent_changes() const { return parents_.changes(); }
  // Both are 0 if there are no samples.
  Stamp oldest() const { return oldest_; }
  Stamp newest() const { return newest_; }
  const Sample& front() const { return at(head_); }
  const Sample& back() const { return *back_; }

  void push_back(const Sample& sample, FrameId parent) {
    if (head_ + size_ == room_) grow();
    parents_.insert(size_, 1, parent);
    append(sample);
  }

  // Memory for further samples, to be written in place; one at least.
  std::span<Sample> room() {
    if (head_ + size_ == room_) grow();
    const std::size_t end = head_ + size_;
    return {&at(end), std::min(kBlock - end % kBlock, room_ - end)};
  }
  // Adds the first `count` samples of the room, one at least.
  void add_written(std::size_t count, FrameId parent) {
    parents_.insert(size_, count, parent);
    const std::size_t begin = head_ + size_;
    size_ += count;
    note_first_stamps(begin);
    note_ends();
    measure_rate();
  }

  void insert(std::size_t i, const Sample& sample, FrameId parent) {
    if (head_ + size_ == room_) grow();
    parents_.insert(i, 1, parent);
    append(sample);
    for (std::size_t last = head_ + size_ - 1; last > head_ + i; --last) at(last) = at(last - 1);
    at(head_ + i) = sample;
    note_first_stamps(head_ + i);
    note_ends();
    measure_rate();
  }

  // Puts another sample of the same stamp in the place of one.
  void replace(std::size_t i, const Sample& sample, FrameId parent) {
    parents_.insert(i + 1, 1, parent);
    parents_.erase(i);
    at(head_ + i) = sample;
  }

  void pop_front() {
    parents_.erase(0);
    ++head_;
    --size_;
    if (head_ == kBlock) drop_first_block();
    oldest_ = size_ > 0 ? at(head_).stamp : 0;
  }

  void clear() {
    for (std::size_t i = first_; i < first_ + (room_ + kBlock - 1) / kBlock; ++i)
      give_back(blocks_[i]);
    blocks_ = {};
    parents_ = {};
    back_ = nullptr;
    oldest_ = newest_ = 0;
    first_ = size_class_ = room_ = head_ = size_ = 0;
    per_ns_ = 0.0;
  }

  // The last sample at or before `t`; needs oldest() <= t.
  std::size_t last_at_or_before(Stamp t) const {
    return t >= newest() ? size_ - 1 : search(t, guess(t));
  }

  // The same, tried first at `hint` and its successor: for stamps that come in order.
  std::size_t last_at_or_before(Stamp t, std::size_t hint) const {
    if (hint + 2 < size_ && stamp(hint) <= t) {
      if (t < stamp(hint + 1)) return hint;
      if (t < stamp(hint + 2)) return hint + 1;
    }
    return last_at_or_before(t);
  }

  // Two samples that follow each other.
  struct Pair {
    const Sample *older, *newer;

    double ratio(Stamp t) const {
      const bool before = t < older->stamp;
      const auto part =
          static_cast<double>(before ? elapsed(t, older->stamp) : elapsed(older->stamp, t));
      const auto whole = static_cast<double>(elapsed(older->stamp, newer->stamp));
      return before ? -part / whole : part / whole;
    }
  };
  Pair pair(std::size_t i) const {
    const Sample* older = &at(head_ + i);
    const bool last_of_block = (head_ + i + 1) % kBlock == 0;
    return {older, last_of_block ? &at(head_ + i + 1) : older + 1};
  }
  // The pair around `t`; needs oldest() <= t < newest().
  Pair around(Stamp t) const { return around(t, guess(t)); }
  // The same, looked for from a guess on.
  Pair around(Stamp t, std::size_t guess) const {
    const Pair guessed = pair(guess);
    const bool fits = guessed.older->stamp <= t && t < guessed.newer->stamp;
    return fits ? guessed : pair(search(t, guess));
  }

  // Where `t` lies by the mean rate; never the last sample. Needs t <= newest().
  std::size_t guess(Stamp t) const {
    const std::size_t last = size_ - 1;
    const double back = static_cast<double>(elapsed(t, newest())) * per_ns_;
    return back < static_cast<double>(last) ? last - 1 - static_cast<std::size_t>(back) : 0;
  }

 private:
  static constexpr std::size_t kSmallestBlock = 8, kBlock = 32;  // samples
  static constexpr std::size_t kLargestClass = 2;
  static_assert(Arena::kSmallest == kSmallestBlock * sizeof(Sample));
  static_assert(Arena::kSizes == kLargestClass + 1 && kSmallestBlock << kLargestClass == kBlock);

  // One piece of the arena's memory, and the stamp it starts with: a search that reads these first
  // touches few samples.
  struct Block {
    Sample* samples;
    Stamp begin;
  };

  // Samples of one block; only a link with a single block can have a smaller one.
  std::size_t per_block() const { return kSmallestBlock << size_class_; }
  // `i` counts from the start of the first block.
  const Block& block_at(std::size_t i) const { return blocks_[first_ + i / kBlock]; }
  Block& block_at(std::size_t i) { return blocks_[first_ + i / kBlock]; }
  Sample& at(std::size_t i) const { return block_at(i).samples[i % kBlock]; }

  Sample* take(std::size_t size_class) {
    return reinterpret_cast<Sample*>(arena_->take(size_class));
  }
  void give_back(const Block& block) {
    arena_->give_back(reinterpret_cast<std::byte*>(block.samples), size_class_);
  }

  // Needs room.
  void append(const Sample& sample) {
    const std::size_t end = head_ + size_;
    Block& block = block_at(end);
    if (end % kBlock == 0) block.begin = sample.stamp;
    back_ = block.samples + end % kBlock;
    *back_ = sample;
    newest_ = sample.stamp;
    if (size_ == 0) oldest_ = newest_;
    ++size_;
    if (size_ < 64 || end % kBlock == 0) measure_rate();
  }

  void note_ends() {
    back_ = &at(head_ + size_ - 1);
    newest_ = back_->stamp;
    oldest_ = at(head_).stamp;
  }

  // After samples have changed from `i` on.
  void note_first_stamps(std::size_t i) {
    for (i -= i % kBlock; i < head_ + size_; i += kBlock) {
      Block& block = block_at(i);
      block.begin = block.samples->stamp;
    }
  }

  void measure_rate() {
    const std::uint64_t span = elapsed(oldest(), newest());
    per_ns_ = span > 0 ? static_cast<double>(size_ - 1) / static_cast<double>(span) : 0.0;
  }

  // The last sample at or before `t`, looked for from a guess on: first its block, and in another
  // block than the guess's by the mean rate again. So the cost depends on how regular the stamps
  // are, and not on how old `t` is.
  std::size_t search(Stamp t, std::size_t guess) const {
    const std::size_t last = head_ + size_ - 1;
    std::size_t at = head_ + guess;
    const auto begin = [this](std::size_t block) { return blocks_[first_ + block].begin; };
    const std::size_t block = gallop(t, at / kBlock, last / kBlock + 1, begin);
    if (block != at / kBlock) {
      const double after = static_cast<double>(elapsed(begin(block), t)) * per_ns_;
      at = block * kBlock + (after < kBlock ? static_cast<std::size_t>(after) : kBlock - 1);
      at = std::clamp(at, head_, last);
    }
    return gallop(t, at - head_, size_, [this](std::size_t i) { return stamp(i); });
  }

  // The last of the first `size` stamps that is not after `t`; needs stamp_of(0) <= t. It takes
  // longer the farther the guess is off.
  template <typename StampOf>
  static std::size_t gallop(Stamp t, std::size_t guess, std::size_t size, StampOf stamp_of) {
    std::size_t low = guess, high = guess, step = 1;
    if (stamp_of(guess) <= t) {
      for (; low + step < size && stamp_of(low + step) <= t; step *= 2) low += step;
      high = std::min(low + step, size);
    } else {
      for (; high > step && stamp_of(high - step) > t; step *= 2) high -= step;
      low = high > step ? high - step : 0;
    }
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (stamp_of(middle) <= t ? low : high) = middle;
    }
    return low;
  }

  void grow() {
    if (room_ > 0 && size_class_ < kLargestClass) {
      grow_only_block();
      return;
    }
    const std::size_t used = first_ + room_ / kBlock;
    if (used == blocks_.size()) blocks_.push_back({});
    blocks_[used] = {take(size_class_), 0};
    room_ += per_block();
  }

  // Makes room in a block that is not of the full size: by dropping what was pruned, or by moving
  // to a block of twice the size.
  void grow_only_block() {
    const std::size_t wanted = 2 * size_ <= room_ ? size_class_ : size_class_ + 1;
    Sample* samples = take(wanted);
    std::copy_n(&at(head_), size_, samples);
    give_back(std::exchange(blocks_[first_], Block{samples, oldest_}));
    size_class_ = wanted;
    room_ = per_block();
    head_ = 0;
    note_ends();
  }

  void drop_first_block() {
    give_back(blocks_[first_]);
    ++first_;
    room_ -= kBlock;
    head_ = 0;
    if (2 * first_ > blocks_.size()) {  // then moving the others costs little for each block
      blocks_.erase(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(first_));
      first_ = 0;
    }
  }

  Arena* arena_;
  std::vector<Block> blocks_;  // from index first_ on, in order of time
  Parents parents_;
  std::size_t first_ = 0;
  std::size_t size_class_ = 0;  // of all blocks
  std::size_t room_ = 0;        // samples that fit into the blocks
  std::size_t head_ = 0;        // samples at the start of the first block that were dropped
  std::size_t size_ = 0;
  Stamp oldest_ = 0, newest_ = 0;  // also stored here, because all lookups read them
  Sample* back_ = nullptr;         // likewise
  double per_ns_ = 0.0;
};

}  // namespace turtlewire
