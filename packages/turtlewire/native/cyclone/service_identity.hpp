// The identity of a service's message as Fast DDS sends it: beside the fields, in the inline QoS.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace turtlewire::cyclone {

// "Related sample identity": which request a message is, or which one it answers.
struct Identity {
  // The number of a request that only names the reader of its reply: it is that of its sample.
  static constexpr std::int64_t kOfSample = -(std::int64_t{1} << 32);

  std::array<unsigned char, 16> guid;
  std::int64_t number;
};

// What Python finds between the encapsulation and the fields of a message that came with an
// identity: a mark, the GUID, and the number in little endian.
inline constexpr std::size_t kMarkedHeader = 8 + 16 + 8;
std::array<unsigned char, kMarkedHeader> marked_header(const Identity& identity);

// The identity of a received message; none if it was sent in the layout of rmw_cyclonedds.
//
// `head` is the datagram up to the payload, `submessage` the offset of its DATA or DATA_FRAG.
// Senders on Fast DDS always have one: without a parameter, it is writer and sample.
std::optional<Identity> received_identity(std::span<const unsigned char> head,
                                          std::size_t submessage);

// Inline QoS that holds the identity twice and ends the list, in the byte order of this computer.
inline constexpr std::size_t kInlineQos = 2 * (4 + 24) + 4;
std::array<unsigned char, kInlineQos> inline_qos(const Identity& identity);

}  // namespace turtlewire::cyclone
