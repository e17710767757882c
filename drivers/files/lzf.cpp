#include "drivers/files/lzf.hpp"

namespace graspd {

bool unpack_lzf(std::string_view packed, std::size_t size, std::string& unpacked) {
  unpacked.clear();
  std::size_t next = 0;
  const auto take = [&] { return static_cast<std::size_t>(static_cast<unsigned char>(packed[next++])); };
  while (next < packed.size()) {
    const std::size_t control = take();
    if (control < 32) {
      // A run of control + 1 bytes as they stand.
      const std::size_t length = control + 1;
      if (length > packed.size() - next || length > size - unpacked.size()) return false;
      unpacked.append(packed.substr(next, length));
      next += length;
      continue;
    }
    // A repetition: three bits of length, thirteen of distance back; length 7 continues in a byte.
    std::size_t length = (control >> 5U) + 2;
    if (length == 9) {
      if (next >= packed.size()) return false;
      length += take();
    }
    if (next >= packed.size()) return false;
    const std::size_t distance = ((control & 31U) << 8U) + take() + 1;
    if (distance > unpacked.size() || length > size - unpacked.size()) return false;
    // Byte by byte: a repetition may overlap what it makes.
    for (; length > 0; --length) unpacked.push_back(unpacked[unpacked.size() - distance]);
  }
  return unpacked.size() == size;
}

}  // namespace graspd
