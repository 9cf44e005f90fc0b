// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::bench {

/// The floor under the cost of a step: writes the bytes that a step has written, and does nothing else. The records of
/// its journal steps go to memory that was not used before, as a journal's do, and the slots that they name get their
/// values in arrays as large as the mesh's.
class FloorKernel {
 public:
  /// Arrays for a mesh as large as this one, their pages touched.
  explicit FloorKernel(const TetMesh& mesh);

  /// Writes what the journal's steps [from, to) wrote. Their slots must be within what the mesh had when the kernel was
  /// made, or are left out.
  void write(const Journal& journal, std::size_t from, std::size_t to, const TetMesh& mesh);
  /// Bytes of journal records written so far.
  [[nodiscard]] std::size_t journal_bytes() const { return journal_bytes_; }
  /// Forgets the records written, as an undo does.
  void forget() { records_.clear(); }

 private:
  template <class... Lists>
  void keep(const Lists&... lists);
  void set_tet(const TetMesh& mesh, TetId tet);
  void set_vertex(const TetMesh& mesh, VertexId vertex);

  std::vector<std::unique_ptr<std::byte[]>> records_;
  std::vector<TetVertices> vertices_;
  std::vector<TetLinks> links_;
  std::vector<std::int32_t> regions_;
  std::vector<std::uint32_t> generations_;
  std::vector<Vec3> rest_, current_;
  std::vector<TetId> tet_of_;
  std::vector<VertexId> origins_;
  std::vector<std::uint8_t> shapes_;
  std::size_t journal_bytes_ = 0;
};

}  // namespace incise::bench
