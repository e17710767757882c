#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "tests/fuzz/fuzz_target.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes read_seed(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// One of the damages that files and messages suffer: cut short, bits flipped, bytes overwritten, a piece doubled.
Bytes damaged(Bytes bytes, std::mt19937& random) {
  if (bytes.empty()) return bytes;
  const auto place = [&] { return static_cast<std::ptrdiff_t>(random() % bytes.size()); };
  switch (random() % 4) {
    case 0:
      bytes.resize(static_cast<std::size_t>(place()));
      break;
    case 1:
      bytes[static_cast<std::size_t>(place())] ^= static_cast<std::uint8_t>(1U << random() % 8U);
      break;
    case 2:
      for (std::uint32_t i = 0; i < 1 + random() % 4; ++i) {
        bytes[static_cast<std::size_t>(place())] = static_cast<std::uint8_t>(random());
      }
      break;
    default: {
      const Bytes piece(bytes.begin() + place(), bytes.end());
      bytes.insert(bytes.begin() + place(), piece.begin(),
                   piece.begin() + std::min<std::ptrdiff_t>(32, std::ssize(piece)));
    }
  }
  return bytes;
}

}  // namespace

/// Feeds every seed of a folder, and a fixed number of damaged copies of each, to the target.
int main(int argc, char** argv) {
  constexpr int damaged_copies = 200;
  if (argc != 2) return 2;
  std::vector<std::filesystem::path> seeds;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) seeds.push_back(entry.path());
  std::sort(seeds.begin(), seeds.end());
  std::mt19937 random(1);
  for (const auto& seed : seeds) {
    const Bytes bytes = read_seed(seed);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    for (int copy = 0; copy < damaged_copies; ++copy) {
      const Bytes input = damaged(bytes, random);
      LLVMFuzzerTestOneInput(input.data(), input.size());
    }
  }
  std::printf("%zu seeds replayed\n", seeds.size());
  return seeds.empty() ? 1 : 0;
}
