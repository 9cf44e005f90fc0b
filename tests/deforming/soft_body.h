// SPDX-License-Identifier: Apache-2.0
// A small solver that follows an engine through its journal alone: what cuts of moving bodies are tested with.
//
// Stable neo-Hookean elasticity, ψ = μ/2 (|F|² − 3) + λ/2 (J − 1 − μ/λ)², by vertex block descent: seen from one vertex
// the energy is quadratic, so each visit minimises exactly. Implicit Euler in time; nothing collides.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "incise/geom/box.h"
#include "incise/mesh/journal.h"
#include "incise/mesh/journal_mirror.h"
#include "incise/mesh/tet_mesh.h"

namespace incise::test {

/// What a body is made of and how it is held. Units: the mesh's length unit, seconds, and a mass unit.
struct SoftBodyOptions {
  double young = 300;          ///< Young's modulus, mass / (length · s²)
  double poisson = 0.4;        ///< in [0, 0.5)
  double density = 1;          ///< at rest
  Vec3 gravity{0, 0, -9.81};   ///< length / s²
  double stretch = 0.25;       ///< along x: the held ends are moved apart by this share of the rest length
  double held = 0.0;           ///< share of the length that is held at either end; below 0: nothing is held
  double spacing = 1.0 / 6.0;  ///< length of a usual edge
  double thinnest = 0.05;      ///< of `spacing`: tets of less height are as soft as if they had it; 0: as they are
  unsigned substeps = 2;       ///< per step of time
  unsigned sweeps = 10;        ///< over all vertices, per substep
  unsigned fresh_sweeps = 8;   ///< over the vertices that a step of the journal put in place
};

/// What following the journal did to the body.
struct FollowReport {
  bool has_changed = false;
  std::size_t fresh = 0;      ///< vertices put in place
  double energy_before = 0;   ///< elastic energies: as the body stood
  double energy_after = 0;    ///< after the records
  double energy_relaxed = 0;  ///< after the sweeps over the fresh vertices
};

class SoftBody {
 public:
  /// Takes the body as it is at rest, stretches it, and lets nothing move yet. Cost: O(tets).
  SoftBody(const TetMesh& mesh, const SoftBodyOptions& options);

  /// Catches up with the journal, then lets the vertices that it put in place find their balance with the others at
  /// rest: elastic energy alone, velocities untouched. Cost: O(tets), about 0.3 µs each, where anything changed.
  FollowReport follow(const Journal& journal);
  /// Moves on by `dt` seconds. Cost: O(tets · substeps · sweeps), about 0.1 µs per tet and sweep.
  void step(double dt);
  /// Goes towards the balance of elasticity and gravity, without inertia; velocities become zero.
  void settle(unsigned sweeps);

  /// The places of all vertex slots, for `Engine::set_positions`.
  [[nodiscard]] std::vector<Vec3> positions() const { return mirror_.positions(); }
  [[nodiscard]] const JournalMirror& mirror() const { return mirror_; }
  [[nodiscard]] JournalMirror& mirror() { return mirror_; }

  [[nodiscard]] double elastic_energy() const;
  [[nodiscard]] double kinetic_energy() const;
  [[nodiscard]] double mass() const;
  [[nodiscard]] Vec3 momentum() const;
  [[nodiscard]] bool is_finite() const;
  /// Tets that are turned inside out as the body stands.
  [[nodiscard]] std::size_t inverted() const;

 private:
  using Vertex = JournalMirror::Vertex;

  struct Element {
    std::array<std::uint32_t, 4> v;
    std::array<std::array<double, 4>, 4> laplacian;  // μ V ∇φi·∇φj
    double bulk;                                     // λ / (36 V), times the squared difference of six volumes
    double target;                                   // six volumes where the bulk part is zero
    double offset;                                   // energy at rest, so that it counts as none
  };
  struct Use {
    std::uint32_t element, corner;
  };
  /// What pulls a vertex besides its tets: weight/2 |x − place|² − force · x.
  struct Pull {
    double weight = 0;
    Vec3 place = Vec3::Zero(), force = Vec3::Zero();
  };

  void rebuild();
  void add_element(const TetVertices& vertices);
  void list_uses();
  void hold_ends();
  [[nodiscard]] double softening(const std::array<Vec3, 4>& p, double volume6) const;
  [[nodiscard]] bool is_held(const Vec3& rest) const;
  [[nodiscard]] Vec3 held_place(const Vec3& rest) const;
  [[nodiscard]] std::span<const Use> uses_of(std::uint32_t v) const {
    return std::span(uses_).subspan(first_use_[v], first_use_[v + 1] - first_use_[v]);
  }
  [[nodiscard]] const Vec3& place(std::uint32_t v) const { return mirror_.vertices()[v].current; }
  [[nodiscard]] Vec3& place(std::uint32_t v) { return mirror_.vertex(VertexId(v)).current; }
  [[nodiscard]] double six_volumes(const Element& element) const;
  [[nodiscard]] double energy(const Element& element) const;
  /// How six volumes of the tet change with its corner.
  [[nodiscard]] Vec3 growth(const Element& element, std::uint32_t corner) const;
  [[nodiscard]] double energy_at(std::uint32_t v, const Vec3& at, const Pull& pull);
  void minimise(std::uint32_t v, const Pull& pull);
  void substep(double dt);
  template <class PullOf>
  void sweep(unsigned count, const PullOf& pull_of);

  SoftBodyOptions options_;
  JournalMirror mirror_;
  Box bounds_;  // at rest, of the whole body
  double mu_, lambda_;
  std::vector<Element> elements_;
  std::vector<std::uint32_t> first_use_, free_;  // by slot; ascending
  std::vector<Use> uses_;
  std::vector<double> mass_;  // by slot
  std::vector<Vec3> start_;   // by slot: before the substep
};

}  // namespace incise::test
