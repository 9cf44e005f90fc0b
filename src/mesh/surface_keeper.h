// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "incise/geom/triangle_tree.h"
#include "incise/mesh/embedded_surface.h"
#include "incise/mesh/star.h"
#include "mesh/logged_array.h"
#include "mesh/near_tets.h"
#include "mesh/surface_division.h"
#include "mesh/tet_grid.h"

namespace incise {
inline namespace v0 {

/// The state of an embedded surface. The triangles that were given are `roots`, their edges are known once; what cuts
/// made of them is computed from the mesh as it stands, for those near what a step touched.
class EmbeddedSurface::Keeper final : private PointMaker {
 public:
  Keeper(FineSurface surface, const TetMesh& mesh, const Journal& journal);

  /// Binds all; returns the first point that lies further away than `most`, or none.
  std::uint32_t bind_all(const TetMesh& mesh, double most);
  Status follow(const Journal& journal, const TetMesh& mesh);

  [[nodiscard]] std::size_t position() const { return applied_ == 0 ? base_ : records_[applied_ - 1].position; }
  [[nodiscard]] std::uint64_t version() const { return version_; }
  [[nodiscard]] const std::vector<FinePoint>& points() const { return points_.items(); }
  [[nodiscard]] const std::vector<FineTriangle>& triangles() const { return triangles_.items(); }
  [[nodiscard]] const FineSurface& source() const { return surface_; }
  [[nodiscard]] const FineChanges& changes() const { return changes_; }
  [[nodiscard]] double greatest_distance() const { return greatest_distance_; }
  [[nodiscard]] double reach() const { return reach_; }
  [[nodiscard]] std::size_t looked_at() const { return looked_at_; }
  [[nodiscard]] const TetGrid& grid() const { return grid_; }
  [[nodiscard]] const TriangleTree& tree() const { return tree_; }
  [[nodiscard]] double extent() const { return (tree_.bounds().hi - tree_.bounds().lo).norm(); }

 private:
  struct Edge {
    std::uint32_t a = 0, b = 0;  // points; the place of a is the lower one, so that edges on a seam agree
    EdgeChain chain;
  };
  /// What a triangle has besides its parts.
  struct Root {
    std::vector<std::uint32_t> own_points;  // inside it, in the order in which they were made
  };
  /// What has become of an edge, before points are made of it.
  struct PlannedPoint {
    double t;
    Binding low, high;
    bool is_parted;
  };
  struct Record {
    std::uint64_t serial = 0;  // of the last step that it covers
    std::size_t position = 0;  // after it
    LoggedArray<FinePoint>::Log points;
    LoggedArray<FineTriangle>::Log triangles;
    LoggedArray<Edge>::Log edges;
    LoggedArray<Root>::Log roots;
    std::uint32_t free_point = kInvalidIndex, free_triangle = kInvalidIndex;  // on the other side
    std::vector<TetId> touched;
  };

  void list_edges();
  void make_normals();
  Status no_way(const Journal& journal) const;
  [[nodiscard]] bool find_common(const Journal& journal, std::size_t& common) const;
  void go_back();
  void go_forward();
  template <class Go>
  void restore(Record& record, Go&& go);
  void go_on(const Journal& journal, const TetMesh& mesh);
  void forget_trimmed(const Journal& journal);
  void begin();
  Record end();
  void note(const Record& record);
  void close_changes();

  [[nodiscard]] Box box_of(std::uint32_t root) const;
  void queue_near(const Box& box);
  void queue(std::uint32_t root);
  void work_queue(const TetMesh& mesh);
  void look_at(const TetMesh& mesh, std::uint32_t root);
  void place_corner(const TetMesh& mesh, std::uint32_t point);
  void part_edge(const TetMesh& mesh, std::uint32_t edge);
  void plan_edge(const TetMesh& mesh, std::uint32_t from, std::uint32_t to);
  [[nodiscard]] bool fits_plan(const EdgeChain& chain) const;
  EdgeChain make_chain(std::uint32_t from, std::uint32_t to);
  void rebind_chain(const EdgeChain& chain);
  void free_chain(const EdgeChain& chain);
  void rebuild_parts(std::uint32_t root);
  void replace_parts(std::uint32_t root);

  EdgeChain divide(std::uint32_t from, std::uint32_t to) override;
  std::array<std::uint32_t, 3> copy_to_middle(const std::array<std::uint32_t, 3>& points) override;

  std::uint32_t take_point(const FinePoint& point);
  void free_point(std::uint32_t slot);
  void rebind(std::uint32_t slot, const Binding& binding);
  std::uint32_t take_triangle(const FineTriangle& triangle);
  [[nodiscard]] FinePoint between(std::uint32_t from, std::uint32_t to, double t, const Binding& binding) const;

  FineSurface surface_;
  TriangleTree tree_;
  TetGrid grid_;
  NearTets near_;
  double mean_edge_, greatest_distance_ = 0, reach_ = 0;
  std::vector<double> reaches_;                         // by root: how far from it tets matter; at most reach_
  std::vector<std::array<std::uint32_t, 3>> edges_of_;  // by root: edges, from each corner to the next
  std::vector<std::uint32_t> first_root_, roots_of_;    // of each edge, as a list of lists

  LoggedArray<FinePoint> points_;
  LoggedArray<FineTriangle> triangles_;
  LoggedArray<Edge> edges_;
  LoggedArray<Root> roots_;
  std::uint32_t free_point_ = kInvalidIndex, free_triangle_ = kInvalidIndex;  // heads of lists

  std::size_t base_ = 0, applied_ = 0;
  std::uint64_t base_serial_ = 0;
  std::deque<Record> records_;  // those from applied_ on are undone
  std::uint64_t version_ = 1;
  bool has_changed_ = false;
  std::size_t looked_at_ = 0;
  FineChanges changes_, next_changes_;  // of the last `follow` that changed anything; of the one that runs

  // Scratch of one `follow`.
  std::vector<std::uint32_t> queue_;
  std::vector<std::uint64_t> root_marks_, edge_marks_, point_marks_;  // the batch that met them
  std::uint64_t batch_ = 0;
  const TetMesh* mesh_ = nullptr;
  StarWalker walker_;
  std::vector<WallCrossing> crossings_;
  std::vector<PlannedPoint> plan_;
  std::vector<FineTriangle> parts_;
  std::vector<std::uint32_t> new_points_;  // of the root that is looked at
};

}  // namespace v0
}  // namespace incise
