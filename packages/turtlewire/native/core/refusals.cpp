#include "refusals.hpp"

namespace turtlewire {
namespace {

constexpr std::size_t kLongestShown = 4096;  // of the names: what is refused may be of any length

std::string shown(std::string_view name) { return std::string(name.substr(0, kLongestShown)); }

}  // namespace

void Refusals::add(const Refusal& refusal) {
  std::string child = shown(refusal.child);
  if (records_.size() >= kMostFrames && !records_.contains(child)) child = "(others)";
  RefusalRecord& record = records_[child];
  const bool is_new = ++record.counts[static_cast<std::size_t>(refusal.verdict)] == 1;
  if (is_new && refusal.verdict != Verdict::too_many_frames) ++kinds_;
  record.last = refusal.verdict;
  record.parent = shown(refusal.parent);
  record.authority = refusal.authority;
  record.stamp = refusal.stamp;
  record.pose = refusal.pose;
}

void Refusals::add_malformed(std::string_view fault, SourceId source) {
  ++malformed_.count;
  malformed_.last = fault;
  malformed_.source = source;
}

}  // namespace turtlewire
