// SPDX-License-Identifier: Apache-2.0
// Blades that are moved step by step, with the mesh looked at after each step, and what a cut that ends inside a body
// is measured by: its wall sides and the swept surface, nothing of the engine's own.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "../../bench/accuracy.h"
#include "support/engines.h"

namespace incise::test {

/// The polylines of a stroke, one pose each.
std::vector<BladePose> poses_of(const Stroke& stroke);

/// The stroke with every step divided into `parts` equal ones.
Stroke subdivided(const Stroke& stroke, unsigned parts);

/// The straight edge from `a` to `b` in `parts` parts. An edge that twists needs several: between two poses of a long
/// one the two triangles of its strip stand steeply against each other.
std::vector<Vec3> divided_edge(const Vec3& a, const Vec3& b, unsigned parts);

struct SteppedOptions {
  double snap = 0;
  bool maintains = false;
};

/// An engine whose blade is moved step by step. After every step: the whole validity contract, the volume to 1e-12. At
/// the end of the test: everything is undone, which must give the first hash, and redone, which must give the last.
class SteppedEngine {
 public:
  explicit SteppedEngine(const TetSoup& soup, SteppedOptions options = {});
  SteppedEngine(const SteppedEngine&) = delete;
  SteppedEngine& operator=(const SteppedEngine&) = delete;
  ~SteppedEngine();

  [[nodiscard]] Engine& engine() { return engine_; }
  [[nodiscard]] const TetMesh& mesh() const { return engine_.mesh(); }
  /// The body before any cut, and its mean edge.
  [[nodiscard]] const TetMesh& input() const { return input_; }
  [[nodiscard]] const bench::Body& body() const { return body_; }
  [[nodiscard]] double h() const { return body_.mean_edge(); }
  [[nodiscard]] std::size_t piece_count() const { return find_components(mesh()).count(); }

  /// Whether all is well; what is not is reported to the test.
  bool begin(const BladePose& pose);
  bool step(const BladePose& pose);
  /// Returns the stroke's number; 0 where it failed.
  std::uint32_t end();
  /// All of a stroke; `before_step(i)` is called before the i-th pose is taken up. Returns its number.
  /// Ends early where a step breaks something.
  std::uint32_t run(const Stroke& stroke, const std::function<void(std::size_t)>& before_step = {});
  /// Puts every vertex where `place` says that its rest point stands now.
  void deform(const std::function<Vec3(VertexId)>& place);
  bool expect_sound() const;
  void expect_back_and_forth();

 private:
  Engine engine_;
  TetMesh input_;
  bench::Body body_;
  double volume_;
};

/// A distance between two sets of points, both ways: the greatest, and the greater of both means.
struct Deviation {
  double greatest = 0, mean = 0;
};

/// How far the border of the walls with `tag` lies from the border of the sweep, inside the body: where the blade
/// stands at the end, the traces of its ends, and where it stood first. For motions that do not turn back.
Deviation border_deviation(const SteppedEngine& stepped, const Stroke& stroke, std::uint32_t tag);

/// The length of the sweep's border inside the body.
double border_length(const SteppedEngine& stepped, const Stroke& stroke);

/// The area of all boundary sides, skin and walls.
double boundary_area(const TetMesh& mesh);

/// Tets with L/r above 200.
std::size_t count_bad_tets(const TetMesh& mesh);

/// Rest points to 1e-7: equal for meshes that differ in rounding and numbering alone.
using GridPoint = std::array<std::int64_t, 3>;
/// The tets of a mesh, each by its corners; ascending.
std::vector<std::array<GridPoint, 4>> tets_by_place(const TetMesh& mesh);
/// The vertices of cut walls; ascending, copies counted once.
std::vector<GridPoint> walls_by_place(const TetMesh& mesh);

}  // namespace incise::test
