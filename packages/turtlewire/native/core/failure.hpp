// The reasons for failed lookups and rejected transforms: recorded while the buffer is locked, and
// formatted afterwards.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "pose.hpp"
#include "samples.hpp"

namespace turtlewire {

enum class Status : std::uint8_t {
  ok,
  empty_name,
  slash_name,
  unknown_frame,
  not_connected,
  loop,
  no_data,  // the link has no sample, or one sample of another time
  future,
  past,
  no_static_data,  // the link is static and was cleared
};

// Which call asked: tf2 words its complaints about frame ids by it.
enum class Question : std::uint8_t { lookup, can_transform, latest_common_time };
enum class Argument : std::uint8_t { target, source, fixed };

struct Failure {
  Status status = Status::ok;
  Argument argument = Argument::target;  // of the three name errors
  std::string name;                      // likewise
  std::string target, source;            // of this step: a lookup through a fixed frame has two
  std::string target_root, source_root;  // of two frames that are not connected
  std::string link_child,
      link_parent;               // the link whose data does not reach, with its newest parent
  bool emptied = false;          // that link has no sample at all
  bool is_emptied_told = false;  // and the text says so
  bool latest = false;           // the latest time was asked for, which new data moves on
  Stamp requested = kLatest, oldest = 0, newest = 0;
  std::string frames;  // all_frames_as_string() of a tree with a loop
};

// tf2's text, to the byte.
std::string explain(const Failure& failure, Question question);

enum class Verdict : std::uint8_t {
  accepted,
  self_transform,
  no_child_frame,
  no_parent_frame,
  nan_value,
  old_data,
  reserved_name,
  bad_name,
  too_many_frames,
  denormalized,
};
inline constexpr std::size_t kVerdicts = 10;

struct Refusal {
  Verdict verdict = Verdict::accepted;
  std::string_view parent{}, child{}, authority{};
  Stamp stamp = 0;
  Pose pose{};
};

// tf2's text for its own reasons, without the final newline; ours for the reasons that only we
// have.
std::string explain(const Refusal& refusal);

}  // namespace turtlewire
