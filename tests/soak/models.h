// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "incise/mesh/tet_mesh.h"

namespace incise::test {

/// The real meshes of $INCISE_CORPUS, by name; none where it is not set.
std::vector<std::filesystem::path> corpus_files();

/// A mesh as points and tets again, slots without gaps.
TetSoup to_soup(const TetMesh& mesh);

}  // namespace incise::test
