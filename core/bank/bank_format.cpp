#include "core/bank/bank_format.hpp"

#include <algorithm>
#include <cstring>

namespace graspd {

const char* bank_section_name(BankSection section) {
  switch (section) {
    case BankSection::part:
      return "part";
    case BankSection::grid:
      return "grid";
    case BankSection::views:
      return "views";
    case BankSection::view_points:
      return "view points";
    case BankSection::cell_offsets:
      return "cell offsets";
    case BankSection::entries:
      return "entries";
    case BankSection::reference_points:
      return "reference points";
    case BankSection::reference_views:
      return "reference views";
    case BankSection::surface:
      return "surface";
    case BankSection::edges:
      return "edges";
    case BankSection::visibility_directions:
      return "visibility directions";
    case BankSection::visibility_bits:
      return "visibility bits";
    case BankSection::mesh_vertices:
      return "mesh vertices";
    case BankSection::mesh_triangles:
      return "mesh triangles";
    case BankSection::symmetry_discrete:
      return "symmetries";
    case BankSection::twins:
      return "twins";
    case BankSection::grasps:
      return "grasps";
  }
  return "unknown";
}

std::uint64_t bank_checksum(std::span<const std::byte> file) {
  constexpr std::size_t checksum_at = offsetof(BankHeader, checksum);
  std::uint64_t state = 0x9E3779B97F4A7C15U ^ file.size();
  for (std::size_t at = 0; at < file.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    if (at != checksum_at) std::memcpy(&word, &file[at], std::min(sizeof(word), file.size() - at));
    state = (state ^ word) * 0xD6E8FEB86659FD93U;
    state ^= state >> 32U;
  }
  return state;
}

}  // namespace graspd
