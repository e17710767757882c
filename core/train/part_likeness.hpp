#pragma once

#include <string>
#include <vector>

#include "core/status.hpp"
#include "core/train/symmetry_group.hpp"

namespace graspd {

struct PartDescription;
struct PartMesh;

/// How far a part looks like itself in other poses.
struct PartLikeness {
  SymmetryGroup symmetry;
  bool proposed = false;              ///< The symmetries were found on the mesh, not given.
  std::vector<RigidTransform> twins;  ///< As find_twins() tells; without the symmetries.
  std::vector<std::string> remarks;   ///< Lines worth showing.
};

/// The symmetries and twins that the part's description gives, or those found on its mesh. Fails with
/// bad_configuration when the symmetries given turn the part far away from itself.
[[nodiscard]] Result<PartLikeness> likeness_of(const PartDescription& part, const PartMesh& mesh);

}  // namespace graspd
