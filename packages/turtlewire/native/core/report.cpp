// tf2's descriptions of the whole tree.
#include <algorithm>
#include <cstdio>

#include "tree.hpp"

namespace turtlewire {
namespace {

std::string decimals(double value, int digits) {
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

// tf2 takes at least 100 µs for the time between the first and the last sample.
double rate(const Link& link) {
  return static_cast<double>(link.length()) /
         std::max(seconds(elapsed(link.oldest(), link.newest())), 0.0001);
}

}  // namespace

std::string Tree::name(FrameId id) const { return std::string(frames_[id]); }

std::string Tree::sender_of(FrameId child) const {
  return std::string(senders_[links_[child]->sender()]);
}

std::string Tree::frames_as_string() const {
  std::string text;
  for (const FrameId id : known_frames_) {
    const Link& link = *links_[id];
    if (link.kind() == LinkKind::none) continue;
    text += "Frame " + name(id) + " exists with parent " + name(link.parent()) + ".\n";
  }
  return text;
}

std::string Tree::frames_as_yaml(double now) const {
  if (known_frames_.empty()) return "[]";
  std::string text;
  for (const FrameId id : known_frames_) {
    const Link& link = *links_[id];
    if (!link.has_data()) continue;
    text += name(id) + ": \n";
    text += "  parent: '" + name(link.parent()) + "'\n";
    text += "  broadcaster: '" + sender_of(id) + "'\n";
    text += "  rate: " + decimals(rate(link), 3) + "\n";
    text += "  most_recent_transform: " + decimals(seconds(link.newest()), 6) + "\n";
    text += "  oldest_transform: " + decimals(seconds(link.oldest()), 6) + "\n";
    if (now > 0.0) text += "  transform_delay: " + decimals(now - seconds(link.newest()), 3) + "\n";
    text +=
        "  buffer_length: " + decimals(seconds(elapsed(link.oldest(), link.newest())), 3) + "\n";
  }
  return text;
}

std::string Tree::dot_edge(FrameId child, const Link& link, double now) const {
  std::string text("\"");
  text.append(frames_[link.parent()])
      .append("\" -> \"")
      .append(frames_[child])
      .append("\"[label=\"");
  text += "Broadcaster: " + sender_of(child) + "\\n";
  text += "Average rate: " + decimals(rate(link), 3) + " Hz\\n";
  text += "Most recent transform: " + decimals(seconds(link.newest()), 6) + " ";
  if (now > 0.0) text += "( " + decimals(now - seconds(link.newest()), 3) + " sec old)";
  text += "\\nBuffer length: " + decimals(seconds(elapsed(link.oldest(), link.newest())), 3) +
          " sec\\n\"];\n";
  return text;
}

std::string Tree::frames_as_dot(double now) const {
  std::string text = "digraph G {\n";
  if (known_frames_.empty()) text += "\"no tf data recieved\"";
  for (const FrameId id : known_frames_) {
    if (links_[id]->kind() != LinkKind::none) text += dot_edge(id, *links_[id], now);
  }
  for (const FrameId id : known_frames_) {
    if (links_[id]->has_data()) continue;
    text +=
        "edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; label "
        "=\"view_frames Result\";\n";
    if (now > 0.0) text += "\"Recorded at time: " + decimals(now, 6) + "\"[ shape=plaintext ] ;\n";
    text += "}->\"" + name(id) + "\";\n";
  }
  return text + "}";
}

}  // namespace turtlewire
