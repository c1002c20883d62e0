#include "service_types.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <deque>
#include <mutex>
#include <new>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#ifdef __linux__
#include <dlfcn.h>
#include <sys/uio.h>
#include <unistd.h>
#endif

namespace turtlewire::cyclone {
namespace {

// ddsi_serdata_ops, in its order; 0.10 and 11 have different functions behind these.
enum Function { kFromReceived = 2, kFromBlocks = 3, kToBlock = 7, kFree = 12, kFunctions = 15 };
constexpr std::size_t kTableSize = 17;
using Table = std::array<void*, kTableSize>;

// ddsi_sertype_ops of 0.10.
enum TypeFunction { kArgument = 1, kDerive = 11, kTypeFunctions = 14 };
using TypeTable = std::array<void*, kTypeFunctions>;

// The beginning of ddsi_sertype.
struct Type {
  const TypeTable* functions;
  const Table* of_samples;
};

// ddsi_rmsg, in front of the bytes of a datagram.
struct Datagram {
  std::uint32_t references;
  void* last_chunk;
  bool traced;
  struct {
    void* buffer;
    void* next;
    std::uint64_t size;
  } chunk;

  const unsigned char* bytes() const { return reinterpret_cast<const unsigned char*>(this + 1); }
};

// ddsi_rdata, a piece of a sample.
struct Fragment {
  const Datagram* datagram;
  const Fragment* next;
  std::uint32_t begin, end;
  std::uint16_t submessage, payload;
};

// The beginning of ddsi_xmsg, a message that is being made.
struct Message {
  void* pool;
  std::size_t room, size;
  int has_parameters;
  void* payload;
  Block reference;
};

using FromReceived = void* (*)(const void*, int, const Fragment*, std::size_t);
using FromBlocks = void* (*)(const void*, int, BlockCount, const Block*, std::size_t);
using ToBlock = void* (*)(const void*, std::size_t, std::size_t, Block*);
using Free = void (*)(void*);

constexpr int kData = 2;  // SDK_DATA
constexpr std::size_t kEncapsulation = 4;

struct State {
  std::mutex mutex;
  Table original{}, exchanged{};
  std::deque<Table> tables;
  TypeTable without_derive{};
  bool ready = false;
  std::unordered_map<const void*, std::shared_ptr<Tag>> tags;
  std::atomic<int> word = -1;  // of ddsi_xmsg that points to the bytes, once it is known
};

// Never destroyed: threads of Cyclone's may outlive this module's static objects.
State& state() {
  static State& made = *new State;
  return made;
}

// Reads memory that may not be mapped.
bool peek(const void* from, void* to, std::size_t size) {
#ifdef __linux__
  const iovec local{to, size}, remote{const_cast<void*>(from), size};
  return ::process_vm_readv(::getpid(), &local, 1, &remote, 1, 0) == static_cast<ssize_t>(size);
#else
  static_cast<void>(from), static_cast<void>(to), static_cast<void>(size);
  return false;
#endif
}

// Whether all functions are of the library that `own` is of.
bool are_of_library(std::span<void* const> functions, const void* own) {
#ifdef __linux__
  Dl_info library, info;
  if (::dladdr(own, &library) == 0) return false;
  return std::all_of(functions.begin(), functions.end(), [&](const void* function) {
    return ::dladdr(function, &info) != 0 && info.dli_fbase == library.dli_fbase;
  });
#else
  return static_cast<void>(functions), static_cast<void>(own), false;
#endif
}

void* with_header(const void* type, const Fragment* chain, std::size_t size,
                  const Identity& identity) {
  std::vector<unsigned char> bytes(size + kMarkedHeader);
  for (const Fragment* each = chain; each != nullptr; each = each->next) {
    if (each->begin > each->end || each->end > size) return nullptr;
    std::memcpy(bytes.data() + kMarkedHeader + each->begin, each->datagram->bytes() + each->payload,
                each->end - each->begin);
  }
  std::memcpy(bytes.data(), bytes.data() + kMarkedHeader, kEncapsulation);
  const auto header = marked_header(identity);
  std::memcpy(bytes.data() + kEncapsulation, header.data(), header.size());
  const Block whole = block(bytes.data(), bytes.size());
  return reinterpret_cast<FromBlocks>(state().original[kFromBlocks])(type, kData, 1, &whole,
                                                                     bytes.size());
}

void* from_received(const void* type, int kind, const Fragment* chain, std::size_t size) {
  if (kind == kData && size >= kEncapsulation && chain->begin == 0) {
    const auto identity =
        received_identity({chain->datagram->bytes(), chain->payload}, chain->submessage);
    try {
      if (identity) return with_header(type, chain, size, *identity);
    } catch (const std::bad_alloc&) {
      return nullptr;  // the message is lost
    }
  }
  return reinterpret_cast<FromReceived>(state().original[kFromReceived])(type, kind, chain, size);
}

void* to_block(const void* sample, std::size_t offset, std::size_t size, Block* reference) {
  State& own = state();
  std::shared_ptr<Tag> tag;
  {
    const std::scoped_lock lock(own.mutex);
    const auto found = own.tags.find(sample);
    if (found != own.tags.end()) tag = found->second;
  }
  // Each fragment of a sample gets it, because Fast DDS reads the one that arrives first.
  if (tag) (append_identity(reference, tag->identity) ? tag->appended : tag->refused) = true;
  return reinterpret_cast<ToBlock>(own.original[kToBlock])(sample, offset, size, reference);
}

void forget(void* sample) {
  State& own = state();
  {
    const std::scoped_lock lock(own.mutex);
    own.tags.erase(sample);
  }
  reinterpret_cast<Free>(own.original[kFree])(sample);
}

// The header of the submessage that ends at `end`; null if there is none.
unsigned char* submessage_before(unsigned char* end) {
  constexpr std::size_t kDataSize = 24, kFragSize = 36;
  std::array<unsigned char, kFragSize> tail;
  if (!peek(end - kFragSize, tail.data(), kFragSize)) return nullptr;
  for (const auto& [kind, size] : {std::pair{0x15, kDataSize}, std::pair{0x16, kFragSize}}) {
    const unsigned char* const start = tail.data() + kFragSize - size;
    constexpr unsigned char kNative = std::endian::native == std::endian::little, kWriter = 3;
    std::uint16_t to_inline_qos;
    std::memcpy(&to_inline_qos, start + 6, sizeof to_inline_qos);
    // No inline QoS yet, from a writer without keys, and its fields end where the message does.
    if (start[0] == kind && (start[1] & 3) == kNative && start[4] == 0 && start[15] == kWriter &&
        std::size_t{8} + to_inline_qos == size)
      return end - size;
  }
  return nullptr;
}

}  // namespace

bool append_identity(Block* reference, const Identity& identity) {
  constexpr int kFirstWord = 7, kLastWord = 40;
  constexpr std::size_t kMostRoom = 65536, kHeaders = 24 + 16;  // INFO_SRC, INFO_DST
  auto* const message = reinterpret_cast<unsigned char*>(reference) - offsetof(Message, reference);
  Message head;
  if (!peek(message, &head, sizeof head) || head.payload != nullptr || head.room > kMostRoom ||
      head.size < 24 || head.size > head.room || head.room - head.size < kInlineQos)
    return false;
  std::atomic<int>& known = state().word;
  const int first = known < 0 ? kFirstWord : known.load();
  const int last = known < 0 ? kLastWord : known.load();
  for (int word = first; word <= last; ++word) {
    unsigned char* bytes;
    if (!peek(message + word * sizeof(void*), &bytes, sizeof bytes) || bytes == nullptr ||
        reinterpret_cast<std::uintptr_t>(bytes) % alignof(void*) != 0)
      continue;
    unsigned char* const end = bytes + kHeaders + head.size;
    unsigned char* const submessage = submessage_before(end);
    if (submessage == nullptr) continue;
    known = word;
    const auto qos = inline_qos(identity);
    std::memcpy(end, qos.data(), qos.size());
    submessage[1] |= 2;
    head.size += qos.size();
    std::memcpy(message + offsetof(Message, size), &head.size, sizeof head.size);
    return true;
  }
  return false;
}

bool carry_identities(const Library& library, std::uintptr_t address, std::uintptr_t base) {
  State& own = state();
  const std::scoped_lock lock(own.mutex);
  Type type, other{};
  Table table;
  if (!peek(reinterpret_cast<const void*>(address), &type, sizeof type)) return false;
  if (base != 0 && !peek(reinterpret_cast<const void*>(base), &other, sizeof other)) return false;
  if (!peek(type.of_samples, &table, sizeof table)) return false;
  if (table[kFromReceived] == own.exchanged[kFromReceived] && own.ready) return true;
  if (!own.ready) {
    const auto* const library_own = reinterpret_cast<const void*>(library.make);
    if (!are_of_library(std::span(table).first(kFunctions), library_own)) return false;
    own.original = own.exchanged = table;
    own.exchanged[kFromReceived] = reinterpret_cast<void*>(from_received);
    own.exchanged[kToBlock] = reinterpret_cast<void*>(to_block);
    own.exchanged[kFree] = reinterpret_cast<void*>(forget);
    own.ready = true;
  } else if (!std::equal(table.begin(), table.begin() + kFunctions, own.original.begin())) {
    return false;
  }
  // A table for each type: Cyclone compares types by it, and would remove one in place of another.
  // It is never freed, because samples refer to it and outlive their type. Copies that Cyclone made
  // of a type are not compared.
  const Table* const exchanged =
      base != 0 ? other.of_samples : &own.tables.emplace_back(own.exchanged);
  std::memcpy(reinterpret_cast<unsigned char*>(address) + offsetof(Type, of_samples), &exchanged,
              sizeof exchanged);
  return true;
}

bool keep_type(const Library& library, std::uintptr_t address) {
  State& own = state();
  const std::scoped_lock lock(own.mutex);
  Type type;
  TypeTable table;
  if (!peek(reinterpret_cast<const void*>(address), &type, sizeof type)) return false;
  if (type.functions == &own.without_derive) return true;
  if (!peek(type.functions, &table, sizeof table) || table[kArgument] != nullptr) return false;
  const std::array<void*, 3> functions{table[0], table[kDerive], table[kTypeFunctions - 1]};
  if (!are_of_library(functions, reinterpret_cast<const void*>(library.make))) return false;
  table[kDerive] = nullptr;
  own.without_derive = table;
  const TypeTable* const changed = &own.without_derive;
  std::memcpy(reinterpret_cast<unsigned char*>(address) + offsetof(Type, functions), &changed,
              sizeof changed);
  return true;
}

void tag(const void* sample, std::shared_ptr<Tag> tag) {
  State& own = state();
  const std::scoped_lock lock(own.mutex);
  own.tags[sample] = std::move(tag);
}

std::size_t tagged_samples() {
  State& own = state();
  const std::scoped_lock lock(own.mutex);
  return own.tags.size();
}

}  // namespace turtlewire::cyclone
