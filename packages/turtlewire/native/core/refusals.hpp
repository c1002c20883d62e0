// Rejected transforms, counted by frame.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "failure.hpp"

namespace turtlewire {

// The last refused transform of one child frame, and how often it was refused for which reason.
struct RefusalRecord {
  std::array<std::uint64_t, kVerdicts> counts{};  // by Verdict
  Verdict last = Verdict::accepted;
  std::string parent, authority;
  Stamp stamp = 0;
  Pose pose;
};

// Messages in which not even the transforms could be separated.
struct MalformedMessages {
  std::uint64_t count = 0;
  std::string last;     // what was wrong with the last one
  SourceId source = 0;  // who sent it
};

class Refusals {
 public:
  static constexpr std::size_t kMostFrames =
      1000;  // the refusals of further frames are counted together

  void add(const Refusal& refusal);
  void add_malformed(std::string_view fault, SourceId source);
  const std::map<std::string, RefusalRecord, std::less<>>& by_child() const { return records_; }
  // How many pairs of a frame and a reason there are, without the lack of room.
  std::size_t kinds() const { return kinds_; }
  const MalformedMessages& malformed() const { return malformed_; }

 private:
  std::map<std::string, RefusalRecord, std::less<>> records_;
  std::size_t kinds_ = 0;
  MalformedMessages malformed_;
};

}  // namespace turtlewire
