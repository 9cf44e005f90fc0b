// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "incise/core/grow_array.h"
#include "incise/core/id_array.h"
#include "incise/core/result.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/tet_mesh.h"

namespace incise {
inline namespace v0 {

/// How an attribute follows an edit of the mesh.
enum class Transfer : std::uint8_t {
  /// An intensive field (velocity, temperature, texture coordinates). Vertices: Σ weights · parents at birth, sampled
  /// anew where they move. Tets: the parent's value.
  kInterpolate,
  /// A label. Vertices: the value of the parent with the greatest weight, the first of equals; a move keeps it.
  /// Tets: the parent's value.
  kInherit,
  /// An extensive quantity (mass): its sum is kept to rounding, and it stays where its material is.
  kConserve,
  /// A function of the mesh, evaluated for every element that a step touched.
  kRecompute,
};

/// What an attribute belongs to.
enum class Domain : std::uint8_t { kVertex, kTet };

struct AttributeTag;
/// An attribute, in the order of `Attributes::add`.
using AttributeId = Id<AttributeTag>;

/// Computes the value of one element: the slot of a vertex or tet, and where to put its `width` numbers.
/// It must depend on the mesh alone, and on no other slots than the element's own and its neighbours'.
using Recompute = std::function<void(const TetMesh& mesh, std::uint32_t slot, std::span<double> value)>;

/// What an attribute is, for `Attributes::add`.
struct AttributeSpec {
  std::string name;                            ///< unique, not empty
  Domain domain = Domain::kVertex;             ///< vertices or tets
  std::uint32_t width = 1;                     ///< numbers per element, 1 to 64
  Transfer transfer = Transfer::kInterpolate;  ///< how it follows edits
  Recompute recompute = {};                    ///< for kRecompute, and only there
  std::vector<double> initial = {};            ///< `width` numbers that every element starts with; empty: zeros
};

/// Values that users and solvers attach to vertices or tets, and that follow the mesh through its journal alone.
///
/// A follower as the journal describes it: after any number of commits, undos and redos `follow` catches up. Undo
/// brings the values of all elements that a step touched back bit for bit, redo those that undo took away; what was
/// written to other elements in between stays. Steps are known by their serials: one that does the same as an undone
/// one is a new step.
///
/// Conserved quantities have a density at each vertex: the value by the vertex's lumped rest volume, a quarter of each
/// of its tets. A consumed tet carries away its quarters at the densities before the step; its children get them in
/// proportion to their rest volumes, a quarter per corner. A consumed tet without children leaves its quarters with
/// its corners. Where children fill the tets before them together, but not each its own parent, as at the front of a
/// progressive cut, a child gets its parent's density, and what is then missing or left over goes to these children by
/// volume. A rewired tet takes its quarter from the old vertex to the new one. Where a vertex moves, the tets
/// around it that shrink hand material at their own densities to those that grow, so that a uniform density stays
/// uniform and momentum Σ m·v of a linear velocity field is kept. For tets: the parent's value by volume shares, and
/// the same exchange. Values of dead slots are 0.
///
/// A step with `Step::edits` is followed edit by edit. The consumed tets of an edit carry away their quarters at the
/// densities before the edit; its produced tets get the sum in proportion to their rest volumes, a quarter per corner.
/// For tets: the sum likewise, and labels and fields from the parent. Where an edit spans a border between regions each
/// consumed tet hands on to its own children alone. A vertex that dies leaves nothing behind; where a cavity keeps its
/// volume a uniform density stays uniform.
///
/// Not thread-safe; other followers may read the mesh at the same time.
/// Memory: 32 bytes per tet and 36 per vertex besides the values, and what `follow` keeps for undo: O(step) for each
/// step that the journal keeps.
class Attributes {
 public:
  /// For a mesh as it stands, and its journal. Steps before cannot be followed back. Cost: O(n).
  explicit Attributes(const TetMesh& mesh, const Journal& journal = {});

  /// Adds an attribute; `mesh` as at the last `follow`. Errors: kBadArgument for an empty or known name, a width
  /// outside [1, 64], a missing or needless function, or the wrong number of initial values. Elements that an undo past
  /// this call revives get the initial value. Cost: O(n).
  Result<AttributeId> add(const TetMesh& mesh, AttributeSpec spec);

  /// The number of attributes.
  [[nodiscard]] std::size_t size() const { return attributes_.size(); }
  /// The attribute with a name; invalid where there is none.
  [[nodiscard]] AttributeId find(const std::string& name) const;
  /// As given to `add`.
  [[nodiscard]] const AttributeSpec& spec(AttributeId id) const { return attributes_[id.value].spec; }
  /// The values, indexed by slot · width + component. Valid until the next `follow` or `add`.
  [[nodiscard]] std::span<double> values(AttributeId id) {
    return {attributes_[id.value].values.data(), attributes_[id.value].values.size()};
  }
  /// The same, to read.
  [[nodiscard]] std::span<const double> values(AttributeId id) const {
    return {attributes_[id.value].values.data(), attributes_[id.value].values.size()};
  }
  /// The value of one element. Valid until the next `follow` or `add`.
  [[nodiscard]] std::span<double> value(AttributeId id, std::uint32_t slot) {
    const std::uint32_t width = attributes_[id.value].spec.width;
    return values(id).subspan(std::size_t{slot} * width, width);
  }
  /// The lumped rest volume of a vertex, in cubed length units: times a density it gives the vertex's mass.
  [[nodiscard]] double lumped_volume(VertexId vertex) const { return lumped_[vertex]; }

  /// The journal position that the values belong to.
  [[nodiscard]] std::size_t position() const { return base_ + applied_; }

  /// Catches up with the journal, forwards or backwards; also where steps were undone and others took their place.
  ///
  /// `mesh` is the journal's mesh as it stands. Where a step has no `edits`, records apply in the order of the members
  /// of `Step`; a transaction that moves a vertex before it splits beside it is therefore followed with its shares, not
  /// its sums, approximate. Several steps at once give what they give one by one. Errors: kBadArgument where the
  /// journal went back behind where the attributes began, or has trimmed steps that they have not seen; nothing
  /// changes, and they must be made anew. Cost: O(steps to go and the last one before them).
  Status follow(const Journal& journal, const TetMesh& mesh);

 private:
  class Stepper;
  struct Attribute {
    AttributeSpec spec;
    GrowArray<double> values;
  };
  struct SavedVertex {
    VertexId id;
    Vec3 rest;
    double lumped;
  };
  struct SavedTet {
    TetId id;
    TetVertices vertices;
  };
  /// What a step touched, as it stands on the other side of the step.
  struct Record {
    std::uint64_t serial = 0;    // of the step
    bool is_recomputed = false;  // the mesh has been seen as it was right after the step
    std::uint32_t vertex_slots = 0, tet_slots = 0;
    std::vector<SavedVertex> vertices;
    std::vector<SavedTet> tets;
    std::vector<std::vector<double>> values;  // by attribute, in the order of `vertices` or `tets`
  };

  [[nodiscard]] std::optional<std::size_t> common_with(const Journal& journal) const;
  void apply(const Step& step);
  void forget_trimmed(const Journal& journal);
  void resize(std::uint32_t vertex_slots, std::uint32_t tet_slots);
  static void fill_initial(Attribute& attribute, std::uint32_t slot);
  void link(TetId tet, const TetVertices& vertices);
  void unlink(TetId tet);
  [[nodiscard]] double volume(const TetVertices& vertices) const;
  void touch(Record& record, VertexId vertex);
  void touch(Record& record, TetId tet);
  void mark(const Record& record, bool is_touched);
  void swap_with(Record& record);
  void swap_values(Record& record, std::size_t attribute, const std::vector<bool>& is_revived);
  void recompute_last(const TetMesh& mesh);
  void recompute(const TetMesh& mesh, Domain domain, std::uint32_t slot);

  std::vector<Attribute> attributes_;
  std::size_t base_ = 0, applied_ = 0;
  std::uint64_t base_serial_ = 0;  // of the step before base_
  std::deque<Record> records_;     // from base_ on; those from applied_ on are undone
  IdArray<VertexId, Vec3> rest_;
  IdArray<VertexId, double> lumped_;
  IdArray<VertexId, std::uint32_t> first_corner_;  // tet slot · 4 + corner, the head of a list through next_corner_
  IdArray<TetId, TetVertices> tets_;
  GrowArray<std::uint32_t> next_corner_;
  ZeroedArray<std::uint8_t> is_touched_vertex_;  // scratch, zero between calls
  ZeroedArray<std::uint8_t> is_touched_tet_;     // likewise
};

}  // namespace v0
}  // namespace incise
