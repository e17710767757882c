#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace graspd {

/// The bank file: a header, a directory of sections, then the sections, each an array that is read in
/// place. Every section starts at a multiple of bank_alignment from the start of the file.
inline constexpr std::array<char, 8> bank_magic{'G', 'R', 'A', 'S', 'P', 'B', 'N', 'K'};
inline constexpr std::uint32_t bank_version = 4;
inline constexpr std::uint32_t bank_byte_order = 0x01020304U;
inline constexpr std::uint32_t bank_byte_order_swapped = 0x04030201U;
inline constexpr std::size_t bank_alignment = 64;

/// What the sections hold; each kind stands in the file once, in this order.
enum class BankSection : std::uint32_t {
  part,
  grid,
  views,
  view_points,
  cell_offsets,
  entries,
  reference_points,
  reference_views,
  surface,
  edges,
  visibility_directions,
  visibility_bits,
  mesh_vertices,
  mesh_triangles,
  symmetry_discrete,
  twins,
  grasps,
};
inline constexpr std::size_t bank_section_count = 17;

/// The section's name for messages.
[[nodiscard]] const char* bank_section_name(BankSection section);

struct BankHeader {
  std::array<char, 8> magic = bank_magic;
  std::uint32_t byte_order = bank_byte_order;
  std::uint32_t version = bank_version;
  std::uint64_t file_size = 0;  ///< Bytes of the whole file.
  std::uint64_t checksum = 0;   ///< bank_checksum of the file.
  std::uint32_t section_count = bank_section_count;
  std::uint32_t reserved[7] = {};  ///< Zero.
};
static_assert(sizeof(BankHeader) == 64);

struct BankSectionRecord {
  BankSection kind = BankSection::part;
  std::uint32_t element_size = 0;  ///< Bytes of one element.
  std::uint64_t offset = 0;        ///< From the start of the file.
  std::uint64_t count = 0;         ///< Elements.
};
static_assert(sizeof(BankSectionRecord) == 24);

/// Checksum of a whole bank file with the header's checksum field taken as zero. Every step is a
/// bijection of the state, so damage inside one 8-byte word never goes unnoticed.
[[nodiscard]] std::uint64_t bank_checksum(std::span<const std::byte> file);

}  // namespace graspd
