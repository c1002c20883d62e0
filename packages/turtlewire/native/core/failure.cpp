#include "failure.hpp"

#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <initializer_list>

namespace turtlewire {
namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  std::va_list arguments, again;
  va_start(arguments, pattern);
  va_copy(again, arguments);
  std::string text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, pattern, arguments)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  va_end(arguments);
  return text;
}

// With a single allocation: programs expect lookups to fail, and do it often.
std::string join(std::initializer_list<std::string_view> parts) {
  std::size_t size = 0;
  for (const std::string_view part : parts) size += part.size();
  std::string text;
  text.reserve(size);
  for (const std::string_view part : parts) text += part;
  return text;
}

std::string_view argument_name(Argument argument) {
  switch (argument) {
    case Argument::target:
      return " argument target_frame";
    case Argument::source:
      return " argument source_frame";
    case Argument::fixed:
      return " argument fixed_frame";
  }
  return "";
}

std::string explain_name(const Failure& f, Question question) {
  if (question == Question::can_transform) {
    const std::string_view why = f.status == Status::empty_name ? "in tf2 frame_ids cannot be empty"
                                 : f.status == Status::slash_name
                                     ? "in tf2 frame_ids cannot start with a '/'"
                                     : "frame does not exist";
    return join({"Invalid frame ID \"", f.name, "\" passed to canTransform",
                 argument_name(f.argument), " - ", why});
  }
  const bool is_lookup = question == Question::lookup;
  const std::string_view where = is_lookup ? "lookupTransform" : "get_latest_common_time";
  const std::string_view argument = is_lookup ? argument_name(f.argument) : "";
  if (f.status == Status::unknown_frame)
    return join({"\"", f.name, "\" passed to ", where, argument, " does not exist. "});
  const std::string_view why =
      f.status == Status::empty_name ? "cannot be empty" : "cannot start with a '/'";
  return join({"Invalid argument \"", f.name, "\" passed to ", where, argument,
               " - in tf2 frame_ids ", why});
}

std::string explain_time(const Failure& f, Question question) {
  const Stamp requested = f.requested != kLatest ? f.requested : 0;
  std::string text;
  if (f.status == Status::future) {
    text = format(
        "Lookup would require extrapolation into the future.  Requested time %.6f but the latest "
        "data is at time %.6f",
        seconds(requested), seconds(f.newest));
  } else if (f.status == Status::past) {
    text = format(
        "Lookup would require extrapolation into the past.  Requested time %.6f but the earliest "
        "data is at time %.6f",
        seconds(requested), seconds(f.oldest));
  } else if (f.status == Status::no_static_data) {
    if (question == Question::lookup) text = "Static cache is empty";
  } else if (!f.emptied || f.is_emptied_told) {
    text = format(
        "Lookup would require extrapolation at time %.6f, but only time %.6f is in the buffer",
        seconds(requested), seconds(f.newest));
  }
  return text + ", when looking up transform from frame [" + f.source + "] to frame [" + f.target +
         "]";
}

std::string values(const Quat& q) { return format("(%f %f %f %f)", q.x, q.y, q.z, q.w); }

std::string values(const Pose& pose) {
  const Vec3& t = pose.translation;
  return format("(%f %f %f) ", t.x, t.y, t.z) + values(pose.rotation);
}

}  // namespace

std::string explain(const Failure& f, Question question) {
  switch (f.status) {
    case Status::ok:
      return "";
    case Status::empty_name:
    case Status::slash_name:
    case Status::unknown_frame:
      return explain_name(f, question);
    case Status::not_connected:
      return "Could not find a connection between '" + f.target + "' and '" + f.source +
             "' because they are not part of the same tree.Tf has two or more unconnected trees.";
    case Status::loop:
      return "The tf tree is invalid because it contains a loop.\n" + f.frames + "\n";
    case Status::no_data:
    case Status::future:
    case Status::past:
    case Status::no_static_data:
      return explain_time(f, question);
  }
  return "";
}

std::string explain(const Refusal& r) {
  const std::string parent(r.parent), child(r.child), authority(r.authority);
  switch (r.verdict) {
    case Verdict::accepted:
      return "";
    case Verdict::self_transform:
      return "TF_SELF_TRANSFORM: Ignoring transform from authority \"" + authority +
             "\" with frame_id and  child_frame_id \"" + child + "\" because they are the same";
    case Verdict::no_child_frame:
      return "TF_NO_CHILD_FRAME_ID: Ignoring transform from authority \"" + authority +
             "\" because child_frame_id not set ";
    case Verdict::no_parent_frame:
      return "TF_NO_FRAME_ID: Ignoring transform with child_frame_id \"" + child +
             "\"  from authority \"" + authority + "\" because frame_id not set";
    case Verdict::nan_value:
      return "TF_NAN_INPUT: Ignoring transform for child_frame_id \"" + child +
             "\" from authority \"" + authority + "\" because of a nan value in the transform " +
             values(r.pose);
    case Verdict::denormalized:
      return "TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id \"" + child +
             "\" from authority \"" + authority +
             "\" because of an invalid quaternion in the transform " + values(r.pose.rotation);
    case Verdict::old_data:
      return "TF_OLD_DATA ignoring data from the past for frame " + child + " at time " +
             format("%.6f", seconds(r.stamp)) + " according to authority " + authority +
             "\nPossible reasons are listed at http://wiki.ros.org/tf/Errors%20explained";
    case Verdict::reserved_name:
      return "Ignoring transform from authority \"" + authority +
             "\": \"NO_PARENT\" is the name tf2 keeps for the absence of a parent";
    case Verdict::bad_name:
      return "Ignoring transform from authority \"" + authority +
             "\": a frame id must be UTF-8 text without NUL, of at most 4096 bytes";
    case Verdict::too_many_frames:
      return "Ignoring transform from authority \"" + authority + "\": frame \"" + child +
             "\" or its parent \"" + parent +
             "\" is new, and the buffer holds as many frames as max_frames allows";
  }
  return "";
}

}  // namespace turtlewire
