// Checks the invariants of a buffer; tests call it after every operation.
#include <cmath>

#include "tree.hpp"

namespace turtlewire {

std::string Link::fault() const {
  if (kind_ == LinkKind::none && (parent_ != 0 || !samples_.empty())) return "a root has data";
  if (is_static() && !samples_.empty()) return "a static link has a history";
  if (kind_ == LinkKind::dynamic_link && (parent_ == 0) != samples_.empty())
    return "a parent without samples, or the reverse";
  std::size_t changes = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const Sample& sample = samples_[i];
    if (!has_scaling_ && std::fabs(dot(sample.pose.rotation, sample.pose.rotation) - 1.0) > 1e-9)
      return "a rotation is not unit";
    if (has_nan(sample.pose.translation) || samples_.parent(i) == 0) return "a sample is not valid";
    if (!is_finite(sample.pose.translation) && !has_infinity_)
      return "an infinite sample is not known";
    if (i == 0) continue;
    if (samples_.stamp(i - 1) > samples_.stamp(i)) return "stamps are not in order";
    changes += samples_.parent(i - 1) != samples_.parent(i);
  }
  if (changes != samples_.parent_changes()) return "changes of the parent are miscounted";
  if (!samples_.empty() && samples_.parent(samples_.size() - 1) != parent_)
    return "the parent is not that of the newest sample";
  if (samples_.size() > samples_.capacity()) return "more samples than room";
  return "";
}

std::string Tree::fault() const {
  if (links_.size() != frames_.size() || is_known_.size() != frames_.size())
    return "frames without a link";
  for (const FrameId frame : known_frames_) {
    if (!is_known_[frame] || frames_[frame].empty()) return "a frame is listed, but not known";
  }
  if (links_[0]->kind() != LinkKind::none) return "NO_PARENT has a parent";
  for (FrameId frame = 0; frame < links_.size(); ++frame) {
    const Link& link = *links_[frame];
    if (const std::string fault = link.fault(); !fault.empty()) return name(frame) + ": " + fault;
    if (link.parent() >= links_.size() || link.follower >= links_.size())
      return name(frame) + ": points nowhere";
    if (link.has_data() && (!is_known_[frame] || !is_known_[link.parent()]))
      return name(frame) + ": forgotten, but in use";
  }
  for (const auto& [key, known] : paths_) {
    if (!is_current(*known)) continue;
    Path fresh{.target = known->target, .source = known->source};
    build(fresh);
    if (fresh.direct != known->direct || fresh.up.size() != known->up.size() ||
        fresh.down.size() != known->down.size()) {
      return "the path from " + name(known->source) + " to " + name(known->target) +
             " is out of date";
    }
  }
  return "";
}

}  // namespace turtlewire
