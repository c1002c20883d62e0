// The history of one link: samples in order of time, stamps apart from poses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "arena.hpp"
#include "pose.hpp"

namespace turtlewire {

using FrameId = std::uint32_t;   // 0 is "NO_PARENT"
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

// As tf2 turns times and durations into seconds; its texts show the rounding.
inline double seconds(Stamp t) {
  constexpr Stamp second = 1'000'000'000;
  return static_cast<double>(t / second) + 1e-9 * static_cast<double>(t % second);
}

// One cache line. The stamps, which a search reads, are kept apart, so that a search touches 8
// bytes of a sample.
struct alignas(64) Sample {
  Pose pose;
  FrameId parent = 0;
  SourceId source = 0;
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
    return room_ * (sizeof(Stamp) + sizeof(Sample)) + blocks_.capacity() * sizeof(Block);
  }

  Stamp stamp(std::size_t i) const { return stamp_at(head_ + i); }
  const Sample& operator[](std::size_t i) const { return sample_at(head_ + i); }
  Sample& operator[](std::size_t i) { return sample_at(head_ + i); }
  // Both are 0 if there are no samples.
  Stamp oldest() const { return oldest_; }
  Stamp newest() const { return newest_; }
  const Sample& front() const { return sample_at(head_); }
  const Sample& back() const { return *back_; }

  void push_back(Stamp stamp, const Sample& sample) {
    if (head_ + size_ == room_) grow();
    const std::size_t at = head_ + size_;
    const Block& block = block_at(at);
    block.stamps[at % kBlock] = newest_ = stamp;
    back_ = block.samples + at % kBlock;
    *back_ = sample;
    if (size_ == 0) oldest_ = stamp;
    ++size_;
    if (size_ < 64 || at % kBlock == 0) measure_rate();
  }

  // Memory for further samples, to be written in place; one at least.
  struct Room {
    Stamp* stamps;
    Sample* samples;
    std::size_t size;
  };
  Room room() {
    if (head_ + size_ == room_) grow();
    const std::size_t at = head_ + size_, place = at % kBlock;
    const Block& block = block_at(at);
    return {block.stamps + place, block.samples + place, std::min(kBlock - place, room_ - at)};
  }
  // Adds the first `count` samples of the room, one at least.
  void add_written(std::size_t count) {
    size_ += count;
    note_ends();
    measure_rate();
  }

  void insert(std::size_t i, Stamp stamp, const Sample& sample) {
    push_back(stamp, sample);
    for (std::size_t at = head_ + size_ - 1; at > head_ + i; --at) {
      stamp_at(at) = stamp_at(at - 1);
      sample_at(at) = sample_at(at - 1);
    }
    stamp_at(head_ + i) = stamp;
    sample_at(head_ + i) = sample;
    note_ends();
    measure_rate();
  }

  void pop_front() {
    ++head_;
    --size_;
    if (head_ == kBlock) drop_first_block();
    oldest_ = size_ > 0 ? stamp_at(head_) : 0;
  }

  void clear() {
    for (std::size_t i = first_; i < first_ + (room_ + kBlock - 1) / kBlock; ++i)
      give_back(blocks_[i]);
    blocks_ = {};
    back_ = nullptr;
    oldest_ = newest_ = 0;
    first_ = size_class_ = room_ = head_ = size_ = 0;
    per_ns_ = 0.0;
  }

  // The last sample at or before `t`; needs oldest() <= t. The place is guessed from the mean rate,
  // so that its cost depends on how regular the stamps are and not on how old `t` is.
  std::size_t last_at_or_before(Stamp t) const {
    if (t >= newest()) return size_ - 1;
    const std::size_t i = guess(t);
    if (stamp(i) > t) return gallop_down(i, t);
    return stamp(i + 1) > t ? i : gallop_up(i, t);
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
    Stamp older_stamp, newer_stamp;

    double ratio(Stamp t) const {
      return static_cast<double>(t - older_stamp) / static_cast<double>(newer_stamp - older_stamp);
    }
  };
  Pair pair(std::size_t i) const {
    const std::size_t at = head_ + i, place = at % kBlock;
    const Block& block = block_at(at);
    const Block& next = place + 1 < kBlock ? block : block_at(at + 1);
    const std::size_t next_place = (place + 1) % kBlock;
    return {block.samples + place, next.samples + next_place, block.stamps[place],
            next.stamps[next_place]};
  }
  // The pair around `t`; needs oldest() <= t < newest().
  Pair around(Stamp t) const { return around(t, guess(t)); }
  // The same, looked for from a guess on.
  Pair around(Stamp t, std::size_t guess) const {
    const Pair guessed = pair(guess);
    if (guessed.older_stamp > t) return pair(gallop_down(guess, t));
    return guessed.newer_stamp > t ? guessed : pair(gallop_up(guess, t));
  }

  // Where `t` lies by the mean rate; never the last sample. Needs t <= newest().
  std::size_t guess(Stamp t) const {
    const std::size_t last = size_ - 1;
    const double back = static_cast<double>(newest() - t) * per_ns_;
    return back < static_cast<double>(last) ? last - 1 - static_cast<std::size_t>(back) : 0;
  }
  // What around() reads first.
  const Stamp* address_of_stamp(std::size_t i) const { return &stamp_at(head_ + i); }

 private:
  static constexpr std::size_t kSmallestBlock = 8, kBlock = 32;  // samples
  static constexpr std::size_t kLargestClass = 2;
  static_assert(Arena::kSmallest == kSmallestBlock * (sizeof(Stamp) + sizeof(Sample)));
  static_assert(Arena::kSizes == kLargestClass + 1 && kSmallestBlock << kLargestClass == kBlock);

  // One piece of the arena's memory, which starts with the stamps.
  struct Block {
    Stamp* stamps;
    Sample* samples;
  };

  // Samples of one block; only a link with a single block can have a smaller one.
  std::size_t per_block() const { return kSmallestBlock << size_class_; }
  // `at` counts from the start of the first block.
  const Block& block_at(std::size_t at) const { return blocks_[first_ + at / kBlock]; }
  Stamp& stamp_at(std::size_t at) const { return block_at(at).stamps[at % kBlock]; }
  Sample& sample_at(std::size_t at) const { return block_at(at).samples[at % kBlock]; }

  Block take(std::size_t size_class) {
    std::byte* memory = arena_->take(size_class);
    const std::size_t bytes_of_stamps = (kSmallestBlock << size_class) * sizeof(Stamp);
    return {reinterpret_cast<Stamp*>(memory), reinterpret_cast<Sample*>(memory + bytes_of_stamps)};
  }
  void give_back(const Block& block) {
    arena_->give_back(reinterpret_cast<std::byte*>(block.stamps), size_class_);
  }

  void note_ends() {
    oldest_ = stamp_at(head_);
    newest_ = stamp_at(head_ + size_ - 1);
    back_ = &sample_at(head_ + size_ - 1);
  }

  void measure_rate() {
    const Stamp span = newest() - oldest();
    per_ns_ = span > 0 ? static_cast<double>(size_ - 1) / static_cast<double>(span) : 0.0;
  }

  // Both assume stamp(size_ - 1) > t.
  std::size_t gallop_up(std::size_t low, Stamp t) const {
    std::size_t step = 1;
    while (low + step < size_ - 1 && stamp(low + step) <= t) {
      low += step;
      step *= 2;
    }
    return bisect(low, std::min(low + step, size_ - 1), t);
  }

  std::size_t gallop_down(std::size_t high, Stamp t) const {
    std::size_t step = 1;
    while (high > step && stamp(high - step) > t) {
      high -= step;
      step *= 2;
    }
    return bisect(high > step ? high - step : 0, high, t);
  }

  // stamp(low) <= t < stamp(high)
  std::size_t bisect(std::size_t low, std::size_t high, Stamp t) const {
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (stamp(middle) <= t ? low : high) = middle;
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
    blocks_[used] = take(size_class_);
    room_ += per_block();
  }

  // Makes room in a block that is not of the full size: by dropping what was pruned, or by moving
  // to a block of twice the size.
  void grow_only_block() {
    const std::size_t wanted = 2 * size_ <= room_ ? size_class_ : size_class_ + 1;
    const Block block = take(wanted);
    std::copy_n(&stamp_at(head_), size_, block.stamps);
    std::copy_n(&sample_at(head_), size_, block.samples);
    give_back(std::exchange(blocks_[first_], block));
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
