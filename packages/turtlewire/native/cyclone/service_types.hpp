// Identities of service messages, in and out of Cyclone.
//
// Cyclone hides the inline QoS of a sample, and has no call to add any. Both pass through the table
// of functions of the sample's type, though, and three of them are exchanged here:
// - the one that makes a sample of received datagrams puts the identity in front of the fields,
//   where Python finds it behind a mark;
// - the one that refers to the bytes of a sample is called when a message has its headers and not
//   yet its payload: the identity is appended there, in every message that carries the sample;
// - the one that frees a sample forgets its identity.
#pragma once

#include <atomic>
#include <memory>

#include "library.hpp"
#include "service_identity.hpp"

namespace turtlewire::cyclone {

// What is sent with a sample, and what became of it.
struct Tag {
  explicit Tag(const Identity& sent) : identity(sent) {}

  const Identity identity;
  // Whether a message took the identity, and whether one did not.
  std::atomic<bool> appended = false, refused = false;
};

// Has samples of a type (a ddsi_sertype) carry identities; once more does no harm. False, and
// nothing is changed, if the type is not laid out as in the known versions of Cyclone. `base` is 0,
// or the type that carries them already and of which Cyclone has made this one for a writer.
bool carry_identities(const Library& library, std::uintptr_t type, std::uintptr_t base = 0);

// Has the writers of a type use it itself. Cyclone 0.10 makes a copy of a type whose functions are
// exchanged, for each writer, and does not tell where it is. False, and nothing is changed, if the
// type is not laid out as in 0.10.
bool keep_type(const Library& library, std::uintptr_t type);

// Sends an identity with a sample that is about to be written, until the sample is freed. The
// type of the sample carries identities.
void tag(const void* sample, std::shared_ptr<Tag> tag);

// Appends inline QoS to the message that Cyclone is making. `reference` is where the message
// refers to its payload. False, and nothing is changed, if this is no such message, or is not laid
// out as in the known versions.
bool append_identity(Block* reference, const Identity& identity);

// How many samples have an identity now.
std::size_t tagged_samples();

}  // namespace turtlewire::cyclone
