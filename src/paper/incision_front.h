// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cut/strip.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/star.h"
#include "paper/neighbourhood.h"
#include "paper/sheet_so_far.h"

namespace incise {
inline namespace v0 {

/// A collision point with tissue on both sides of the sheet: the incision may go on from it.
struct CollisionPoint {
  VertexId vertex = {};
  std::uint32_t generation = 0;  ///< of the vertex's slot
  Vec3 normal = Vec3::Zero();    ///< unit, of the sheet there; zero where it had none
  Vec3 rim = Vec3::Zero();       ///< where the sheet ended next to it, once that has ended; else its place
  bool is_split = false;         ///< the stroke under way has made it where it crosses tissue
  std::uint32_t sheet = 0;       ///< the incision that it is of, by a number of its own
};

/// The collision points at the front of incisions, kept from frame to frame and from stroke to stroke.
///
/// A frame crosses some edges of a tet, the next one others: a face between collision points of both is an incision
/// face, too. So every frame is cut with the points that those before have left joined. Points of the sheet under way
/// count as they are. Those of an earlier sheet count where they lie on the present one: in its plane, and within an
/// edge of it; or where that begins at the rim of theirs beside them: curved sheets leave each other's planes. An
/// incision whose front a stroke meets like that goes on, whatever was cut in between. Source: paper §2.2 and §2.3,
/// which speak of one incision, and §4.2, in which it takes many frames; docs/decisions/0050.
class IncisionFront {
 public:
  /// Those of the sheet so far become those of an earlier one. Cost: O(points).
  void begin_sheet();
  /// Notes for the points of the sheet where that ends beside them. `border`: of the sheet. Cost: O(points · segments).
  void end_sheet(const TetMesh& mesh, std::span<const Strip::Segment> border);
  /// Marks the points that take part in the cut along a sheet, near or not, and makes them the sheet's own; and the
  /// vertices nearby of walls that strokes with other tags have opened along it, which maintenance may have moved.
  /// Cost: O(points of the sheet), and a search of the sheet for each earlier point and each vertex of a wall nearby.
  void mark(const TetMesh& mesh, const SheetSoFar& sheet, std::uint32_t tag, Neighbourhood& near, StarWalker& walker);
  /// Takes the collision points of a sheet besides: the vertices that split edges, and those of the mesh that lie on it
  /// with tissue on both sides. `near` as `subdivide` left it. Cost: O(near edges + marked vertices · their stars).
  void take(const TetMesh& mesh, const Sheet& sheet, const Neighbourhood& near, StarWalker& walker);
  /// Drops the points that a step removed. Of those that it divided it keeps the parts, the copies among them, that
  /// still have tissue on both sides of the sheet: a vertex is divided in one place while the cut goes on in another.
  /// Cost: O(points + copies · (log points + copies + their stars)).
  void follow(const TetMesh& mesh, const Sheet& sheet, const Step& step, StarWalker& walker);
  /// Adds vertices that lie on walls of the sheet, or on chords of them, where they have tissue on both sides.
  void add(const TetMesh& mesh, const Sheet& sheet, const std::vector<VertexId>& vertices, StarWalker& walker);
  /// Has the points that live go by their slots' present generations, after undo or redo. Cost: O(points).
  void renew(const TetMesh& mesh);
  /// Drops the points at which no tissue joins both sides any more, when a stroke has ended: maintenance moves lips. In
  /// a curved sheet, as all are in a body that moves, lips leave its planes, and `follow` keeps them. Cost: O(points ·
  /// their stars).
  void leave_lips(const TetMesh& mesh, StarWalker& walker);
  /// All incisions are complete.
  void clear();

  /// Of the sheet under way, ascending.
  [[nodiscard]] const std::vector<CollisionPoint>& own() const { return own_; }
  /// Whether a stroke with a tag has cut along the sheet under way.
  [[nodiscard]] bool is_of_sheet(std::uint32_t tag) const;
  /// Whether there are any points.
  [[nodiscard]] bool is_empty() const { return own_.empty() && older_.empty(); }
  /// The vertices of all of them that live, ascending.
  [[nodiscard]] std::vector<VertexId> vertices(const TetMesh& mesh) const;

 private:
  /// Vertices on walls of older cuts that go along the sheet, within `kJoinOffset` of it: it is the same cut. Those in
  /// its plane that have tissue on both sides are points of the front. Where the blade has left the body, a lip is no
  /// front; but merging may tie it to tissue that the blade meets next.
  void adopt_walls(const TetMesh& mesh, const Sheet& sheet, std::uint32_t tag, Neighbourhood& near, StarWalker& walker);
  /// A sheet that crosses the front of an earlier one splits edges between its points: what splits them is one as well.
  void add_splits_of_older(const TetMesh& mesh, const Neighbourhood& near);

  /// An earlier sheet turns out to be the same incision as the one under way.
  void unite(std::uint32_t sheet);
  /// Notes that the stroke with a tag is of the sheet under way.
  void note_stroke(std::uint32_t tag);
  /// The sheet that a stroke has cut along last; none where it is not known.
  [[nodiscard]] std::optional<std::uint32_t> sheet_of(std::uint32_t tag) const;
  /// Whether a wall is known to be of another incision than a point.
  [[nodiscard]] bool is_foreign(std::uint32_t tag, const CollisionPoint& point) const;
  [[nodiscard]] bool is_joined(const TetMesh& mesh, const CollisionPoint& point, StarWalker& walker) const;

  std::vector<CollisionPoint> own_, older_;                        // ascending
  std::uint32_t sheet_ = 0;                                        // the one under way
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sheet_of_;  // by the tags of strokes, ascending
};

}  // namespace v0
}  // namespace incise
