#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/bank/bank.hpp"
#include "core/bank/bank_check.hpp"
#include "tests/core/bank/small_bank.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(std::span<const std::byte> file) {
  const auto bank = read_bank(file, "part.bank");
  EXPECT_EQ(bank.status().code(), StatusCode::bad_bank);
  const std::string message(bank.status().message());
  EXPECT_THAT(message, StartsWith("part.bank: "));
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message;
}

std::string refusal_of_contents(const SmallBank& bank) { return refusal(bank.file()); }

/// The place of a section's record in the file.
std::size_t record_at(BankSection section) {
  return sizeof(BankHeader) + static_cast<std::size_t>(section) * sizeof(BankSectionRecord);
}

template <class T>
void put(std::vector<std::byte>& file, std::size_t at, T value) {
  std::memcpy(file.data() + at, &value, sizeof(value));
}

TEST(BankFile, ComesBackAsItWasWritten) {
  const SmallBank small;
  const std::vector<std::byte> file = small.file();
  const auto result = read_bank(file, "part.bank");
  ASSERT_TRUE(result.ok()) << result.status().message();
  const Bank& bank = result.value();
  EXPECT_EQ(bank.part->name_view(), "tetrahedron");
  EXPECT_EQ(bank.part->part_id, 7U);
  EXPECT_EQ(bank.views.size(), 2U);
  EXPECT_EQ(bank.views[1].first_point, 3U);
  EXPECT_EQ(bank.view_points.size(), 5U);
  EXPECT_EQ(bank.entries[2].alpha(), 255U);
  EXPECT_EQ(bank.entries[2].reference(), 2U);
  EXPECT_EQ(bank.cell_offsets.size(), 17U);
  EXPECT_EQ(bank.visibility.words_per_row, 2U);
  EXPECT_EQ(bank.visibility.row(Vector3(0.1F, 0, 5))[0], 3U);
  EXPECT_EQ(bank.visibility.row(Vector3(0.1F, 0, 0.05F))[1], 2U);
  EXPECT_EQ(bank.mesh.triangles[3], (Triangle{1, 2, 3}));
  EXPECT_TRUE(bank.mesh.closed);
  EXPECT_EQ(bank.symmetry_discrete.size(), 2U);
  EXPECT_EQ(bank.grasps.size(), 1U);
  for (std::size_t s = 0; s < bank_section_count; ++s) {
    BankSectionRecord record;
    std::memcpy(static_cast<void*>(&record), file.data() + record_at(static_cast<BankSection>(s)), sizeof(record));
    EXPECT_EQ(record.offset % bank_alignment, 0U);
  }
}

TEST(BankFile, TheSameBankGivesTheSameBytes) { EXPECT_EQ(SmallBank().file(), SmallBank().file()); }

TEST(BankFile, EveryTruncationIsRefused) {
  const std::vector<std::byte> file = SmallBank().file();
  for (std::size_t size = 0; size < file.size(); ++size) {
    const std::string message = refusal(std::span(file).first(size));
    const std::string expected = size < 8                    ? "not a graspd bank"
                                 : size < sizeof(BankHeader) ? "truncated inside its header"
                                                             : "truncated: " + std::to_string(size) + " of ";
    EXPECT_THAT(message, HasSubstr(expected));
  }
}

TEST(BankFile, ATruncationThatTheHeaderHidesIsRefusedAtEverySection) {
  const std::vector<std::byte> whole = SmallBank().file();
  for (std::size_t s = 0; s < bank_section_count; ++s) {
    BankSectionRecord record;
    std::memcpy(static_cast<void*>(&record), whole.data() + record_at(static_cast<BankSection>(s)), sizeof(record));
    for (const std::uint64_t size : {record.offset, record.offset + record.element_size * record.count - 1}) {
      std::vector<std::byte> file(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      put(file, offsetof(BankHeader, file_size), size);
      seal(file);
      EXPECT_THAT(refusal(file), HasSubstr("is misplaced")) << s;
    }
  }
}

TEST(BankFile, EveryFlippedBitIsRefused) {
  std::vector<std::byte> file = SmallBank().file();
  for (std::size_t at = 0; at < file.size(); ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      file[at] ^= std::byte{1} << bit;
      ASSERT_FALSE(read_bank(file, "part.bank").ok()) << at << " bit " << bit;
      file[at] ^= std::byte{1} << bit;
    }
  }
  file[file.size() - 5] ^= std::byte{4};
  EXPECT_THAT(refusal(file), HasSubstr("its checksum does not match its contents"));
}

TEST(BankFile, ForeignFilesAreToldApart) {
  const std::vector<std::byte> good = SmallBank().file();
  std::vector<std::byte> file = good;
  file[0] = std::byte{'P'};
  EXPECT_THAT(refusal(file), HasSubstr("not a graspd bank"));

  file = good;
  put(file, offsetof(BankHeader, version), bank_version + 1);
  EXPECT_THAT(refusal(file),
              HasSubstr("bank version " + std::to_string(bank_version + 1) + ", this graspd reads version " +
                        std::to_string(bank_version) + "; compile the bank again"));

  file = good;
  put(file, offsetof(BankHeader, byte_order), bank_byte_order_swapped);
  EXPECT_THAT(refusal(file), HasSubstr("written on a machine of the other byte order"));

  file = good;
  file.push_back(std::byte{0});
  EXPECT_THAT(refusal(file), HasSubstr("longer than its header says"));

  EXPECT_THAT(refusal({}), HasSubstr("not a graspd bank"));
}

TEST(BankFile, ADirectoryThatLiesIsRefused) {
  const std::vector<std::byte> good = SmallBank().file();
  const auto changed = [&](std::size_t field, auto value) {
    std::vector<std::byte> file = good;
    put(file, record_at(BankSection::entries) + field, value);
    seal(file);
    return refusal(file);
  };
  const auto misplaced = HasSubstr("section 'entries' is misplaced");
  EXPECT_THAT(changed(offsetof(BankSectionRecord, kind), std::uint32_t{3}), misplaced);
  EXPECT_THAT(changed(offsetof(BankSectionRecord, element_size), std::uint32_t{8}), misplaced);
  EXPECT_THAT(changed(offsetof(BankSectionRecord, element_size), std::uint32_t{0}), misplaced);
  EXPECT_THAT(changed(offsetof(BankSectionRecord, offset), std::uint64_t{65}), misplaced);
  EXPECT_THAT(changed(offsetof(BankSectionRecord, offset), ~std::uint64_t{63}), misplaced);
  EXPECT_THAT(changed(offsetof(BankSectionRecord, count), ~std::uint64_t{0}), misplaced);
  EXPECT_THAT(changed(offsetof(BankSectionRecord, count), std::uint64_t{1} << 62U), misplaced);
}

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// One thing wrong with the contents of a bank whose checksum is right.
struct Fault {
  const char* text;
  void (*spoil)(SmallBank&);
};

class BankContents : public testing::TestWithParam<Fault> {};

TEST(BankFile, WithMoreSymmetriesThanThereIsRoomForIsRefused) {
  const SmallBank bank;
  Bank many = bank.view();
  const std::vector<RigidTransform> alike(most_symmetries + 1);
  many.symmetry_discrete = alike;
  EXPECT_THAT(find_bank_fault(many), HasSubstr("more symmetries"));
  many.symmetry_discrete = std::span(alike).first(most_symmetries);
  EXPECT_EQ(find_bank_fault(many), nullptr);
}

TEST_P(BankContents, AreRefusedWithTheirFault) {
  SmallBank bank;
  GetParam().spoil(bank);
  EXPECT_THAT(refusal_of_contents(bank), HasSubstr(GetParam().text));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, BankContents,
    testing::Values(Fault{"name has no end", [](SmallBank& b) { b.part.name.fill('x'); }},
                    Fault{"measures", [](SmallBank& b) { b.part.diameter = 0; }},
                    Fault{"measures", [](SmallBank& b) { b.part.sampling = not_a_number; }},
                    Fault{"measures", [](SmallBank& b) { b.part.centre.x() = not_a_number; }},
                    Fault{"contradict each other", [](SmallBank& b) { b.part.sampling = 1e-30F; }},
                    Fault{"detail contradict", [](SmallBank& b) { b.part.detail = 2.0F * b.part.sampling; }},
                    Fault{"detail contradict", [](SmallBank& b) { b.part.detail = not_a_number; }},
                    Fault{"contradict each other", [](SmallBank& b) { b.part.sampling = 2.0F * b.part.diameter; }},
                    Fault{"impossibly small or large", [](SmallBank& b) { b.part.diameter = 1e30F; }},
                    Fault{"impossibly small or large", [](SmallBank& b) { b.part.diameter = 5e-5F; }},
                    Fault{"symmetry axis", [](SmallBank& b) { b.part.symmetry_axis.direction *= 2; }},
                    Fault{"symmetry axis", [](SmallBank& b) { b.part.symmetry_continuous = 2; }},
                    Fault{"threshold", [](SmallBank& b) { b.part.thresholds.minimum_score = not_a_number; }},
                    Fault{"edges are used", [](SmallBank& b) { b.part.edges_refine = 2; }},
                    Fault{"edges are used", [](SmallBank& b) { b.part.edges_judge = 2; }},
                    Fault{"expected", [](SmallBank& b) { b.part.expected.precision = not_a_number; }},
                    Fault{"expected", [](SmallBank& b) { b.part.expected.recall_below_half = 1.5F; }},
                    Fault{"no distance step", [](SmallBank& b) { b.grid.distance_step = -1; }},
                    Fault{"does not suit", [](SmallBank& b) { b.grid.distance_step = 1e-30F; }},
                    Fault{"does not suit", [](SmallBank& b) { b.grid.distance_step = 1e30F; }},
                    Fault{"impossible number of cells", [](SmallBank& b) { b.grid.angle_bins = 0; }},
                    Fault{"impossible number of cells", [](SmallBank& b) { b.grid.distance_bins = 0xFFFFFFFFU; }},
                    Fault{"does not fit its grid", [](SmallBank& b) { b.grid.distance_bins = 3; }},
                    Fault{"offsets are out of order", [](SmallBank& b) { b.cell_offsets[3] = 4; }},
                    Fault{"offsets are out of order", [](SmallBank& b) { b.cell_offsets[16] = 5; }},
                    Fault{"offsets are out of order", [](SmallBank& b) { b.cell_offsets[0] = 1; }},
                    Fault{"does not follow", [](SmallBank& b) { b.views[1].first_point = 4; }},
                    Fault{"does not follow", [](SmallBank& b) { b.views[0].reference_count = 4; }},
                    Fault{"does not follow", [](SmallBank& b) { b.views[1].direction.x() = not_a_number; }},
                    Fault{"reaches beyond its points", [](SmallBank& b) { b.views[1].point_count = 3; }},
                    Fault{"reaches beyond its points", [](SmallBank& b) { b.views[1].reference_count = 2; }},
                    Fault{"points belong to no view", [](SmallBank& b) { b.views[1].point_count = 1; }},
                    Fault{"another point or view", [](SmallBank& b) { b.reference_points[1] = 4000000; }},
                    Fault{"another point or view", [](SmallBank& b) { b.reference_views[2] = 2; }},
                    Fault{"reference that is not there", [](SmallBank& b) { b.entries[3] = PpfEntry::pack(3, 0); }},
                    Fault{"out of order", [](SmallBank& b) { std::swap(b.entries[0], b.entries[1]); }},
                    Fault{"view point", [](SmallBank& b) { b.view_points[4].position.y() = not_a_number; }},
                    Fault{"view point", [](SmallBank& b) { b.view_points[4].normal.setZero(); }},
                    Fault{"surface", [](SmallBank& b) { b.surface[69].normal.x() = not_a_number; }},
                    Fault{"edge point", [](SmallBank& b) { b.edges[1].tangent.setZero(); }},
                    Fault{"direction of the visibility table", [](SmallBank& b) { b.directions[0] *= 2; }},
                    Fault{"directions of the visibility table are out of order",
                          [](SmallBank& b) { std::swap(b.directions[0], b.directions[1]); }},
                    Fault{"points that are not there", [](SmallBank& b) { b.bits[3] = std::uint64_t{1} << 6U; }},
                    Fault{"vertex of its mesh", [](SmallBank& b) { b.vertices[2].z() = not_a_number; }},
                    Fault{"vertex that is not there", [](SmallBank& b) { b.triangles[1][2] = 4; }},
                    Fault{"begin with the identity", [](SmallBank& b) { b.symmetries[0] = b.symmetries[1]; }},
                    Fault{"a symmetry is not", [](SmallBank& b) { b.symmetries[1].rotation *= 1.1F; }},
                    Fault{"a twin is not", [](SmallBank& b) { b.twins[0].translation.x() = 1e20F; }},
                    Fault{"too far from its origin", [](SmallBank& b) { b.part.centre.x() = 1e20F; }},
                    Fault{"a view point is not", [](SmallBank& b) { b.view_points[1].position.y() = 1e30F; }},
                    Fault{"a twin is not", [](SmallBank& b) { b.twins[0].rotation *= 1.1F; }},
                    Fault{"a symmetry is not", [](SmallBank& b) { b.symmetries[1].rotation.col(0) *= -1.0F; }},
                    Fault{"a grasp is of no known kind", [](SmallBank& b) { b.grasps[0].opening = not_a_number; }}));

TEST(BankContents, SectionsThatMustNotBeEmpty) {
  const SmallBank small;
  const auto fault = [](const Bank& bank) { return refusal(write_bank(bank)); };
  Bank bank = small.view();
  bank.views = {};
  EXPECT_THAT(fault(bank), HasSubstr("it holds no views"));
  bank = small.view();
  bank.surface = {};
  EXPECT_THAT(fault(bank), HasSubstr("the surface"));
  bank = small.view();
  bank.visibility.directions = {};
  EXPECT_THAT(fault(bank), HasSubstr("visibility table does not fit"));
  bank = small.view();
  bank.visibility.bits = std::span(small.bits).first(3);
  EXPECT_THAT(fault(bank), HasSubstr("visibility table does not fit"));
  bank = small.view();
  bank.mesh.triangles = {};
  EXPECT_THAT(fault(bank), HasSubstr("its mesh has no faces"));
  bank = small.view();
  bank.symmetry_discrete = {};
  EXPECT_THAT(fault(bank), HasSubstr("identity"));
  bank = small.view();
  bank.cell_offsets = {};
  EXPECT_THAT(fault(bank), HasSubstr("does not fit its grid"));
  bank = small.view();
  bank.edges = {};
  bank.grasps = {};
  EXPECT_TRUE(read_bank(write_bank(bank), "part.bank").ok());
}

}  // namespace
}  // namespace graspd
