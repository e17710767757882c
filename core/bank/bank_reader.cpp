#include <cstring>

#include "core/bank/bank.hpp"
#include "core/bank/bank_check.hpp"
#include "core/bank/bank_format.hpp"
#include "core/geometry/closed_surface.hpp"

namespace graspd {

namespace {

/// The file's sections by kind, once the directory has been checked.
struct Directory {
  std::span<const std::byte> file;
  std::array<BankSectionRecord, bank_section_count> records;
};

Status damaged(std::string_view name, const char* what) {
  return Status::format(StatusCode::bad_bank, "%.*s: %s; compile the bank again", static_cast<int>(name.size()),
                        name.data(), what);
}

Status check_header(std::span<const std::byte> file, std::string_view name) {
  const auto length = static_cast<int>(name.size());
  BankHeader header;
  if (file.size() < sizeof(header.magic) || std::memcmp(file.data(), bank_magic.data(), bank_magic.size()) != 0) {
    return Status::format(StatusCode::bad_bank, "%.*s: not a graspd bank", length, name.data());
  }
  if (file.size() < sizeof(BankHeader)) return damaged(name, "truncated inside its header");
  std::memcpy(static_cast<void*>(&header), file.data(), sizeof(BankHeader));
  if (header.byte_order == bank_byte_order_swapped) {
    return damaged(name, "written on a machine of the other byte order");
  }
  if (header.byte_order != bank_byte_order) return damaged(name, "damaged: its byte order mark is unknown");
  if (header.version != bank_version) {
    return Status::format(StatusCode::bad_bank,
                          "%.*s: bank version %u, this graspd reads version %u; compile the bank again", length,
                          name.data(), header.version, bank_version);
  }
  if (file.size() < header.file_size) {
    return Status::format(StatusCode::bad_bank, "%.*s: truncated: %zu of %llu bytes; compile or copy the bank again",
                          length, name.data(), file.size(), static_cast<unsigned long long>(header.file_size));
  }
  if (file.size() > header.file_size) return damaged(name, "damaged: longer than its header says");
  if (bank_checksum(file) != header.checksum) {
    return damaged(name, "damaged: its checksum does not match its contents");
  }
  if (header.section_count != bank_section_count ||
      file.size() < sizeof(BankHeader) + bank_section_count * sizeof(BankSectionRecord)) {
    return damaged(name, "damaged: its directory of sections is incomplete");
  }
  return {};
}

Status check_directory(const Directory& directory, std::string_view name) {
  constexpr std::array<std::size_t, bank_section_count> element_sizes{
      sizeof(BankPart),      sizeof(PpfGrid),   sizeof(BankView),       sizeof(OrientedPoint),
      sizeof(std::uint32_t), sizeof(PpfEntry),  sizeof(std::uint32_t),  sizeof(std::uint32_t),
      sizeof(SurfacePoint),  sizeof(EdgePoint), sizeof(Vector3),        sizeof(std::uint64_t),
      sizeof(Vector3),       sizeof(Triangle),  sizeof(RigidTransform), sizeof(RigidTransform),
      sizeof(PartGrasp)};
  const std::uint64_t size = directory.file.size();
  for (std::size_t i = 0; i < bank_section_count; ++i) {
    const BankSectionRecord& record = directory.records[i];
    const bool expected = record.kind == static_cast<BankSection>(i) && record.element_size == element_sizes[i];
    if (!expected || record.offset % bank_alignment != 0 || record.offset > size ||
        record.count > (size - record.offset) / record.element_size) {
      return Status::format(StatusCode::bad_bank, "%.*s: damaged: section '%s' is misplaced; compile the bank again",
                            static_cast<int>(name.size()), name.data(), bank_section_name(static_cast<BankSection>(i)));
    }
  }
  return {};
}

template <class T>
std::span<const T> section(const Directory& directory, BankSection kind) {
  const BankSectionRecord& record = directory.records[static_cast<std::size_t>(kind)];
  return {reinterpret_cast<const T*>(directory.file.data() + record.offset), static_cast<std::size_t>(record.count)};
}

}  // namespace

Result<Bank> read_bank(std::span<const std::byte> bytes, std::string_view name) {
  if (Status status = check_header(bytes, name); !status.ok()) return status;
  Directory directory{bytes, {}};
  std::memcpy(static_cast<void*>(directory.records.data()), bytes.data() + sizeof(BankHeader),
              sizeof(directory.records));
  if (Status status = check_directory(directory, name); !status.ok()) return status;

  const auto parts = section<BankPart>(directory, BankSection::part);
  const auto grids = section<PpfGrid>(directory, BankSection::grid);
  if (parts.size() != 1 || grids.size() != 1) return damaged(name, "damaged: it does not hold exactly one part");

  Bank bank;
  bank.part = parts.data();
  bank.grid = grids.front();
  bank.views = section<BankView>(directory, BankSection::views);
  bank.view_points = section<OrientedPoint>(directory, BankSection::view_points);
  bank.cell_offsets = section<std::uint32_t>(directory, BankSection::cell_offsets);
  bank.entries = section<PpfEntry>(directory, BankSection::entries);
  bank.reference_points = section<std::uint32_t>(directory, BankSection::reference_points);
  bank.reference_views = section<std::uint32_t>(directory, BankSection::reference_views);
  bank.surface = section<SurfacePoint>(directory, BankSection::surface);
  bank.edges = section<EdgePoint>(directory, BankSection::edges);
  bank.visibility.directions = section<Vector3>(directory, BankSection::visibility_directions);
  bank.visibility.bits = section<std::uint64_t>(directory, BankSection::visibility_bits);
  bank.visibility.words_per_row = static_cast<std::uint32_t>(visibility_words(bank.surface.size()));
  bank.mesh = {section<Vector3>(directory, BankSection::mesh_vertices),
               section<Triangle>(directory, BankSection::mesh_triangles)};
  bank.symmetry_discrete = section<RigidTransform>(directory, BankSection::symmetry_discrete);
  bank.twins = section<RigidTransform>(directory, BankSection::twins);
  bank.grasps = section<PartGrasp>(directory, BankSection::grasps);

  if (const char* fault = find_bank_fault(bank); fault != nullptr) {
    return Status::format(StatusCode::bad_bank, "%.*s: damaged: %s; compile the bank again",
                          static_cast<int>(name.size()), name.data(), fault);
  }
  bank.mesh.closed = is_closed_outward(bank.mesh);
  return bank;
}

}  // namespace graspd
