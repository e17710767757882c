#pragma once

#include <string>

#include "core/status.hpp"
#include "core/train/bank_builder.hpp"
#include "drivers/files/conventions.hpp"

namespace graspd {

/// A part file as written by the integrator (configs/part.toml explains each key), in metres and radians.
struct PartFile {
  PartDescription part;   ///< Without the mesh.
  std::string mesh_path;  ///< Resolved against the part file's folder.
  LengthUnit mesh_unit = LengthUnit::millimetres;
  BankBuildParameters build;
  bool edges_given = false;     ///< The file itself says whether edges judge poses.
  bool sampling_given = false;  ///< The file itself says how the bank samples.
};

/// Reads a part file. Fails with bad_configuration: file, line, key, what is wrong and what is allowed.
[[nodiscard]] Result<PartFile> read_part_file(const std::string& path);

}  // namespace graspd
