// SPDX-License-Identifier: Apache-2.0
// What a deformable body holds, for the files that implement it: following the journal, moving on, questions.
#pragma once

#include <map>
#include <vector>

#include "incise/core/hash.h"
#include "incise/core/parallel.h"
#include "incise/mesh/attributes.h"
#include "incise/mesh/journal_cursor.h"
#include "incise/sim/body.h"
#include "sim/body/bones.h"
#include "sim/body/coarse_lattice.h"
#include "sim/body/kernel_rows.h"
#include "sim/body/nodal_volumes.h"
#include "sim/body/packed_stars.h"
#include "sim/body/self_contact.h"
#include "sim/body/star_kernel.h"
#include "sim/body/stars.h"
#include "sim/body/sweep_order.h"

namespace incise {
inline namespace v0 {
namespace detail {

/// A vertex that is held where it is: `stiffness` in N/m, infinite for rigidly.
struct Hold {
  double stiffness = 0;
  Vec3 target = Vec3::Zero();
  Vec3 rest = Vec3::Zero();  ///< the vertex' place in the rest shape that the target is for
  HoldLimit limit{};         ///< of a spring
  [[nodiscard]] bool is_rigid() const { return !(stiffness < kGreatestExtent); }  // as stiff as numbers may be
};

enum class Held : std::uint8_t { kNot, kBySpring, kRigidly };

/// The energy of a body in the middle of things, in kg L²/s², not counted from rest.
struct EnergyNow {
  double total = 0;
  double motion = 0;  ///< its kinetic part, without that of free pieces as rigid bodies
  double noise = 0;   ///< by which rounding may change it

  /// What has been added to it since `before`, beyond rounding.
  [[nodiscard]] double excess_over(const EnergyNow& before) const {
    return total - before.total - noise - before.noise;
  }
};

/// A part of the body that hangs together through vertices.
struct Piece {
  bool is_free = false;     ///< nothing holds or pulls it
  bool is_crumb = false;    ///< it moves as a point, and is no part of the descent
  bool is_held = false;     ///< something holds it
  bool is_carried = false;  ///< contacts or pulls bear it, and nothing holds it
  bool is_lost = false;     ///< it is free, has fallen far away and sleeps there: nothing touches it
  std::size_t vertices = 0;
};

/// Pieces that touch each other, or one that touches none: what moves as one body.
struct Group {
  bool is_free = true;  ///< nothing holds or pulls any of them
  double mass = 0;
  Vec3 momentum = Vec3::Zero(), centre = Vec3::Zero(), spin = Vec3::Zero();  ///< as they must be; centre: mass · place
};

/// How a free piece moves as a rigid body: no energy may be taken from that.
struct Drift {
  double mass = 0;
  Vec3 velocity = Vec3::Zero(), centre = Vec3::Zero();  ///< centre: against the body's middle
  Vec3 spin = Vec3::Zero(), turn = Vec3::Zero();        ///< angular momentum about the centre, and rate

  /// Of a point that is at `place` against the body's middle.
  [[nodiscard]] Vec3 velocity_at(const Vec3& place) const { return velocity + turn.cross(place - centre); }
};

/// A free piece too small to be computed: it moves as a point.
struct Crumb {
  std::vector<std::uint32_t> vertices;
  double age = 0;  ///< s
};

/// The turning ω with `by_turn` ω = `missing`; none where there is no single one.
[[nodiscard]] Vec3 turn_for(const Vec3& missing, const Mat3& by_turn);

/// A pull as the descent sees it, limits in kg L/s².
[[nodiscard]] PullTerm term_of(const Pull& pull, const Vec3& middle, double unit);
/// The same of a tie.
[[nodiscard]] PullTerm term_of(const Tie& tie, double unit);

/// What may stand otherwise than at the last `follow`, each once, in the order in which it was found.
struct Touched {
  std::vector<std::uint32_t> tets;
  std::vector<std::uint32_t> fresh;  ///< vertices that the rest shape has anew, or elsewhere
  double energy = 0;                 ///< of the tets before: elastic, without that of averaged volumes
};

}  // namespace detail

/// Arrays go by slot. Units: the mesh's length unit L, kg and s: so forces are in kg L/s², energies in kg L²/s².
struct DeformableBody::State {
  State(const TetMesh& mesh, const Journal& journal, Materials given, const BodyOptions& chosen)
      : options(chosen),
        materials(std::move(given)),
        attributes(mesh, journal),
        pair(chosen.threads),
        cursor(journal) {}

  BodyOptions options;
  Materials materials;

  // the mesh as it was at the last `follow`
  IdArray<TetId, TetVertices> tets;  // the first one is invalid where the slot is free
  IdArray<TetId, std::int32_t> regions;
  IdArray<VertexId, Vec3> rest;

  // state in time
  std::vector<Vec3> places;
  std::vector<Vec3> places_before;  // at the start of the advance under way, where its energy is watched
  Attributes attributes;            // mass and momentum of the vertices: kept through every edit
  AttributeId mass_id, momentum_id;
  AttributeId metric_id;    // of tets, where tissue relaxes: those of its Prony terms, 6 numbers each
  bool is_viscous = false;  // some material relaxes
  std::map<std::uint32_t, detail::Hold> holds;
  std::map<std::uint32_t, detail::Hold> lost_holds;  // of vertices that died: undo may bring them back
  IdArray<VertexId, detail::Held> held;              // what `holds` says
  std::vector<Pull> pulls;
  std::vector<Tie> ties;
  std::vector<Vec3> tie_spans;  // from a to b when its vertices were last woken
  Vec3 middle = Vec3::Zero();   // that single-precision places count from
  double extent = 0;            // of the body along its longest axis, when `middle` was found
  double drifted = 0;           // the most that anything has moved since

  // the descent
  detail::KernelRows rows;
  detail::Stars stars;
  detail::PackedStars packed;
  detail::SweepOrder order;
  detail::NodalVolumes nodal{rows};
  std::vector<std::uint32_t> strained;         // awake vertices around pulls, where tissue stiffens; of this `advance`
  std::vector<std::uint32_t> around_strained;  // rows of what is around those
  std::vector<std::uint32_t>
      beside_rows;          // of what visits leave where it is and has a pressure that they read, of this `advance`
  GrowArray<float> floats;  // places against the middle, and pressures, 4 per row
  detail::ByRow<detail::Motion> motions{rows};
  std::array<std::vector<std::uint32_t>, detail::SweepOrder::kParts> awake_rows;  // of `order`, as of this `advance`
  std::vector<std::uint32_t> some_rows;                                           // scratch
  std::vector<detail::PullTerm> terms;
  std::vector<detail::PullUse> uses;
  IdArray<VertexId, float> travelled;  // squared, in this `advance`
  detail::CoarseLattice lattice;
  detail::SelfContact contact;
  WorkPair pair;

  // free pieces
  IdArray<VertexId, std::uint32_t> piece_of;
  std::vector<detail::Piece> pieces;
  std::vector<std::uint32_t> group_of;  // by piece
  std::vector<detail::Group> groups;
  detail::Bones bones;
  bool has_bones = false;      // some material is rigid
  bool bones_changed = false;  // they are to be found anew
  bool has_free_group = false, has_carried_piece = false;
  std::vector<detail::Crumb> crumbs;
  IdArray<VertexId, std::uint8_t> in_crumb;  // whether a vertex is in one of them
  double largest_crumb = 0;                  // volume at rest, length unit³: what is smaller is one
  unsigned stale_pieces = 0;                 // `advance`s since tets changed; 0: none did

  // of `energy_now`
  std::vector<std::uint32_t> resting;  // vertices that are held or asleep and share tets with what is awake, or more
  IdArray<VertexId, std::uint8_t> is_resting;  // scratch, zero between calls
  std::vector<detail::Drift> drifts;           // by group: how the free ones move as rigid bodies
  std::array<std::vector<std::uint32_t>, detail::SweepOrder::kParts> turned_rows;  // awake, of tets that are inside out
  std::vector<std::pair<VertexId, Vec3>> turned_from;  // by `turn_all_back`, what moved, as it moved: where it was

  JournalCursor cursor;

  // of one `follow`
  detail::Touched touched;
  std::vector<std::uint32_t> changed;          // vertices whose stars changed
  std::vector<std::uint32_t> named_tets;       // by the steps, changed or not: for contact
  ZeroedArray<std::uint8_t> is_touched_tet;    // scratch, zero between calls
  ZeroedArray<std::uint8_t> is_fresh;          // likewise, by vertex: `Fresh`
  ZeroedArray<std::uint8_t> has_changed_star;  // likewise

  [[nodiscard]] bool is_live(VertexId v) const { return v.value < places.size() && stars.of(v).lanes > 0; }
  [[nodiscard]] double unit() const { return options.length_unit; }
  [[nodiscard]] double* masses() { return attributes.values(mass_id).data(); }
  [[nodiscard]] const double* masses() const { return attributes.values(mass_id).data(); }
  [[nodiscard]] double* momenta() { return attributes.values(momentum_id).data(); }
  [[nodiscard]] const double* momenta() const { return attributes.values(momentum_id).data(); }
  [[nodiscard]] double mass_of(VertexId v) const { return masses()[v.value]; }
  [[nodiscard]] Vec3 momentum_of(VertexId v) const {
    const double* p = momenta() + std::size_t{3} * v.value;
    return {p[0], p[1], p[2]};
  }
  void set_momentum(VertexId v, const Vec3& momentum) {
    double* p = momenta() + std::size_t{3} * v.value;
    for (unsigned i = 0; i < 3; ++i) p[i] = momentum.data()[i];
  }
  [[nodiscard]] std::array<Vec3, 4> corners_at_rest(TetId t) const;
  [[nodiscard]] std::array<Vec3, 4> corners(TetId t) const;
  /// Of bone there is none: nothing of it deforms.
  [[nodiscard]] detail::Element element(TetId t) const;
  [[nodiscard]] detail::Element soft_element(TetId t, bool has_offset) const;
  [[nodiscard]] bool is_bone(TetId t) const { return has_bones && materials.of(regions[t]).rigid; }
  [[nodiscard]] detail::Descent descent();
  void round_place(VertexId v);
  /// Where the descent has a vertex: x, y, z against the middle, and a pressure.
  [[nodiscard]] float* single(VertexId v) { return floats.data() + std::size_t{4} * rows.of(v); }
  [[nodiscard]] const float* single(VertexId v) const { return floats.data() + std::size_t{4} * rows.of(v); }

  void set_hold(VertexId v, const detail::Hold& hold);
  void clear_hold(VertexId v);
  /// Where a held vertex is to be that is now at `rest`, a mean of the rest places in `basis`: those of them that are
  /// held shift it as they are shifted, for the others `shift` counts.
  [[nodiscard]] Vec3 held_place(const Vec3& rest, const Vec3& shift, const TetVertices& basis,
                                const std::array<double, 4>& weights) const;

  // building and following (body_follow.cpp)
  void build(const TetMesh& mesh);
  [[nodiscard]] bool is_to_average() const;
  template <class Is>
  [[nodiscard]] bool has_material(const Is& is) const;
  void note_bone(TetId t) { bones_changed = bones_changed || is_bone(t); }
  void ensure(std::uint32_t vertex_slots, std::uint32_t tet_slots);
  void lay_out_stars();
  void note_tet(TetId t);
  enum class Fresh : std::uint8_t { kMoved = 1, kNew };
  void note_fresh(VertexId v, Fresh how);
  void remove_touched(const TetMesh& mesh, FollowReport& report);
  void put_fresh(const TetMesh& mesh);
  void add_touched(const TetMesh& mesh, FollowReport& report);
  void settle_changed();
  void finish_follow(bool has_rewound, FollowReport& report);
  void follow_contact(const TetMesh& mesh, bool has_rewound);
  bool add_tet(const TetMesh& mesh, TetId t);
  bool remove_tet(TetId t);
  void note_changed(const TetVertices& vertices);
  void settle_vertex(VertexId v);
  void release_lost_holds();
  void drop_lost_pulls(const TetMesh& mesh);
  [[nodiscard]] bool differs(const TetMesh& mesh, TetId t) const;

  // joined lips go towards their balance (body_balance.cpp)
  void note_energy();
  std::size_t balance();

  // ties (body_ties.cpp)
  [[nodiscard]] Vec3 span_of(const Tie& tie) const;
  void wake_ends(const Tie& tie);
  void let_go(const Tie& tie);
  void wake_tied();
  void lend_to_seam();
  void drop_lost_ties(const TetMesh& mesh);
  [[nodiscard]] double tied_energy() const;
  [[nodiscard]] Status check(const Tie& tie, std::size_t index) const;

  // stresses that relax (body_viscous.cpp)
  void add_metrics(const TetMesh& mesh);
  [[nodiscard]] detail::Metric metric(TetId t, unsigned term) const;
  void add_metrics(TetId t, StateHash& hash) const;
  void relax_stresses(double dt);
  void forget_stresses();

  // pins (body_pins.cpp)
  [[nodiscard]] std::size_t give_way();

  // averaged volumes, in double precision (body_pressure.cpp)
  template <class Visit>
  void for_each_volume_around(VertexId v, const Visit& visit) const;
  [[nodiscard]] double pressure_at(VertexId v) const;
  [[nodiscard]] Vec3 pressure_slope(VertexId v) const;
  [[nodiscard]] Mat3 pressure_stiffness(VertexId v) const;
  [[nodiscard]] double pressure_energy() const;

  // moving on (body_advance.cpp)
  template <class Visit>
  void for_each_awake(Visit&& visit) const {
    for (std::size_t part = 0; part < detail::SweepOrder::kParts; ++part) {
      for (const std::uint32_t v : order.awake(static_cast<detail::SweepOrder::Part>(part))) visit(v);
    }
  }
  void centre();
  void forget_terms();
  void add_holds();
  void prepare_pulls();
  void wake_pulled(const Pull& pull);
  [[nodiscard]] bool is_as_before(const Pull& a, const Pull& b) const;
  void wake_where_pulls_differ(const std::vector<Pull>& next);
  void list_uses();
  void list_awake_rows();
  [[nodiscard]] std::span<const std::uint32_t> rows_of(std::span<const std::uint32_t> slots);
  void list_beside();
  void list_strained();
  void list_around(std::span<const std::uint32_t> vertices, std::vector<std::uint32_t>& around);
  void find_pressures();
  void find_pressures_beside();
  void begin_substep(double h);
  void descend(double h);
  void find_slopes(float* slopes);
  void end_substep(double h, double& fastest);
  void relax(std::span<const std::uint32_t> vertices, unsigned sweeps, bool with_terms = false);
  [[nodiscard]] bool has_moved(VertexId v) const;
  void fall_asleep();

  // energy (body_energy.cpp)
  void find_drifts(std::vector<detail::Drift>& found) const;
  void find_resting();
  [[nodiscard]] detail::EnergyNow watch_energy();
  [[nodiscard]] detail::EnergyNow energy_now();
  [[nodiscard]] double pressed_energy() const;
  void keep_energy(const detail::EnergyNow& before, double dt);
  void step_back(double most, double dt);
  [[nodiscard]] bool may_turn_back(VertexId v) const;
  void add_turned_around(VertexId v, bool slivers, std::vector<TetId>& found) const;
  double turn_back(TetId t);
  bool turn_all_back(bool slivers);
  void turn_all_over();
  void untangle(const detail::EnergyNow& before, detail::EnergyNow& now);
  void find_turns(std::vector<detail::Drift>& found) const;
  void move_rigidly(std::vector<detail::Drift> moved);

  // free pieces (body_pieces.cpp)
  void label_pieces();
  void label_stale_pieces();
  void find_free_pieces();
  void wake_pieces(const std::vector<bool>& which);
  void wake_free_groups();
  void find_groups();
  void move_carried();  // body_carried.cpp
  [[nodiscard]] std::uint32_t group_at(VertexId v) const { return group_of[piece_of[v]]; }
  void leave_lost_pieces();
  void gather_crumbs();
  void begin_crumb(const detail::Crumb& crumb);
  void dissolve_crumb_at(VertexId v);
  void move_crumbs(double dt);
  void expect_motion(double h);
  void correct_motion(double h);
};

}  // namespace v0
}  // namespace incise
