#include "core/bank/bank_writer.hpp"

#include <array>
#include <cstring>
#include <span>

#include "core/bank/bank_format.hpp"

namespace graspd {

namespace {

std::size_t aligned(std::size_t offset) { return (offset + bank_alignment - 1) / bank_alignment * bank_alignment; }

template <class T>
void append(std::vector<std::byte>& file, std::array<BankSectionRecord, bank_section_count>& records, BankSection kind,
            std::span<const T> elements) {
  file.resize(aligned(file.size()));
  records[static_cast<std::size_t>(kind)] = {kind, sizeof(T), file.size(), elements.size()};
  const auto bytes = std::as_bytes(elements);
  file.insert(file.end(), bytes.begin(), bytes.end());
}

}  // namespace

std::vector<std::byte> write_bank(const Bank& bank) {
  // A section is written as it lies in memory, so padding would carry chance bytes into the file.
  static_assert(sizeof(BankPart) == 188 && sizeof(BankView) == 32 && sizeof(PartGrasp) == 76);
  static_assert(sizeof(OrientedPoint) == 24 && sizeof(SurfacePoint) == 24 && sizeof(EdgePoint) == 24);
  static_assert(sizeof(RigidTransform) == 48 && sizeof(Triangle) == 12 && sizeof(PpfGrid) == 12);

  std::array<BankSectionRecord, bank_section_count> records;
  std::vector<std::byte> file(sizeof(BankHeader) + sizeof(records));
  append(file, records, BankSection::part, std::span<const BankPart>(bank.part, 1));
  append(file, records, BankSection::grid, std::span<const PpfGrid>(&bank.grid, 1));
  append(file, records, BankSection::views, bank.views);
  append(file, records, BankSection::view_points, bank.view_points);
  append(file, records, BankSection::cell_offsets, bank.cell_offsets);
  append(file, records, BankSection::entries, bank.entries);
  append(file, records, BankSection::reference_points, bank.reference_points);
  append(file, records, BankSection::reference_views, bank.reference_views);
  append(file, records, BankSection::surface, bank.surface);
  append(file, records, BankSection::edges, bank.edges);
  append(file, records, BankSection::visibility_directions, bank.visibility.directions);
  append(file, records, BankSection::visibility_bits, bank.visibility.bits);
  append(file, records, BankSection::mesh_vertices, bank.mesh.vertices);
  append(file, records, BankSection::mesh_triangles, bank.mesh.triangles);
  append(file, records, BankSection::symmetry_discrete, bank.symmetry_discrete);
  append(file, records, BankSection::twins, bank.twins);
  append(file, records, BankSection::grasps, bank.grasps);

  BankHeader header;
  header.file_size = file.size();
  std::memcpy(file.data() + sizeof(header), records.data(), sizeof(records));
  std::memcpy(file.data(), &header, sizeof(header));
  header.checksum = bank_checksum(file);
  std::memcpy(file.data(), &header, sizeof(header));
  return file;
}

}  // namespace graspd
