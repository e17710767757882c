#include "firmware_app/loaded_banks.hpp"

#include <utility>

namespace graspd {

std::size_t LoadedBanks::bytes() const {
  std::size_t total = 0;
  for (const ResidentFile& file : files) total += file.bytes().size();
  return total;
}

Result<LoadedBanks> load_banks(std::span<const std::string> paths) {
  LoadedBanks loaded;
  for (const std::string& path : paths) {
    Result<ResidentFile> file = ResidentFile::open(path);
    if (!file.ok()) return file.status();
    const Result<Bank> bank = read_bank(file.value().bytes(), path);
    if (!bank.ok()) return bank.status();
    for (std::size_t i = 0; i < loaded.banks.size(); ++i) {
      if (loaded.banks[i].part->part_id != bank.value().part->part_id) continue;
      return Status::format(StatusCode::bad_bank,
                            "%s: is of part number %u, as is %s; give one of the parts another id and compile it again",
                            path.c_str(), bank.value().part->part_id, loaded.paths[i].c_str());
    }
    loaded.paths.push_back(path);
    loaded.files.push_back(std::move(file).value());
    loaded.banks.push_back(bank.value());
  }
  return loaded;
}

}  // namespace graspd
