// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cut/edge_table.h"
#include "cut/sheet_crossing.h"
#include "cut/split_template.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// An edge of the closed complex, with what the blade did to it. `a` has the lower slot.
struct ClosedEdge {
  VertexId a, b;
  double t = 0.5;                           ///< where the blade's sheet crosses it, from a to b
  Vec3 position = Vec3::Zero();             ///< of that place
  Vec3 normal = Vec3::Zero();               ///< unit, of the sheet there
  double travel = 0;                        ///< of the blade up to there, in its sheet
  VertexId split;                           ///< the vertex that splits it, while there is one
  std::array<VertexId, 2> halves;           ///< its copies towards a and towards b
  std::uint32_t first_use = kInvalidIndex;  ///< master · 6 + edge number: the masters that have it, as a list
  std::uint32_t tested = 0;                 ///< the step that last looked at it
  bool is_crossed = false;                  ///< an odd number of times
  bool is_blocked = false;                  ///< dividing it would make a tet that is not sound: counts as not crossed

  [[nodiscard]] bool is_flagged() const { return is_crossed && !is_blocked; }
};

/// Where the border of the blade's sheet pierces a face: the cut ends there.
struct FrontPoint {
  Vec3 position = Vec3::Zero();
  std::array<double, 3> weights{};  ///< of the vertices of `face`: where the border pierces it, before any rounding off
  Vec3 pierced = Vec3::Zero();      ///< the place at these weights, when it was found
  std::array<double, 3> slide{};    ///< by what these change along the sheet in the face, per unit of mean edge
  std::array<VertexId, 3> face;     ///< ascending: seen alike from both sides
  VertexId vertex;                  ///< once made
  std::uint32_t tested = 0;         ///< the step that last looked at it
  bool is_explained = false;        ///< pierced, not guessed
  bool is_final = false;            ///< the blade has gone: it stays where it is
  std::array<std::uint32_t, 2> masters{kInvalidIndex, kInvalidIndex};  ///< on either side of the face
};

/// A tet of the closed complex: as it was before the blade came.
struct Master {
  static constexpr std::uint32_t kNone = kInvalidIndex;

  TetVertices vertices;                   ///< closed
  std::array<std::uint32_t, 6> edges;     ///< by edge number
  std::array<std::uint32_t, 6> next_use;  ///< by edge number: the next master that has it, see `first_use`
  std::array<std::uint32_t, 4> behind;    ///< the master behind each side, where there is one
  std::array<std::uint32_t, 4> points;    ///< the front point in each side, where there is one
  VertexId middle;                        ///< the front point inside, once made
  Vec3 corner = Vec3::Zero();             ///< where the border of the sheet turns inside, if it does
  std::uint64_t corner_key = 0;           ///< of that point; 0 for none
  const SplitTemplate* split = nullptr;   ///< how it is divided now
  std::uint32_t first_child = 0;          ///< into `ClosedComplex::children`
  std::uint32_t mark = 0;                 ///< scratch of one stage at a time
  std::uint32_t seen = 0;                 ///< the step in which the blade last met it
  std::uint32_t first_met = 0;            ///< the step in which the blade first met it
  std::uint32_t missed = 0;               ///< the step in which the blade was last found to pass it by
  std::uint8_t flagged = 0;               ///< bit e: edge e is flagged
  std::uint8_t on = 0;                    ///< bit c: corner c takes part in the cut itself
  std::uint32_t entry = 0;                ///< its number among the dirty ones while a rebuild runs
  bool is_dirty = false;                  ///< its children must be made anew
  bool is_kept = false;                   ///< a rebuild found nothing to change about its children
  bool is_cut = false;                    ///< the blade has crossed an edge of it
  bool has_latent_faces = false;          ///< incision faces that nothing separates, left joined
  bool is_pinched = false;                ///< has incision faces that were left joined beside an edge
  bool is_behind = false;                 ///< the blade's front has left it behind
  bool is_settled = false;                ///< nothing about it changes any more, nor about its vertices

  [[nodiscard]] bool is_divided() const { return split->children.size() > 1; }
};

/// The rest shape around a blade as if it were not cut yet, tet by tet, with the tets of the mesh that stand for it.
///
/// A master is a tet that was whole when the blade reached it; its children are the live tets that it is divided into,
/// at first itself. A closed vertex is one whose copies count as one: the mesh's own vertices before the stroke, split
/// points of edges and front points. The blade's doings are kept on the edges of masters, where neighbours agree by
/// construction; children are made from them. Whatever the mesh does physically, this complex stays closed.
/// It is a band around the blade's front: behind it masters are settled, then let go one by one, and their children
/// become ordinary tets, which no rule of the cut knows how to join again. `clear` lets go of all.
class ClosedComplex {
 public:
  /// `templates` must outlive the complex.
  explicit ClosedComplex(SplitTemplates& templates) : whole_(templates.find({})) {}

  void clear();

  /// All that a complex knows, apart from it. Memory: O(masters).
  class Image;
  [[nodiscard]] Image image() const;
  /// Takes over an image; the complex must be clear, and `mesh` as it was then, by the ids that the image names.
  /// Cost: O(masters).
  void restore(const Image& image, const TetMesh& mesh);

  /// Whether the body moves. Then every master that the blade is still in has a front point inside, which carries what
  /// the body does within it (docs/decisions/0167), and rims of older cuts do not take part (0172).
  void set_in_motion(bool is_in_motion) { is_in_motion_ = is_in_motion; }
  [[nodiscard]] bool is_in_motion() const { return is_in_motion_; }

  /// The master that a live tet belongs to, or `Master::kNone`.
  [[nodiscard]] std::uint32_t find(TetId tet) const {
    const std::uint32_t index = tet.value < master_of_.capacity() ? master_of_[tet.value] : 0;
    return index - 1;
  }
  /// The master of a live tet; where there is none, the tet becomes one.
  std::uint32_t adopt(const TetMesh& mesh, TetId tet);
  /// Lets go of a master: its children become ordinary tets. A vertex, an edge or a front point that no other master
  /// has is forgotten with it: its copies are vertices of their own. Its index is used again. Cost: O(1).
  void release(std::uint32_t master);

  /// One past the greatest index of a master; those let go have no `split`.
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(masters_.size()); }
  /// How many there are.
  [[nodiscard]] std::size_t master_count() const { return masters_.size() - free_masters_.size(); }
  Master& operator[](std::uint32_t index) { return masters_[index]; }
  const Master& operator[](std::uint32_t index) const { return masters_[index]; }
  [[nodiscard]] std::span<const TetId> children(const Master& master) const {
    return {children_.data() + master.first_child, master.split->children.size()};
  }
  /// Divides a master anew: `tets` are its children, one for each of the template's.
  void set_children(std::uint32_t master, const SplitTemplate& split, std::span<const TetId> tets);
  /// The mesh's side that stands for the k-th facet of a side of a master.
  [[nodiscard]] Side facet(const Master& master, unsigned side, std::size_t k) const {
    return facet(master, master.split->outer[side][k]);
  }
  [[nodiscard]] Side facet(const Master& master, SplitTemplate::ChildSide side) const {
    return {children_[master.first_child + side / 4U], side & 3U};
  }

  BasicEdgeTable<ClosedEdge>& edges() { return edges_; }
  [[nodiscard]] const BasicEdgeTable<ClosedEdge>& edges() const { return edges_; }
  [[nodiscard]] const ClosedEdge& edge(const Master& master, unsigned a, unsigned b) const {
    return edges_[master.edges[kEdgeOfCorners[a][b]]];
  }

  std::uint32_t add_point(const FrontPoint& point);
  FrontPoint& point(std::uint32_t index) { return points_[index]; }
  [[nodiscard]] const FrontPoint& point(std::uint32_t index) const { return points_[index]; }
  void remove_point(std::uint32_t index);

  /// Has a closed vertex, which nothing needs any more, die with the next rebuild.
  void retire(VertexId vertex) { retired_.push_back(vertex); }
  [[nodiscard]] std::vector<VertexId>& retired() { return retired_; }

  /// The closed vertex that a vertex is a copy of, or itself.
  [[nodiscard]] VertexId closed(VertexId vertex) const {
    const std::uint32_t original = vertex.value < closed_.capacity() ? closed_[vertex.value] : 0;
    return original == 0 ? vertex : VertexId(original - 1);
  }
  [[nodiscard]] unsigned closed_corner(const TetMesh& mesh, TetId tet, VertexId vertex) const {
    const TetVertices& corners = mesh.vertices(tet);
    unsigned corner = 0;
    while (corner < 4 && closed(corners[corner]) != vertex) {
      ++corner;
    }
    return corner;
  }
  /// The copies of a closed vertex, itself not among them.
  [[nodiscard]] std::vector<VertexId>& copies_of(VertexId vertex);
  [[nodiscard]] bool has_copies(VertexId vertex) const {
    return vertex.value < copies_.capacity() && copies_[vertex.value] != 0;
  }
  void add_copy(VertexId vertex, VertexId copy);
  /// Blocks an edge: it counts as not crossed from now on.
  void block(std::uint32_t edge);
  /// Forgets the copies of a closed vertex.
  void drop_copies(VertexId vertex);

  /// Has a master's children made anew by the next rebuild.
  void mark_dirty(std::uint32_t master) {
    if (masters_[master].is_dirty) return;
    masters_[master].is_dirty = true;
    dirty_.push_back(master);
  }
  /// The masters to be rebuilt, each once.
  [[nodiscard]] std::vector<std::uint32_t>& dirty() { return dirty_; }
  /// Notes that the sheet crosses an edge once more, or takes it back.
  void toggle(std::uint32_t edge);
  /// Makes a master's flags those of its edges.
  void refresh_flags(std::uint32_t master);
  /// How many flagged edges a closed vertex has.
  [[nodiscard]] std::uint32_t flagged_at(VertexId vertex) const {
    return vertex.value < flagged_at_.capacity() ? flagged_at_[vertex.value] : 0;
  }

  /// Gives a corner of masters another name, as which it goes by from now on: it is none yet. `star`: all masters that
  /// have it. It keeps its rank. Cost: O(star).
  void rename(VertexId from, VertexId to, std::span<const std::uint32_t> star);
  /// Whether `star` are all masters that have a corner, and none around it was let go.
  [[nodiscard]] bool is_known_around(VertexId vertex, std::span<const std::uint32_t> star) const {
    return !is_half_baked(vertex) && count_at_[vertex.value] == star.size();
  }
  /// The place of a corner in an order of all of them, by which neighbours divide a common face alike: its slot, or
  /// that of its first name.
  [[nodiscard]] std::uint64_t rank(VertexId vertex) const {
    const std::uint64_t rank = vertex.value < rank_.capacity() ? rank_[vertex.value] : 0;
    return rank != 0 ? rank - 1 : vertex.value;
  }

  /// A master that has a closed vertex, or `Master::kNone`.
  [[nodiscard]] std::uint32_t master_at(VertexId vertex) const {
    const std::uint32_t index = vertex.value < master_at_.capacity() ? master_at_[vertex.value] - 1 : Master::kNone;
    return index < masters_.size() && masters_[index].split != nullptr ? index : Master::kNone;
  }

  /// Notes that nothing about a closed vertex changes any more: it has landed, and tets around it may have been let go.
  /// No strip of this sheet may pass through a tet that has it.
  void settle(VertexId vertex);
  [[nodiscard]] bool is_settled(VertexId vertex) const {
    return vertex.value < is_settled_.capacity() && is_settled_[vertex.value] != 0;
  }
  /// Whether a master has a vertex around which others were let go: it cannot be made anew any more.
  [[nodiscard]] bool is_half_baked(std::uint32_t master) const {
    const auto& v = masters_[master].vertices;
    return std::any_of(v.begin(), v.end(), [&](VertexId vertex) { return is_half_baked(vertex); });
  }
  /// Whether masters around a vertex were let go, and others not.
  [[nodiscard]] bool is_half_baked(VertexId vertex) const {
    return is_settled(vertex) && is_settled_[vertex.value] == kHalfBaked;
  }
  /// Marks all vertices that a master knows by name, and their copies: none of them may die while it lives. Notes which
  /// tets that were let go have one that the cut made.
  void hold_vertices(const TetMesh& mesh);
  /// Whether a live tet has a vertex that was held when `hold_vertices` was called last.
  [[nodiscard]] bool is_held(const TetMesh& mesh, TetId tet) const {
    const TetVertices& v = mesh.vertices(tet);
    return std::any_of(v.begin(), v.end(), [&](VertexId vertex) {
      return vertex.value < held_.capacity() && held_[vertex.value] == hold_;
    });
  }
  /// Whether a live tet that is no master's has a settled vertex, or one that a master has as a split point or a front
  /// point: it was let go beside that master, and none of its corners need be settled.
  [[nodiscard]] bool is_at_settled(const TetMesh& mesh, TetId tet) const {
    const TetVertices& v = mesh.vertices(tet);
    const auto is_at = [&](VertexId vertex) { return is_settled(closed(vertex)) || is_made(vertex); };
    return is_at(v[0]) || is_at(v[1]) || is_at(v[2]) || is_at(v[3]);
  }

  [[nodiscard]] bool is_on(VertexId vertex) const {
    return vertex.value < is_on_.capacity() && is_on_[vertex.value] != 0;
  }
  void set_on(VertexId vertex);

  /// Calls `visit(master index)` for the masters that have an edge, whether or not they share faces around it.
  template <class Visit>
  void for_each_around(std::uint32_t edge, Visit&& visit) const;

  /// All masters around a vertex; live tets that share faces with them there become masters, too. `master` has the
  /// vertex. Cost: O(star), and O(masters) where tets touch at the vertex without sharing faces. Valid until the next
  /// call.
  const std::vector<std::uint32_t>& star(const TetMesh& mesh, std::uint32_t master, VertexId vertex);

  /// The live tet behind a side of a master that has no master behind it, or the boundary.
  [[nodiscard]] Link outside(const TetMesh& mesh, const Master& master, unsigned side) const {
    return mesh.link(facet(master, side, 0));
  }

 private:
  void forget(VertexId vertex);
  void rename_edge(std::uint32_t index, VertexId from, VertexId to);
  void rename_point(FrontPoint& point, VertexId from, VertexId to);
  void retire_rank(VertexId vertex);
  void flood_star(const TetMesh& mesh, VertexId vertex, std::size_t from);
  /// Whether a master had a vertex as a split point or a front point when `hold_vertices` was called last, or a tet
  /// that was let go has both.
  [[nodiscard]] bool is_made(VertexId vertex) const {
    return vertex.value < made_.capacity() && made_[vertex.value] == hold_;
  }
  template <class Visit>
  void for_each_copy(VertexId vertex, Visit&& visit);
  void hold(VertexId vertex);
  void hold_made(VertexId vertex);
  void mark_beside_made(const TetMesh& mesh);
  void unlink_edge(std::uint32_t master, unsigned e);
  void unlink_point(std::uint32_t master, unsigned side);
  void unlink_vertex(std::uint32_t master, unsigned corner);
  std::uint32_t take_block(std::size_t count);
  void count_flag(const ClosedEdge& edge, bool is_flagged);
  void link(std::uint32_t master, unsigned side, const TetMesh& mesh);
  [[nodiscard]] unsigned side_with(const Master& master, const TetMesh& mesh, Side facet) const;

  const SplitTemplate& whole_;
  GrowArray<Master> masters_;
  GrowArray<TetId> children_;
  std::array<std::vector<std::uint32_t>, 32> free_blocks_;  // of `children_`, by size
  GrowArray<FrontPoint> points_;
  std::vector<std::uint32_t> free_points_;
  BasicEdgeTable<ClosedEdge> edges_;
  ZeroedArray<std::uint32_t> master_of_;  // by tet slot: 1 + master
  ZeroedArray<std::uint32_t> closed_;     // by vertex slot: 1 + the closed vertex that it is a copy of
  ZeroedArray<std::uint32_t> copies_;     // by vertex slot: 1 + index into `copy_lists_`
  std::vector<std::vector<VertexId>> copy_lists_;
  std::vector<VertexId> copied_;  // the closed vertex of each list
  std::vector<std::uint32_t> free_lists_;
  ZeroedArray<std::uint32_t> flagged_at_;  // by vertex slot
  ZeroedArray<std::uint32_t> master_at_;   // by vertex slot: 1 + the master adopted last that has it
  ZeroedArray<std::uint32_t> count_at_;    // by vertex slot: the masters that have it
  static constexpr std::uint8_t kHalfBaked = 2;
  ZeroedArray<std::uint8_t> is_on_;
  ZeroedArray<std::uint8_t> is_settled_;  // by vertex slot: 1, or kHalfBaked
  ZeroedArray<std::uint64_t> rank_;       // by vertex slot: 1 + the rank, where that is not the slot
  std::vector<VertexId> ranked_;          // where it is not
  ZeroedArray<std::uint32_t> held_;       // by vertex slot: the call that marked it last
  ZeroedArray<std::uint32_t> made_;       // by vertex slot: likewise, of split points and front points
  std::vector<TetId> let_go_;             // children let go that may have such a vertex
  std::uint32_t hold_ = 1;
  std::vector<std::uint32_t> free_masters_;
  std::vector<VertexId> retired_;
  std::vector<std::uint32_t> star_, dirty_;
  std::uint32_t mark_ = 0;
  bool is_in_motion_ = false;
};

class ClosedComplex::Image {
 private:
  friend class ClosedComplex;
  /// What the tables by vertex slot say of a corner.
  struct Corner {
    VertexId vertex;
    std::uint32_t flagged_at, master_at, count_at;
    std::uint8_t is_on, is_settled;
  };
  std::vector<Master> masters_;
  std::vector<std::uint32_t> free_masters_;
  std::vector<TetId> children_;
  std::array<std::vector<std::uint32_t>, 32> free_blocks_;
  std::vector<FrontPoint> points_;
  std::vector<std::uint32_t> free_points_;
  std::vector<ClosedEdge> edges_;
  std::vector<std::vector<VertexId>> copy_lists_;
  std::vector<VertexId> copied_;
  std::vector<std::uint32_t> free_lists_;
  std::vector<Corner> corners_;
  std::vector<std::pair<VertexId, std::uint64_t>> ranks_;  // in the order of `ranked_`
  std::vector<TetId> let_go_;
  std::uint32_t mark_ = 0;
};

template <class Visit>
void ClosedComplex::for_each_around(std::uint32_t edge, Visit&& visit) const {
  for (std::uint32_t use = edges_[edge].first_use; use != kInvalidIndex; use = masters_[use / 6].next_use[use % 6]) {
    if (masters_[use / 6].split != nullptr) visit(use / 6);
  }
}

}  // namespace v0
}  // namespace incise
