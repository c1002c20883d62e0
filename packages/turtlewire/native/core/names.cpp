#include "names.hpp"

namespace turtlewire {
namespace {

constexpr std::size_t kLongestName = 4096;

std::size_t continuation_bytes(unsigned char lead) {
  if (lead < 0x80) return 0;
  if (lead >= 0xC2 && lead <= 0xDF) return 1;
  if (lead >= 0xE0 && lead <= 0xEF) return 2;
  if (lead >= 0xF0 && lead <= 0xF4) return 3;
  return 4;  // no lead byte
}

// The second byte of E0, ED, F0 and F4 is restricted: no overlong form, no surrogate, nothing above
// U+10FFFF.
bool second_byte_fits(unsigned char lead, unsigned char second) {
  if (lead == 0xE0) return second >= 0xA0;
  if (lead == 0xED) return second <= 0x9F;
  if (lead == 0xF0) return second >= 0x90;
  if (lead == 0xF4) return second <= 0x8F;
  return true;
}

}  // namespace

bool is_frame_name(std::string_view text) {
  if (text.size() > kLongestName) return false;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t more = continuation_bytes(lead);
    if (lead == 0 || more == 4 || text.size() - i <= more) return false;
    if (more > 0 && !second_byte_fits(lead, static_cast<unsigned char>(text[i + 1]))) return false;
    for (std::size_t k = 1; k <= more; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return false;
    }
    i += 1 + more;
  }
  return true;
}

}  // namespace turtlewire
