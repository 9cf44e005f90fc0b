// SPDX-License-Identifier: Apache-2.0
// Compiled once for each instruction set; the best that the machine has is chosen when the program runs.
#include "sim/body/star_kernel.h"

#include <cmath>
#include <cstring>
#include <vector>

#if INCISE_WITH_HIGHWAY
// 8 lanes are all that a star fills: wider sets would only compile longer. Machines that stop at SSSE3 are of 2008.
#define HWY_DISABLED_TARGETS (HWY_AVX3 | HWY_AVX3_DL | HWY_SSSE3)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/body/star_kernel.cpp"  // NOLINT(readability-identifier-naming): Highway's name
#include <hwy/foreach_target.h>                        // NOLINT(misc-header-include-cycle): it includes this file
#endif
#include "sim/body/lanes-inl.h"

#if INCISE_WITH_HIGHWAY
HWY_BEFORE_NAMESPACE();
#endif
namespace incise {
inline namespace v0 {
namespace detail {
namespace INCISE_LANES_NAMESPACE {

constexpr std::size_t kFetchAhead = 2;  // vertices

/// What a visit wants of a star: the slope of the energy; its curvature, too; or both where volumes are averaged.
enum class Wanted { kSlope, kSlopeAveraged, kBoth, kBothAveraged };

/// The laws that the tets of a body have; each one has the terms of those before it.
enum class Law { kSoft, kStiffening, kFibres };

constexpr bool with_curvature(Wanted wanted) {
  return wanted == Wanted::kBoth || wanted == Wanted::kBothAveraged;
}

inline Lanes least_of_two(const Lanes& a, const Lanes& b) {
  const Lanes over = a - b;
  return a - where_positive(over, over);
}

/// What stiffening does to the tets of a block, seen from one corner: `stiffened` in lanes.
struct StiffLanes {
  Lanes soft, within, base, base2, base4;

  // The other corners lie at a, b and c, and `swelling` is (bulk/2 · V − pressure) V.
  [[gnu::always_inline]] inline StiffLanes(const StarBlock& block, const StiffeningBlock& more, const Lanes& swelling,
                                           const Lanes& aa, const Lanes& bb, const Lanes& cc, const Lanes& ab,
                                           const Lanes& bc, const Lanes& ca)
      : soft(swelling - load(more.offset.data()) -
             all(0.5F) *
                 ((load(block.to_a.data()) * aa + (load(block.to_b.data()) * bb + load(block.to_c.data()) * cc)) +
                  (load(more.a_b.data()) * ab + (load(more.b_c.data()) * bc + load(more.c_a.data()) * ca)))),
        within(least_of_two(soft, load(more.most.data()))),
        base(all(1) + load(more.by.data()) * within),
        base2(base * base),
        base4(base2 * base2) {}

  [[nodiscard]] inline Lanes factor() const { return base4 * base2 * base; }
  [[nodiscard]] inline Lanes growth(const StiffeningBlock& more) const {
    return where_positive(load(more.most.data()) - soft, all(7) * load(more.by.data()) * (base4 * base2));
  }
  [[nodiscard]] inline Lanes energy() const {
    const Lanes grown = within * (base + all(1)) * (base2 + all(1)) * ((base4 + all(1)) * all(0.125F));
    return grown + factor() * (soft - within);
  }
};

/// Fibres of the tets of a block, seen from one corner: they pull where they are longer than at rest.
struct FibreLanes {
  Lanes x, y, z, own, stiffness, more, over, by;

  // The other corners lie at a, b and c. The corner's own part is what theirs lack to 0.
  [[gnu::always_inline]] inline FibreLanes(const FibreBlock& block, const Lanes& ax, const Lanes& ay, const Lanes& az,
                                           const Lanes& bx, const Lanes& b_y, const Lanes& bz, const Lanes& cx,
                                           const Lanes& cy, const Lanes& cz)
      : x(load(block.a.data()) * ax + (load(block.b.data()) * bx + load(block.c.data()) * cx)),
        y(load(block.a.data()) * ay + (load(block.b.data()) * b_y + load(block.c.data()) * cy)),
        z(load(block.a.data()) * az + (load(block.b.data()) * bz + load(block.c.data()) * cz)),
        own(all(0) - (load(block.a.data()) + (load(block.b.data()) + load(block.c.data())))),
        stiffness(load(block.stiffness.data())),
        more(square_root(x * x + y * y + z * z) - all(1)),
        over(where_positive(more, more)),
        by(all(1) / (all(1) + over)) {}

  [[nodiscard]] inline Lanes energy() const { return all(0.5F) * stiffness * over * over; }
  /// Of the slope, by the fibre as it stands.
  [[nodiscard]] inline Lanes pull() const { return own * stiffness * over * by; }
  /// Along the fibre. Those that are about to be taut count: no visit finds itself beyond where they begin to pull.
  [[nodiscard]] inline Lanes curvature() const {
    return where_positive(more + all(kNearlyTaut), own * own * stiffness);
  }
  /// Of that, across the fibre.
  [[nodiscard]] inline Lanes across() const { return over * by; }

  static constexpr float kNearlyTaut = 0.02F;
};

/// How six volumes change with a vertex: first those of its tets, row by row; then of its neighbours and of itself, by
/// rows and by columns, with their stiffnesses and pressures. What no neighbour fills is 0.
struct Around {
  float *normals, *rows, *x, *y, *z, *stiffness, *pressure;
};
constexpr std::uint32_t kRows[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7};

/// Slope and curvature of a star, summed lane by lane.
struct StarSum {
  Lanes gx, gy, gz, xx, xy, xz, yy, yz, zz;

  // Written out: a constructor that the compiler makes is not compiled for the instruction set at hand.
  inline explicit StarSum(const Lanes& zero)
      : gx(zero), gy(zero), gz(zero), xx(zero), xy(zero), xz(zero), yy(zero), yz(zero), zz(zero) {}

  template <Wanted kWanted, Law kLaw>
  [[gnu::always_inline]] inline void add(const StarBlock& block, [[maybe_unused]] const StiffeningBlock* stiffening,
                                         [[maybe_unused]] const FibreBlock* fibre_block, const Descent& d,
                                         const Lanes& x, const Lanes& y, const Lanes& z, float own_pressure,
                                         float* normals) {
    Lanes ax, ay, az, bx, by, bz, cx, cy, cz;
    Lanes of_nodes = all(own_pressure);
    if constexpr (kWanted == Wanted::kSlopeAveraged) {
      Lanes pa, pb, pc;
      load_rows(d.places, block.a.data(), ax, ay, az, pa);
      load_rows(d.places, block.b.data(), bx, by, bz, pb);
      load_rows(d.places, block.c.data(), cx, cy, cz, pc);
      of_nodes = (pa + pb) + (pc + of_nodes);
    } else {
      load_points(d.places, block.a.data(), ax, ay, az);
      load_points(d.places, block.b.data(), bx, by, bz);
      load_points(d.places, block.c.data(), cx, cy, cz);
    }
    ax = ax - x, ay = ay - y, az = az - z;
    bx = bx - x, by = by - y, bz = bz - z;
    cx = cx - x, cy = cy - y, cz = cz - z;
    const Lanes ux = bx - ax, uy = by - ay, uz = bz - az, wx = cx - ax, wy = cy - ay, wz = cz - az;
    // The slope of six volumes in the vertex, and the volumes themselves.
    const Lanes nx = uz * wy - uy * wz, ny = ux * wz - uz * wx, nz = uy * wx - ux * wy;
    const Lanes volume6 = all(0) - (nx * ax + ny * ay + nz * az);
    const Lanes bulk = load(block.bulk.data()), pressure = load(block.pressure.data());
    Lanes swell = bulk * volume6 - absolute(pressure);
    const Lanes to_a = load(block.to_a.data()), to_b = load(block.to_b.data()), to_c = load(block.to_c.data());
    if constexpr (kLaw != Law::kSoft) {
      const Lanes vx = wx - ux, vy = wy - uy, vz = wz - uz;
      Lanes sx = swell * nx + (to_a * ax + (to_b * bx + to_c * cx));
      Lanes sy = swell * ny + (to_a * ay + (to_b * by + to_c * cy));
      Lanes sz = swell * nz + (to_a * az + (to_b * bz + to_c * cz));
      Lanes swelling = (swell - all(0.5F) * bulk * volume6) * volume6;
      // Curvature of the fibres: `across` in all directions, and of `pull` along them.
      Lanes across = all(0), pull_x = all(0), pull_y = all(0), pull_z = all(0), fx = all(0), fy = all(0), fz = all(0);
      if constexpr (kLaw == Law::kFibres) {
        const FibreLanes fibres(*fibre_block, ax, ay, az, bx, by, bz, cx, cy, cz);
        const Lanes pull = fibres.pull(), bent = fibres.curvature();
        sx = sx + pull * fibres.x, sy = sy + pull * fibres.y, sz = sz + pull * fibres.z;
        swelling = swelling + fibres.energy();
        across = bent * fibres.across();
        fx = fibres.by * fibres.x, fy = fibres.by * fibres.y, fz = fibres.by * fibres.z;
        const Lanes along = bent - across;
        pull_x = along * fx, pull_y = along * fy, pull_z = along * fz;
      }
      const StiffLanes stiff(block, *stiffening, swelling, ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz,
                             cx * cx + cy * cy + cz * cz, ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz,
                             wx * wx + wy * wy + wz * wz);
      const Lanes factor = stiff.factor();
      gx = gx + factor * sx, gy = gy + factor * sy, gz = gz + factor * sz;
      if constexpr (kWanted == Wanted::kSlopeAveraged) {
        const Lanes shared = where_positive(pressure, of_nodes);
        gx = gx + shared * nx, gy = gy + shared * ny, gz = gz + shared * nz;
      }
      if constexpr (!with_curvature(kWanted)) return;
      // The Laplacian's diagonal is in the vertex' own, but for what the factor adds.
      Lanes more = (all(1) - factor) * (to_a + (to_b + to_c));
      const Lanes growth = stiff.growth(*stiffening);
      const Lanes bent = factor * bulk, kx = bent * nx, ky = bent * ny, kz = bent * nz;
      const Lanes tx = growth * sx, ty = growth * sy, tz = growth * sz;
      if constexpr (kLaw == Law::kFibres) {
        more = more + factor * across;
        xx = xx + factor * pull_x * fx, xy = xy + factor * pull_x * fy, xz = xz + factor * pull_x * fz;
        yy = yy + factor * pull_y * fy, yz = yz + factor * pull_y * fz, zz = zz + factor * pull_z * fz;
      }
      xx = xx + (kx * nx + tx * sx) + more, xy = xy + (kx * ny + tx * sy), xz = xz + (kx * nz + tx * sz);
      yy = yy + (ky * ny + ty * sy) + more, yz = yz + (ky * nz + ty * sz), zz = zz + (kz * nz + tz * sz) + more;
      if constexpr (kWanted == Wanted::kBothAveraged) store_rows(nx, ny, nz, normals);
      return;
    }
    if constexpr (kWanted == Wanted::kSlopeAveraged) swell = swell + where_positive(pressure, of_nodes);
    gx = gx + (swell * nx + (to_a * ax + (to_b * bx + to_c * cx)));
    gy = gy + (swell * ny + (to_a * ay + (to_b * by + to_c * cy)));
    gz = gz + (swell * nz + (to_a * az + (to_b * bz + to_c * cz)));
    if constexpr (!with_curvature(kWanted)) return;
    const Lanes kx = bulk * nx, ky = bulk * ny, kz = bulk * nz;
    xx = xx + kx * nx, xy = xy + kx * ny, xz = xz + kx * nz;
    yy = yy + ky * ny, yz = yz + ky * nz, zz = zz + kz * nz;
    if constexpr (kWanted == Wanted::kBothAveraged) store_rows(nx, ny, nz, normals);
  }

  /// What the volumes around the vertex add.
  inline void add_around(const Around& around, unsigned begin) {
    Lanes x, y, z;
    load_points(around.rows + std::size_t{4} * begin, kRows, x, y, z);
    store(x, around.x + begin);
    store(y, around.y + begin);
    store(z, around.z + begin);
    const Lanes pressure = load(around.pressure + begin), stiffness = load(around.stiffness + begin);
    gx = gx + pressure * x, gy = gy + pressure * y, gz = gz + pressure * z;
    const Lanes kx = stiffness * x, ky = stiffness * y, kz = stiffness * z;
    xx = xx + kx * x, xy = xy + kx * y, xz = xz + kx * z;
    yy = yy + ky * y, yz = yz + ky * z, zz = zz + kz * z;
  }
};

/// Sums what the tets between a vertex and each neighbour do. Each tet has three other corners: its share in the
/// vertex' own volume is a third of all.
inline void find_around(const Descent& d, std::uint32_t vertex, const Around& around) {
  const NeighbourList& list = d.neighbours[vertex];
  const std::uint32_t* slots = d.neighbour_slots + list.first;
  const std::uint16_t* ends = d.rings + list.first_ring;
  const std::uint16_t* ring = ends + list.count;
  for (unsigned i = 0; i <= list.count; ++i) {  // first: a machine waits where it reads at once what it wrote in parts
    around.stiffness[i] = d.node_stiffnesses[slots[i]];
    around.pressure[i] = d.pressures[slots[i]];
  }
  Row own = row_of(0);
  const std::uint16_t* lane = ring;
  const float* normals = around.normals;
  for (unsigned i = 0; i < list.count; ++i) {
    Row change = row_of(0), odd = row_of(0);
    const std::uint16_t* end = ring + ends[i];
    for (; lane + 1 < end; lane += 2) {
      change = change + load_row(normals + lane[0]);
      odd = odd + load_row(normals + lane[1]);
    }
    if (lane < end) change = change + load_row(normals + *lane++);
    change = change + odd;
    own = own + change;
    store_row(change, around.rows + std::size_t{4} * i);
  }
  store_row(own * row_of(1.0F / 3), around.rows + std::size_t{4} * list.count);
  for (unsigned i = list.count + 1U; i % kLanes != 0; ++i) {
    around.stiffness[i] = around.pressure[i] = 0;
    store_row(row_of(0), around.rows + std::size_t{4} * i);
  }
}

/// Brings the pressures around a vertex up to date that has moved.
inline void settle_pressures(const Descent& d, std::uint32_t vertex, const Around& around, const float* moved) {
  const NeighbourList& list = d.neighbours[vertex];
  const std::uint32_t* slots = d.neighbour_slots + list.first;
  const Lanes x = all(moved[0]), y = all(moved[1]), z = all(moved[2]);
  for (unsigned begin = 0; begin <= list.count; begin += kLanes) {
    const Lanes way = (load(around.x + begin) * x + load(around.y + begin) * y) + load(around.z + begin) * z;
    store(load(around.pressure + begin) + load(around.stiffness + begin) * way, around.pressure + begin);
  }
  for (unsigned i = 0; i <= list.count; ++i) d.pressures[slots[i]] = around.pressure[i];
}

/// Inlined wherever it is called: the sweep is too slow with a call for each vertex.
template <Wanted kWanted, Law kLaw>
[[gnu::always_inline]] inline Quadratic star_quadratic(const Descent& d, std::uint32_t vertex, const Around& around) {
  const Star& star = d.stars[vertex];
  const float* place = d.places + std::size_t{4} * vertex;
  const Lanes x = all(place[0]), y = all(place[1]), z = all(place[2]);
  StarSum sum(all(0));
  const StarBlock* block = d.blocks + star.first;
  const StiffeningBlock* stiffening = kLaw != Law::kSoft ? d.stiffening + star.first : nullptr;
  const FibreBlock* fibres = kLaw == Law::kFibres ? d.fibres + star.first : nullptr;
  float* normals = around.normals;
  for (std::uint32_t i = star.used_blocks(); i > 0; --i, ++block) {
    sum.template add<kWanted, kLaw>(*block, stiffening, fibres, d, x, y, z, place[3], normals);
    if constexpr (kLaw != Law::kSoft) ++stiffening;
    if constexpr (kLaw == Law::kFibres) ++fibres;
    if constexpr (kWanted == Wanted::kBothAveraged) normals += std::size_t{4} * kLanes;
  }
  if constexpr (kWanted == Wanted::kBothAveraged) {
    find_around(d, vertex, around);
    for (unsigned begin = 0; begin <= d.neighbours[vertex].count; begin += kLanes) sum.add_around(around, begin);
  }
  float s[12];
  sum_lanes(sum.gx, sum.gy, sum.gz, sum.xx, s);
  const auto wide = [&](unsigned i) { return static_cast<double>(s[i]); };
  if constexpr (!with_curvature(kWanted)) return {{wide(0), wide(1), wide(2)}, {}};
  sum_lanes(sum.xy, sum.xz, sum.yy, sum.yz, s + 4);
  sum_lanes(sum.zz, sum.zz, sum.zz, sum.zz, s + 8);
  return {{wide(0), wide(1), wide(2)}, {wide(3), wide(4), wide(5), wide(6), wide(7), wide(8)}};
}

inline void add_inertia(const Motion& motion, const float* x, Quadratic& q) {
  for (unsigned i = 0; i < 3; ++i) {
    const double moved = static_cast<double>(x[i]) - static_cast<double>(motion.start[i]);
    q.slope[i] += motion.weight * (moved - static_cast<double>(motion.aim[i]));
  }
  const double stiffness = motion.weight + motion.diagonal;
  q.curvature[0] += stiffness;
  q.curvature[3] += stiffness;
  q.curvature[5] += stiffness;
}

template <Wanted kWanted, Law kLaw>
[[gnu::always_inline]] inline Quadratic whole_quadratic(const Descent& d, std::uint32_t vertex,
                                                        const Around& around = {}) {
  const Motion& motion = d.motions[vertex];
  const float* x = d.places + std::size_t{4} * vertex;
  Quadratic q = star_quadratic<kWanted, kLaw>(d, vertex, around);
  add_inertia(motion, x, q);
  if (motion.pulls > 0) add_pulls(d, motion, q);
  if (motion.contacts > 0) add_contacts(d, motion, q);
  return q;
}

/// The step to the least of a quadratic, by cofactors in double precision: single precision fails on slivers.
inline bool least_of(const Quadratic& q, std::array<double, 3>& step) {
  const auto& [xx, xy, xz, yy, yz, zz] = q.curvature;
  const double c00 = yy * zz - yz * yz, c01 = xz * yz - xy * zz, c02 = xy * yz - xz * yy;
  const double c11 = xx * zz - xz * xz, c12 = xy * xz - xx * yz, c22 = xx * yy - xy * xy;
  const double determinant = xx * c00 + xy * c01 + xz * c02;
  const double by = -1 / determinant;
  const auto& [gx, gy, gz] = q.slope;
  step[0] = by * (c00 * gx + c01 * gy + c02 * gz);
  step[1] = by * (c01 * gx + c11 * gy + c12 * gz);
  step[2] = by * (c02 * gx + c12 * gy + c22 * gz);
  const double fall = gx * step[0] + gy * step[1] + gz * step[2];
  return determinant > 0 && fall < 0;  // rounding may turn it uphill, or into no number
}

/// Writes a place at once: the next vertex reads it at once, and a machine cannot hand on what was stored in parts.
inline void put(float x, float y, float z, float pressure, float* place) {
  using FourFloats = float __attribute__((vector_size(16)));
  const FourFloats row = {x, y, z, pressure};
  std::memcpy(place, &row, sizeof row);
}

/// Moves a vertex to its least energy, at most as far as it may go: on the way there the energy falls all along.
inline void descend(const Quadratic& q, double reach, float* x) {
  std::array<double, 3> step;
  if (!least_of(q, step)) return;
  const double length2 = step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
  const double scale = length2 > reach * reach ? reach / std::sqrt(length2) : 1.0;
  const auto moved = [&](unsigned i) { return static_cast<float>(static_cast<double>(x[i]) + scale * step[i]); };
  put(moved(0), moved(1), moved(2), x[3], x);
}

/// The quadratic's value at the start of the substep, against that where the vertex is.
inline double value_at_start(const Quadratic& q, const Motion& motion, const float* x) {
  std::array<double, 3> d;
  for (unsigned i = 0; i < 3; ++i) d[i] = static_cast<double>(motion.start[i]) - static_cast<double>(x[i]);
  const auto& [xx, xy, xz, yy, yz, zz] = q.curvature;
  const double bent = xx * d[0] * d[0] + yy * d[1] * d[1] + zz * d[2] * d[2] +
                      2 * (xy * d[0] * d[1] + xz * d[0] * d[2] + yz * d[1] * d[2]);
  return q.slope[0] * d[0] + q.slope[1] * d[1] + q.slope[2] * d[2] + 0.5 * bent;
}

/// Stars are longer than what the machine fetches ahead by itself.
inline void fetch(const Descent& d, std::uint32_t vertex) {
  const Star& star = d.stars[vertex];
  const auto* line = reinterpret_cast<const char*>(d.blocks + star.first);
  const char* end = line + star.used_blocks() * sizeof(StarBlock);
  for (; line < end; line += 64) __builtin_prefetch(line);
}

/// Hands the quadratic to `move`, which may move the vertex; pressures are kept up with it.
template <Law kLaw, class Move>
[[gnu::always_inline]] inline void visit_averaged(const Descent& d, std::uint32_t v, const Around& around,
                                                  const Move& move) {
  float* x = d.places + std::size_t{4} * v;
  const Quadratic q = whole_quadratic<Wanted::kBothAveraged, kLaw>(d, v, around);
  const float before[3] = {x[0], x[1], x[2]};
  move(q, x);
  const float moved[3] = {x[0] - before[0], x[1] - before[1], x[2] - before[2]};
  settle_pressures(d, v, around, moved);
}

constexpr std::uint32_t kMostBlocks = 24;  // of stars whose scratch is not allocated
constexpr std::size_t columns_of(std::uint32_t neighbours) {
  return (neighbours / kLanes + 1) * kLanes;
}
constexpr std::size_t kMostColumns = columns_of(std::uint32_t{kMostBlocks} * kLanes / 2);

inline Around lay_out(float* normals, float* columns, std::size_t count) {
  return {normals,
          columns,
          columns + 4 * count,
          columns + 5 * count,
          columns + 6 * count,
          columns + 7 * count,
          columns + 8 * count};
}

template <Law kLaw, class Move>
void visit_large(const Descent& d, std::uint32_t v, const Move& move) {
  const std::size_t count = columns_of(d.neighbours[v].count);
  std::vector<float> normals(std::size_t{4} * kLanes * d.stars[v].used_blocks()), columns(9 * count);
  visit_averaged<kLaw>(d, v, lay_out(normals.data(), columns.data(), count), move);
}

template <bool kAveraged, Law kLaw, class Move>
[[gnu::always_inline]] inline void visit(const Descent& d, std::uint32_t v, const Move& move) {
  if constexpr (kAveraged) {
    if (d.stars[v].used_blocks() > kMostBlocks || d.neighbours[v].count >= kMostColumns) {
      visit_large<kLaw>(d, v, move);
      return;
    }
    alignas(32) float normals[std::size_t{4} * kLanes * kMostBlocks];
    alignas(32) float columns[9 * kMostColumns];
    visit_averaged<kLaw>(d, v, lay_out(normals, columns, kMostColumns), move);
  } else {
    move(whole_quadratic<Wanted::kBoth, kLaw>(d, v), d.places + std::size_t{4} * v);
  }
}

/// Calls `work.operator()<is averaged, law>()` as the body is.
template <bool kAveraged, class Work>
[[gnu::always_inline]] inline void for_law(const Descent& d, const Work& work) {
  if (d.fibres != nullptr) {
    work.template operator()<kAveraged, Law::kFibres>();
  } else if (d.stiffening != nullptr) {
    work.template operator()<kAveraged, Law::kStiffening>();
  } else {
    work.template operator()<kAveraged, Law::kSoft>();
  }
}
template <class Work>
[[gnu::always_inline]] inline void for_kind(const Descent& d, const Work& work) {
  d.node_stiffnesses != nullptr ? for_law<true>(d, work) : for_law<false>(d, work);
}

template <bool kAveraged, Law kLaw>
inline void sweep_each(const Descent& d, std::span<const std::uint32_t> order, bool is_backward) {
  const std::size_t count = order.size();
  const auto at = [&](std::size_t i) { return order[is_backward ? count - 1 - i : i]; };
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t v = at(i);
    if (i + kFetchAhead < count) fetch(d, at(i + kFetchAhead));
    if (d.motions[v].is_rigid) continue;
    visit<kAveraged, kLaw>(
        d, v, [&](const Quadratic& q, float* x) { descend(q, static_cast<double>(d.motions[v].reach), x); });
  }
}

void sweep_all(const Descent& d, std::span<const std::uint32_t> order, bool is_backward) {
  for_kind(d, [&]<bool kAveraged, Law kLaw>() { sweep_each<kAveraged, kLaw>(d, order, is_backward); });
}

template <bool kAveraged, Law kLaw>
inline void pick_each(const Descent& d, std::span<const std::uint32_t> order) {
  for (const std::uint32_t v : order) {
    const Motion& motion = d.motions[v];
    if (!motion.leaps || motion.is_rigid) continue;
    visit<kAveraged, kLaw>(d, v, [&](const Quadratic& q, float* x) {
      if (value_at_start(q, motion, x) < 0) put(motion.start[0], motion.start[1], motion.start[2], x[3], x);
    });
  }
}

void pick_all(const Descent& d, std::span<const std::uint32_t> order) {
  for_kind(d, [&]<bool kAveraged, Law kLaw>() { pick_each<kAveraged, kLaw>(d, order); });
}

template <Wanted kWanted, Law kLaw>
inline void slopes_of_each(const Descent& d, std::span<const std::uint32_t> order, float* slopes) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + kFetchAhead < order.size()) fetch(d, order[i + kFetchAhead]);
    const std::array<double, 3> slope = whole_quadratic<kWanted, kLaw>(d, order[i]).slope;
    put(static_cast<float>(slope[0]), static_cast<float>(slope[1]), static_cast<float>(slope[2]), 0,
        slopes + std::size_t{4} * order[i]);
  }
}

void slopes_of_all(const Descent& d, std::span<const std::uint32_t> order, float* slopes) {
  for_kind(d, [&]<bool kAveraged, Law kLaw>() {
    slopes_of_each<kAveraged ? Wanted::kSlopeAveraged : Wanted::kSlope, kLaw>(d, order, slopes);
  });
}

/// Six volumes of the tets of a star that take part in its average.
inline float star_volume(const Descent& d, const Star& star, const float* place) {
  const Lanes x = all(place[0]), y = all(place[1]), z = all(place[2]);
  Lanes volumes = all(0);
  const StarBlock* block = d.blocks + star.first;
  for (std::uint32_t i = star.used_blocks(); i > 0; --i, ++block) {
    Lanes ax, ay, az, bx, by, bz, cx, cy, cz;
    load_points(d.places, block->a.data(), ax, ay, az);
    load_points(d.places, block->b.data(), bx, by, bz);
    load_points(d.places, block->c.data(), cx, cy, cz);
    ax = ax - x, ay = ay - y, az = az - z;
    bx = bx - x, by = by - y, bz = bz - z;
    cx = cx - x, cy = cy - y, cz = cz - z;
    const Lanes volume6 = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    volumes = volumes + where_positive(load(block->pressure.data()), volume6);
  }
  float s[4];
  sum_lanes(volumes, volumes, volumes, volumes, s);
  return s[0];
}

void pressures_of_all(const Descent& d, std::span<const std::uint32_t> vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (i + kFetchAhead < vertices.size()) fetch(d, vertices[i + kFetchAhead]);
    const std::uint32_t v = vertices[i];
    const float* place = d.places + std::size_t{4} * v;
    const float k = d.node_stiffnesses[v];
    d.pressures[v] = k > 0 ? k * (star_volume(d, d.stars[v], place) - d.rest_volumes[v]) : 0.0F;
  }
}

/// A corner's share in a tet's energy: a quarter of what its volume takes, half of what its own edges do, so that all
/// four make it up.
inline double star_energy(const Descent& d, const Star& star, const float* place) {
  const Lanes x = all(place[0]), y = all(place[1]), z = all(place[2]);
  Lanes swelling = all(0), stretch = all(0);
  const StarBlock* block = d.blocks + star.first;
  for (std::uint32_t i = star.used_blocks(); i > 0; --i, ++block) {
    Lanes ax, ay, az, bx, by, bz, cx, cy, cz;
    load_points(d.places, block->a.data(), ax, ay, az);
    load_points(d.places, block->b.data(), bx, by, bz);
    load_points(d.places, block->c.data(), cx, cy, cz);
    ax = ax - x, ay = ay - y, az = az - z;
    bx = bx - x, by = by - y, bz = bz - z;
    cx = cx - x, cy = cy - y, cz = cz - z;
    const Lanes volume6 = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    const Lanes half = load(block->bulk.data()) * volume6 * all(0.5F);
    swelling = swelling + (half - absolute(load(block->pressure.data()))) * volume6;
    stretch = stretch + (load(block->to_a.data()) * (ax * ax + ay * ay + az * az) +
                         (load(block->to_b.data()) * (bx * bx + by * by + bz * bz) +
                          load(block->to_c.data()) * (cx * cx + cy * cy + cz * cz)));
  }
  float s[4];
  sum_lanes(swelling, stretch, stretch, stretch, s);
  return 0.25 * (static_cast<double>(s[0]) - static_cast<double>(s[1]));
}

/// The same where tissue stiffens: a quarter of each tet's energy.
template <bool kHasFibres>
inline double stiff_star_energy(const Descent& d, const Star& star, const float* place) {
  const Lanes x = all(place[0]), y = all(place[1]), z = all(place[2]);
  Lanes energy = all(0);
  const StarBlock* block = d.blocks + star.first;
  const StiffeningBlock* more = d.stiffening + star.first;
  for (std::uint32_t i = 0; i < star.used_blocks(); ++i, ++block, ++more) {
    Lanes ax, ay, az, bx, by, bz, cx, cy, cz;
    load_points(d.places, block->a.data(), ax, ay, az);
    load_points(d.places, block->b.data(), bx, by, bz);
    load_points(d.places, block->c.data(), cx, cy, cz);
    ax = ax - x, ay = ay - y, az = az - z;
    bx = bx - x, by = by - y, bz = bz - z;
    cx = cx - x, cy = cy - y, cz = cz - z;
    const Lanes ux = bx - ax, uy = by - ay, uz = bz - az, wx = cx - ax, wy = cy - ay, wz = cz - az;
    const Lanes vx = wx - ux, vy = wy - uy, vz = wz - uz;
    const Lanes volume6 = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    const Lanes half = load(block->bulk.data()) * volume6 * all(0.5F);
    Lanes swelling = (half - absolute(load(block->pressure.data()))) * volume6;
    if constexpr (kHasFibres) {
      const FibreLanes fibres(d.fibres[star.first + i], ax, ay, az, bx, by, bz, cx, cy, cz);
      swelling = swelling + fibres.energy();
    }
    const StiffLanes stiff(*block, *more, swelling, ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz,
                           cx * cx + cy * cy + cz * cz, ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz,
                           wx * wx + wy * wy + wz * wz);
    energy = energy + stiff.energy();
  }
  float s[4];
  sum_lanes(energy, energy, energy, energy, s);
  return 0.25 * static_cast<double>(s[0]);
}

void add_energies(const Descent& d, std::span<const std::uint32_t> order, double& sum) {
  if (d.fibres != nullptr) {
    for (const std::uint32_t v : order) sum += stiff_star_energy<true>(d, d.stars[v], d.places + std::size_t{4} * v);
    return;
  }
  if (d.stiffening != nullptr) {
    for (const std::uint32_t v : order) sum += stiff_star_energy<false>(d, d.stars[v], d.places + std::size_t{4} * v);
    return;
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + kFetchAhead < order.size()) fetch(d, order[i + kFetchAhead]);
    sum += star_energy(d, d.stars[order[i]], d.places + std::size_t{4} * order[i]);
  }
}

void find_quadratic(const Descent& d, std::uint32_t vertex, Quadratic& quadratic) {
  const auto copy = [&](const Quadratic& q, float* /*x*/) { quadratic = q; };
  for_kind(d, [&]<bool kAveraged, Law kLaw>() { visit<kAveraged, kLaw>(d, vertex, copy); });
}

}  // namespace INCISE_LANES_NAMESPACE
}  // namespace detail
}  // namespace v0
}  // namespace incise
#if INCISE_WITH_HIGHWAY
HWY_AFTER_NAMESPACE();
#endif

#if !INCISE_WITH_HIGHWAY || HWY_ONCE
namespace incise {
inline namespace v0 {
namespace detail {

#if INCISE_WITH_HIGHWAY
HWY_EXPORT(sweep_all);
HWY_EXPORT(pick_all);
HWY_EXPORT(slopes_of_all);
HWY_EXPORT(add_energies);
HWY_EXPORT(find_quadratic);
HWY_EXPORT(pressures_of_all);
#define INCISE_DISPATCH(function) HWY_DYNAMIC_DISPATCH(function)
#else
#define INCISE_DISPATCH(function) plain::function
#endif

namespace {

/// A spring that gives way at a limit: stiffness, its secant's, and energy at a length.
struct Yielding {
  double force, tangent, secant, energy;
};
Yielding yielding(double stiffness, double limit, double length) {
  const double force = stiffness * length;
  if (force <= limit) return {force, stiffness, stiffness, 0.5 * force * length};
  return {limit, 0, limit / length, limit * (length - 0.5 * limit / stiffness)};
}

}  // namespace

Mat3 PullState::curvature(const PullTerm& term) const {
  if (!term.has_axis) return stiffness * Mat3::Identity();
  Mat3 along = stiffness * (term.axis * term.axis.transpose());
  if (across > 0) along += across * (Mat3::Identity() - term.axis * term.axis.transpose());
  return along;
}

/// Stiff in all directions, although across it is not: k/2 |x − y|², where y is the point nearest to x of those without
/// force, lies above the tie's energy everywhere and touches it at x. So a visit never goes uphill.
static PullState tie_state(const PullTerm& term, const Vec3& off) {
  const double length = off.norm(), over = length - term.rest_length;
  if (!(term.stiffness > 0) || (term.pulls_only && over <= 0)) return {};
  const double force = term.stiffness * over;
  return {length > 0 ? Vec3(force / length * off) : Vec3(Vec3::Zero()), term.stiffness, 0, 0.5 * force * over};
}

PullState pull_state(const PullTerm& term, const Vec3& off) {
  if (term.is_tie()) return tie_state(term, off);
  if (!term.has_axis) {
    const double length = off.norm();
    if (!(term.stiffness * length > term.limit)) {
      return {term.stiffness * off, term.stiffness, 0, 0.5 * term.stiffness * off.squaredNorm()};
    }
    const Yielding spring = yielding(term.stiffness, term.limit, length);
    return {spring.secant * off, spring.secant, 0, spring.energy};
  }
  PullState state;
  const double along = term.axis.dot(off);
  if (term.drag > 0 && term.stiffness > 0) {
    const Vec3 from = off - term.anchor, slip = from - term.axis.dot(from) * term.axis;
    const Yielding drag = yielding(term.stiffness, term.drag, slip.norm());
    state = {drag.secant * slip, 0, drag.secant, drag.energy};
  }
  if ((term.pushes_only && along >= 0) || !(term.stiffness > 0)) return state;
  const Yielding spring = yielding(term.stiffness, term.limit, std::abs(along));
  state.slope += (along < 0 ? -spring.force : spring.force) * term.axis;
  state.stiffness = spring.tangent;
  state.energy += spring.energy;
  return state;
}

Vec3 off_target(const PullTerm& term, const float* places) {
  Vec3 off = -term.target;
  for (unsigned i = 0; i < term.corners; ++i) {
    if (term.weights[i] == 0) continue;
    const float* p = places + std::size_t{4} * term.vertices[i];
    off += term.weights[i] * Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  }
  return off;
}

void add_pulls(const Descent& descent, const Motion& motion, Quadratic& q) {
  for (std::uint32_t i = 0; i < motion.pulls; ++i) {
    const PullUse& use = descent.uses[motion.first_pull + i];
    const PullTerm& term = descent.terms[use.term];
    const PullState pull = pull_state(term, off_target(term, descent.places));
    const Mat3 bend = use.weight * use.weight * pull.curvature(term);
    for (int k = 0; k < 3; ++k) q.slope[static_cast<std::size_t>(k)] += use.weight * pull.slope[k];
    const std::array<double, 6> upper = {bend(0, 0), bend(0, 1), bend(0, 2), bend(1, 1), bend(1, 2), bend(2, 2)};
    for (unsigned k = 0; k < 6; ++k) q.curvature[k] += upper[k];
  }
}

void find_pressures(const Descent& descent, std::span<const std::uint32_t> vertices) {
  INCISE_DISPATCH(pressures_of_all)(descent, vertices);
}

void sweep(const Descent& descent, std::span<const std::uint32_t> order, bool is_backward) {
  INCISE_DISPATCH(sweep_all)(descent, order, is_backward);
}

void pick_starts(const Descent& descent, std::span<const std::uint32_t> order) {
  INCISE_DISPATCH(pick_all)(descent, order);
}

void find_slopes(const Descent& descent, std::span<const std::uint32_t> order, float* slopes) {
  INCISE_DISPATCH(slopes_of_all)(descent, order, slopes);
}

double energy_share(const Descent& descent, std::span<const std::uint32_t> order) {
  double sum = 0;
  INCISE_DISPATCH(add_energies)(descent, order, sum);
  return sum;
}

Quadratic quadratic_of(const Descent& descent, std::uint32_t vertex) {
  Quadratic quadratic;
  INCISE_DISPATCH(find_quadratic)(descent, vertex, quadratic);
  return quadratic;
}

}  // namespace detail
}  // namespace v0
}  // namespace incise
#endif
