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
#include "sim/body/constants.h"
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

constexpr bool is_averaged(Wanted wanted) {
  return wanted == Wanted::kSlopeAveraged || wanted == Wanted::kBothAveraged;
}
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
};

constexpr std::uint32_t kRows[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7};

/// The neighbours of a vertex, from it, in rows that go by their codes.
struct Many {
  const float* rows;

  inline void corner(const std::uint8_t* codes, Lanes& x, Lanes& y, Lanes& z) const {
    load_points(rows, codes, x, y, z);
  }
  inline void corner(const std::uint8_t* codes, Lanes& x, Lanes& y, Lanes& z, Lanes& pressure) const {
    load_rows(rows, codes, x, y, z, pressure);
  }
};

#ifdef INCISE_LANES_PICK
/// At most 16 of them, as columns.
struct Few {
  Lanes x[2], y[2], z[2], pressure[2];

  HWY_INLINE void corner(const std::uint8_t* codes, Lanes& cx, Lanes& cy, Lanes& cz) const {
    const Codes which = load_codes(codes);
    cx = pick(x, which), cy = pick(y, which), cz = pick(z, which);
  }
  HWY_INLINE void corner(const std::uint8_t* codes, Lanes& cx, Lanes& cy, Lanes& cz, Lanes& cp) const {
    corner(codes, cx, cy, cz);
    cp = pick(pressure, load_codes(codes));
  }
};
#endif

/// Slope and curvature of a star, summed lane by lane.
struct StarSum {
  Lanes gx, gy, gz, xx, xy, xz, yy, yz, zz;
  Lanes volume;  ///< six volumes of what takes part in the vertex' average

  // Written out: a constructor that the compiler makes is not compiled for the instruction set at hand.
  inline explicit StarSum(const Lanes& zero)
      : gx(zero), gy(zero), gz(zero), xx(zero), xy(zero), xz(zero), yy(zero), yz(zero), zz(zero), volume(zero) {}

  /// Tissue that does not stiffen: what neighbours do by the Laplacian.
  [[gnu::always_inline]] inline void add_stretch(const NearLanes& near, const Lanes& x, const Lanes& y,
                                                 const Lanes& z) {
    const Lanes weight = load(near.weight.data());
    gx = gx + weight * x, gy = gy + weight * y, gz = gz + weight * z;
  }

  /// And what its tets do by their volumes.
  template <Wanted kWanted, class Near>
  [[gnu::always_inline]] inline void add_swelling(const TetLanes& tets, const Near& near, float own_pressure) {
    Lanes ax, ay, az, bx, by, bz, cx, cy, cz;
    Lanes of_nodes = all(own_pressure);
    if constexpr (is_averaged(kWanted)) {
      Lanes pa, pb, pc;
      near.corner(tets.a.data(), ax, ay, az, pa);
      near.corner(tets.b.data(), bx, by, bz, pb);
      near.corner(tets.c.data(), cx, cy, cz, pc);
      of_nodes = (pa + pb) + (pc + of_nodes);
    } else {
      near.corner(tets.a.data(), ax, ay, az);
      near.corner(tets.b.data(), bx, by, bz);
      near.corner(tets.c.data(), cx, cy, cz);
    }
    const Lanes ux = bx - ax, uy = by - ay, uz = bz - az, wx = cx - ax, wy = cy - ay, wz = cz - az;
    // The slope of six volumes in the vertex, and the volumes themselves, below 0.
    const Lanes nx = uz * wy - uy * wz, ny = ux * wz - uz * wx, nz = uy * wx - ux * wy;
    const Lanes less = nx * ax + ny * ay + nz * az;
    const Lanes bulk = load(tets.bulk.data()), pressure = load(tets.pressure.data());
    Lanes shrink = bulk * less + absolute(pressure);
    if constexpr (is_averaged(kWanted)) shrink = shrink - where_positive(pressure, of_nodes);
    if constexpr (kWanted == Wanted::kBothAveraged) volume = volume - where_positive(pressure, less);
    gx = gx - shrink * nx, gy = gy - shrink * ny, gz = gz - shrink * nz;
    if constexpr (!with_curvature(kWanted)) return;
    Lanes bent = bulk;
    if constexpr (kWanted == Wanted::kBothAveraged) bent = bent * load_powers(tets.bend.data());
    const Lanes kx = bent * nx, ky = bent * ny, kz = bent * nz;
    xx = xx + kx * nx, xy = xy + kx * ny, xz = xz + kx * nz;
    yy = yy + ky * ny, yz = yz + ky * nz, zz = zz + kz * nz;
  }

  /// Both, of tissue that stiffens or has fibres.
  template <Wanted kWanted, Law kLaw, class Near>
  [[gnu::always_inline]] inline void add_stiff(const TetLanes& tets, const StarBlock& block,
                                               const StiffeningBlock& stiffening,
                                               [[maybe_unused]] const FibreBlock* fibre_block, const Near& near,
                                               float own_pressure) {
    Lanes ax, ay, az, bx, by, bz, cx, cy, cz;
    Lanes of_nodes = all(own_pressure);
    if constexpr (is_averaged(kWanted)) {
      Lanes pa, pb, pc;
      near.corner(tets.a.data(), ax, ay, az, pa);
      near.corner(tets.b.data(), bx, by, bz, pb);
      near.corner(tets.c.data(), cx, cy, cz, pc);
      of_nodes = (pa + pb) + (pc + of_nodes);
    } else {
      near.corner(tets.a.data(), ax, ay, az);
      near.corner(tets.b.data(), bx, by, bz);
      near.corner(tets.c.data(), cx, cy, cz);
    }
    const Lanes ux = bx - ax, uy = by - ay, uz = bz - az, wx = cx - ax, wy = cy - ay, wz = cz - az;
    // The slope of six volumes in the vertex, and the volumes themselves.
    const Lanes nx = uz * wy - uy * wz, ny = ux * wz - uz * wx, nz = uy * wx - ux * wy;
    const Lanes volume6 = all(0) - (nx * ax + ny * ay + nz * az);
    const Lanes bulk = load(tets.bulk.data()), pressure = load(tets.pressure.data());
    const Lanes swell = bulk * volume6 - absolute(pressure);
    const Lanes to_a = load(block.to_a.data()), to_b = load(block.to_b.data()), to_c = load(block.to_c.data());
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
    const StiffLanes stiff(block, stiffening, swelling, ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz,
                           cx * cx + cy * cy + cz * cz, ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz,
                           wx * wx + wy * wy + wz * wz);
    const Lanes factor = stiff.factor();
    gx = gx + factor * sx, gy = gy + factor * sy, gz = gz + factor * sz;
    if constexpr (is_averaged(kWanted)) {
      const Lanes shared = where_positive(pressure, of_nodes);
      gx = gx + shared * nx, gy = gy + shared * ny, gz = gz + shared * nz;
    }
    if constexpr (kWanted == Wanted::kBothAveraged) volume = volume + where_positive(pressure, volume6);
    if constexpr (!with_curvature(kWanted)) return;
    // The Laplacian's diagonal is in the vertex' own, but for what the factor adds.
    Lanes more = (all(1) - factor) * (to_a + (to_b + to_c));
    const Lanes growth = stiff.growth(stiffening);
    Lanes bent = factor * bulk;
    if constexpr (kWanted == Wanted::kBothAveraged) bent = bent + bulk * (load_powers(tets.bend.data()) - all(1));
    const Lanes kx = bent * nx, ky = bent * ny, kz = bent * nz;
    const Lanes tx = growth * sx, ty = growth * sy, tz = growth * sz;
    if constexpr (kLaw == Law::kFibres) {
      more = more + factor * across;
      xx = xx + factor * pull_x * fx, xy = xy + factor * pull_x * fy, xz = xz + factor * pull_x * fz;
      yy = yy + factor * pull_y * fy, yz = yz + factor * pull_y * fz, zz = zz + factor * pull_z * fz;
    }
    xx = xx + (kx * nx + tx * sx) + more, xy = xy + (kx * ny + tx * sy), xz = xz + (kx * nz + tx * sz);
    yy = yy + (ky * ny + ty * sy) + more, yz = yz + (ky * nz + ty * sz), zz = zz + (kz * nz + tz * sz) + more;
  }
};

/// Takes the neighbours of a part of a star into rows that go by their codes.
struct NearRows {
  alignas(32) float rows[std::size_t{4} * kMostNear];

  /// One block of them, which are returned as columns as well.
  inline void take(const float* places, const NearLanes& near, std::uint32_t block, const Row& centre, Lanes& x,
                   Lanes& y, Lanes& z) {
    float* out = rows + std::size_t{4} * near_code(block, 0);
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      store_row(load_row(places + near.place[i]) - centre, out + std::size_t{4} * i);
    }
    load_points(out, kRows, x, y, z);
  }
};

inline Row place_row(const float* place) {
  const float row[4] = {place[0], place[1], place[2], 0};  // pressures of neighbours stay as they are
  return load_row(row);
}

#ifdef INCISE_LANES_PICK
/// Takes one of the two blocks of neighbours that a small star has at most.
inline void take_few(const float* places, const NearLanes& near, const Lanes& x, const Lanes& y, const Lanes& z,
                     unsigned block, Few& few) {
  Lanes at_x, at_y, at_z;
  load_at(places, near.place.data(), at_x, at_y, at_z, few.pressure[block]);
  few.x[block] = at_x - x, few.y[block] = at_y - y, few.z[block] = at_z - z;
}
#endif

// Of a lambda that is called for each block.
#undef INCISE_INLINED
#define INCISE_INLINED __attribute__((always_inline))

/// Calls `on_near(block of neighbours, x, y, z)` and `on_tets(block of tets, its number in the star, all neighbours)`
/// for a star, part by part. Places are from the vertex.
template <class OnNear, class OnTets>
[[gnu::always_inline]] inline void read_star(const Descent& d, std::uint32_t vertex, const OnNear& on_near,
                                             const OnTets& on_tets) {
  const float* place = d.places + std::size_t{4} * vertex;
  const PackedStar* part = d.packed + vertex;
#ifdef INCISE_LANES_PICK
  if (part->is_small()) {
    const NearLanes* near = d.near + part->first_near;
    const Lanes x = all(place[0]), y = all(place[1]), z = all(place[2]);
    Few few;
    take_few(d.places, near[0], x, y, z, 0, few);
    on_near(near[0], few.x[0], few.y[0], few.z[0]);
    if (part->near > 1) {
      take_few(d.places, near[1], x, y, z, 1, few);
      on_near(near[1], few.x[1], few.y[1], few.z[1]);
    } else {
      few.x[1] = few.x[0], few.y[1] = few.y[0], few.z[1] = few.z[0], few.pressure[1] = few.pressure[0];
    }
    for (std::uint32_t i = 0; i < part->tets; ++i) on_tets(d.tets[part->first_tets + i], i, few);
    return;
  }
#endif
  NearRows rows;
  const Row centre = place_row(place);
  for (std::uint32_t number = 0;; part = d.parts + part->next) {
    for (std::uint32_t i = 0; i < part->near; ++i) {
      const NearLanes& near = d.near[part->first_near + i];
      Lanes x, y, z;
      rows.take(d.places, near, i, centre, x, y, z);
      on_near(near, x, y, z);
    }
    const Many many{rows.rows};
    for (std::uint32_t i = 0; i < part->tets; ++i) on_tets(d.tets[part->first_tets + i], number++, many);
    if (part->next == 0) return;
  }
}
inline Floats four(const void* from) {
  Floats row;
  std::memcpy(&row, from, sizeof row);
  return row;
}

/// Writes a place at once: the next vertex reads it at once, and a machine cannot hand on what was stored in parts.
inline void put(const Floats& row, float* place) {
  std::memcpy(place, &row, sizeof row);
}

/// Rows to columns or back.
inline void transpose(Floats& r0, Floats& r1, Floats& r2, Floats& r3) {
  const Floats xy01 = __builtin_shufflevector(r0, r1, 0, 4, 1, 5), zw01 = __builtin_shufflevector(r0, r1, 2, 6, 3, 7);
  const Floats xy23 = __builtin_shufflevector(r2, r3, 0, 4, 1, 5), zw23 = __builtin_shufflevector(r2, r3, 2, 6, 3, 7);
  r0 = __builtin_shufflevector(xy01, xy23, 0, 1, 4, 5);
  r1 = __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7);
  r2 = __builtin_shufflevector(zw01, zw23, 0, 1, 4, 5);
  r3 = __builtin_shufflevector(zw01, zw23, 2, 3, 6, 7);
}

constexpr unsigned kBatch = 4;

/// Vertices that are visited at once: none reads what another one moves, so that this is as good as one after the
/// other. What their tets sum up to lies by number and vertex.
struct Batch {
  std::uint32_t vertices[kBatch];
  std::uint32_t places[kBatch];  ///< as `NearLanes` has them
  unsigned count;
  unsigned with_terms;                         ///< the one of them that has pulls or contacts; kBatch: none has
  alignas(32) float sums[10][kBatch][kLanes];  ///< the last: six volumes, where they are averaged

  inline void clear() {
    count = 0;
    with_terms = kBatch;
  }
  inline void add(const Descent& d, std::uint32_t vertex, const StarSum& sum, Wanted wanted) {
    store(sum.gx, sums[0][count]), store(sum.gy, sums[1][count]), store(sum.gz, sums[2][count]);
    if (with_curvature(wanted)) {
      store(sum.xx, sums[3][count]), store(sum.xy, sums[4][count]), store(sum.xz, sums[5][count]);
      store(sum.yy, sums[6][count]), store(sum.yz, sums[7][count]), store(sum.zz, sums[8][count]);
    }
    if (wanted == Wanted::kBothAveraged) store(sum.volume, sums[9][count]);
    if (has_terms(d.motions[vertex])) with_terms = count;
    places[count] = 4 * vertex;
    vertices[count++] = vertex;
  }
  /// Whether a vertex reads what is about to be moved, or may.
  [[nodiscard]] inline bool meets(const Descent& d, std::uint32_t vertex) const {
    if (count == 0) return false;
    if (with_terms < kBatch && has_terms(d.motions[vertex])) return true;
    for (const PackedStar* part = d.packed + vertex;; part = d.parts + part->next) {
      for (std::uint32_t i = 0; i < part->near; ++i) {
        if (names_any(d.near[part->first_near + i].place.data(), places, count)) return true;
      }
      if (part->next == 0) return false;
    }
  }
  [[nodiscard]] static inline bool has_terms(const Motion& motion) { return motion.pulls > 0 || motion.contacts > 0; }
  /// Of a lane: unused ones go with the first vertex.
  [[nodiscard]] inline unsigned at(unsigned lane) const { return lane < count ? lane : 0; }
  [[gnu::always_inline]] inline void sum(unsigned i, Doubles& into) const {
    alignas(16) float out[4];
    sum_lanes(load(sums[i][0]), load(sums[i][at(1)]), load(sums[i][at(2)]), load(sums[i][at(3)]), out);
    widen(four(out), into);
  }
};

/// Sums a star up into a batch. Not inlined: all visits share it, and it is long to compile.
template <Wanted kWanted, Law kLaw>
[[gnu::noinline]] void sum_star(const Descent& d, std::uint32_t vertex, Batch& batch) {
  const float* place = d.places + std::size_t{4} * vertex;
  StarSum sum(all(0));
  if constexpr (kLaw == Law::kSoft) {
    read_star(
        d, vertex,
        [&](const NearLanes& near, const Lanes& x, const Lanes& y, const Lanes& z)
            INCISE_INLINED { sum.add_stretch(near, x, y, z); },
        [&](const TetLanes& tets, std::uint32_t /*i*/, const auto& near)
            INCISE_INLINED { sum.template add_swelling<kWanted>(tets, near, place[3]); });
  } else {
    const std::size_t first = d.stars[d.slots[vertex]].first;
    read_star(
        d, vertex, [](const NearLanes&, const Lanes&, const Lanes&, const Lanes&) INCISE_INLINED {},
        [&](const TetLanes& tets, std::uint32_t i, const auto& near) INCISE_INLINED {
          const FibreBlock* fibres = kLaw == Law::kFibres ? d.fibres + first + i : nullptr;
          sum.template add_stiff<kWanted, kLaw>(tets, d.blocks[first + i], d.stiffening[first + i], fibres, near,
                                                place[3]);
        });
  }
  batch.add(d, vertex, sum, kWanted);
}

/// The quadratics of a batch.
struct Quadratics {
  Doubles gx, gy, gz, xx, xy, xz, yy, yz, zz;
  Floats x, y, z, pressure;        ///< where the vertices are
  Doubles from_x, from_y, from_z;  ///< and that from where the substep began

  /// Of stars alone, with the inertia of their vertices.
  template <bool kCurved>
  [[gnu::always_inline]] inline Quadratics(const Descent& d, const Batch& b,
                                           std::bool_constant<kCurved> /*is_curved*/) {
    b.sum(0, gx), b.sum(1, gy), b.sum(2, gz);
    const std::uint32_t v0 = b.vertices[0], v1 = b.vertices[b.at(1)], v2 = b.vertices[b.at(2)],
                        v3 = b.vertices[b.at(3)];
    const Motion &m0 = d.motions[v0], &m1 = d.motions[v1], &m2 = d.motions[v2], &m3 = d.motions[v3];
    const auto place = [&](std::uint32_t v) { return four(d.places + std::size_t{4} * v); };
    x = place(v0), y = place(v1), z = place(v2), pressure = place(v3);
    transpose(x, y, z, pressure);
    const auto bytes = [](const Motion& m) { return reinterpret_cast<const char*>(&m); };
    Floats sx = four(bytes(m0)), sy = four(bytes(m1)), sz = four(bytes(m2)), unused = four(bytes(m3));
    transpose(sx, sy, sz, unused);
    constexpr std::size_t kAim = sizeof m0.start;
    Floats ax = four(bytes(m0) + kAim), ay = four(bytes(m1) + kAim), az = four(bytes(m2) + kAim);
    unused = four(bytes(m3) + kAim);
    transpose(ax, ay, az, unused);
    const Doubles weight = {m0.weight, m1.weight, m2.weight, m3.weight};
    add_inertia(x, sx, ax, weight, from_x, gx);
    add_inertia(y, sy, ay, weight, from_y, gy);
    add_inertia(z, sz, az, weight, from_z, gz);
    if constexpr (kCurved) {
      const Doubles stiffness = weight + Doubles{m0.diagonal, m1.diagonal, m2.diagonal, m3.diagonal};
      b.sum(3, xx), b.sum(4, xy), b.sum(5, xz), b.sum(6, yy), b.sum(7, yz), b.sum(8, zz);
      xx += stiffness, yy += stiffness, zz += stiffness;
    }
    if (b.with_terms < kBatch) add_terms<kCurved>(d, d.motions[b.vertices[b.with_terms]], b.with_terms);
  }

  [[gnu::always_inline]] static inline void add_inertia(const Floats& place, const Floats& start, const Floats& aim,
                                                        const Doubles& weight, Doubles& from, Doubles& slope) {
    Doubles began, aimed;
    widen(place, from), widen(start, began), widen(aim, aimed);
    from -= began;
    slope += weight * (from - aimed);
  }
  /// What pulls and presses the vertex in a lane.
  template <bool kCurved>
  inline void add_terms(const Descent& d, const Motion& motion, unsigned k) {
    Quadratic q;
    if (motion.pulls > 0) add_pulls(d, motion, q);
    if (motion.contacts > 0) add_contacts(d, motion, q);
    gx[k] += q.slope[0], gy[k] += q.slope[1], gz[k] += q.slope[2];
    if constexpr (!kCurved) return;
    xx[k] += q.curvature[0], xy[k] += q.curvature[1], xz[k] += q.curvature[2];
    yy[k] += q.curvature[3], yz[k] += q.curvature[4], zz[k] += q.curvature[5];
  }
};

inline void fetch_lines(const void* from, std::size_t bytes) {
  const auto* line = static_cast<const char*>(from);
  for (const char* end = line + bytes; line < end; line += 64) __builtin_prefetch(line);
}

/// Stars are longer than what the machine fetches ahead by itself.
inline void fetch_star(const Descent& d, std::uint32_t vertex) {
  const PackedStar& star = d.packed[vertex];
  fetch_lines(d.near + star.first_near, star.near * sizeof(NearLanes));
  fetch_lines(d.tets + star.first_tets, star.tets * sizeof(TetLanes));
  if (d.stiffening == nullptr) return;
  const Star& whole = d.stars[d.slots[vertex]];
  for (std::uint32_t i = 0; i < whole.used_blocks(); ++i) {
    const StarBlock& block = d.blocks[whole.first + i];
    fetch_lines(&block.to_a, sizeof block.to_a + sizeof block.to_b + sizeof block.to_c);
  }
  fetch_lines(d.stiffening + whole.first, whole.used_blocks() * sizeof(StiffeningBlock));
}
/// Fetches what is visited after the vertex at `i`.
template <class At>
[[gnu::always_inline]] inline void fetch_ahead(const Descent& d, const At& at, std::size_t i, std::size_t count) {
  if (i + kFetchAhead >= count) return;
  const std::uint32_t next = at(i + kFetchAhead);
  __builtin_prefetch(d.motions + next);
  fetch_star(d, next);
}

/// Moves the vertices of a batch to their least energies, each at most as far as it may go: on the way there the energy
/// falls all along. By cofactors in double precision: single precision fails on slivers.
struct Descending {
  [[nodiscard]] inline bool takes_part(const Motion& motion) const { return !motion.is_rigid; }
  [[gnu::always_inline]] inline void move(const Descent& d, const Batch& b, const Quadratics& q, Floats* rows) const {
    const Doubles c00 = q.yy * q.zz - q.yz * q.yz, c01 = q.xz * q.yz - q.xy * q.zz, c02 = q.xy * q.yz - q.xz * q.yy;
    const Doubles c11 = q.xx * q.zz - q.xz * q.xz, c12 = q.xy * q.xz - q.xx * q.yz, c22 = q.xx * q.yy - q.xy * q.xy;
    const Doubles determinant = q.xx * c00 + q.xy * c01 + q.xz * c02;
    const Doubles by = Doubles{-1, -1, -1, -1} / determinant;
    Doubles x = by * (c00 * q.gx + c01 * q.gy + c02 * q.gz);
    Doubles y = by * (c01 * q.gx + c11 * q.gy + c12 * q.gz);
    Doubles z = by * (c02 * q.gx + c12 * q.gy + c22 * q.gz);
    const Doubles fall = q.gx * x + q.gy * y + q.gz * z, length2 = x * x + y * y + z * z;
    const auto falls =
        (determinant > Doubles{}) & (fall < Doubles{});  // rounding may turn it uphill, or into no number
    const auto reach = [&](unsigned k) { return static_cast<double>(d.motions[b.vertices[b.at(k)]].reach); };
    const Doubles most = {reach(0), reach(1), reach(2), reach(3)};
    const auto is_far = length2 > most * most;
    if ((is_far[0] | is_far[1] | is_far[2] | is_far[3]) != 0) {
      for (unsigned k = 0; k < kBatch; ++k) {
        const double scale = is_far[k] != 0 ? most[k] / std::sqrt(length2[k]) : 1.0;
        x[k] *= scale, y[k] *= scale, z[k] *= scale;
      }
    }
    const auto moved = [&](const Floats& from, const Doubles& step, Floats& to) {
      Doubles wide;
      widen(from, wide);
      narrow(falls ? wide + step : wide, to);
    };
    moved(q.x, x, rows[0]), moved(q.y, y, rows[1]), moved(q.z, z, rows[2]);
    rows[3] = q.pressure;
  }
};

/// Puts vertices back to their start where by their quadratics they cost less there.
struct Picking {
  [[nodiscard]] inline bool takes_part(const Motion& motion) const { return motion.leaps && !motion.is_rigid; }
  [[gnu::always_inline]] inline void move(const Descent& d, const Batch& b, const Quadratics& q, Floats* rows) const {
    const Doubles x = -q.from_x, y = -q.from_y, z = -q.from_z;
    const Doubles bent =
        q.xx * x * x + q.yy * y * y + q.zz * z * z + Doubles{2, 2, 2, 2} * (q.xy * x * y + q.xz * x * z + q.yz * y * z);
    const auto is_less = q.gx * x + q.gy * y + q.gz * z + Doubles{0.5, 0.5, 0.5, 0.5} * bent < Doubles{};
    Floats start[kBatch];
    for (unsigned k = 0; k < kBatch; ++k) start[k] = four(d.motions[b.vertices[b.at(k)]].start.data());
    transpose(start[0], start[1], start[2], start[3]);
    const auto picked = [&](const Floats& from, const Floats& at_start, Floats& to) {
      Doubles here, there;
      widen(from, here), widen(at_start, there);
      narrow(is_less ? there : here, to);
    };
    picked(q.x, start[0], rows[0]), picked(q.y, start[1], rows[1]), picked(q.z, start[2], rows[2]);
    rows[3] = q.pressure;
  }
};

/// Moves what a batch holds, and empties it.
template <class Visit>
[[gnu::always_inline]] inline void move_batch(const Descent& d, const Visit& how, const Quadratics& q, Batch& b) {
  Floats rows[kBatch];
  how.move(d, b, q, rows);
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (unsigned k = 0; k < b.count; ++k) put(rows[k], d.places + std::size_t{4} * b.vertices[k]);
  b.clear();
}
/// The pressures of a batch as its stars stood before it moves.
[[gnu::always_inline]] inline void find_batch_pressures(const Descent& d, const Batch& b, Floats& pressures) {
  Doubles volumes;
  b.sum(9, volumes);
  const NodeTerm &n0 = d.nodes[b.vertices[0]], &n1 = d.nodes[b.vertices[b.at(1)]], &n2 = d.nodes[b.vertices[b.at(2)]],
                 &n3 = d.nodes[b.vertices[b.at(3)]];
  Doubles stiffness, at_rest;
  widen(Floats{n0.stiffness, n1.stiffness, n2.stiffness, n3.stiffness}, stiffness);
  widen(Floats{n0.rest_volume, n1.rest_volume, n2.rest_volume, n3.rest_volume}, at_rest);
  narrow(stiffness * (volumes - at_rest), pressures);
}

template <bool kAveraged, class Visit>
inline void finish(const Descent& d, const Visit& how, Batch& b) {
  Quadratics q(d, b, std::true_type());
  if constexpr (kAveraged) find_batch_pressures(d, b, q.pressure);
  move_batch(d, how, q, b);
}

template <bool kAveraged, Law kLaw, class Visit>
[[gnu::always_inline]] inline void visit(const Descent& d, const Visit& how, std::uint32_t v, Batch& b) {
  if (b.count == kBatch || b.meets(d, v)) finish<kAveraged>(d, how, b);
  sum_star<kAveraged ? Wanted::kBothAveraged : Wanted::kBoth, kLaw>(d, v, b);
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
  d.nodes != nullptr ? for_law<true>(d, work) : for_law<false>(d, work);
}

template <bool kAveraged, Law kLaw, class Visit>
inline void visit_each(const Descent& d, const Visit& how, std::span<const std::uint32_t> order, bool is_backward) {
  const std::size_t count = order.size();
  const auto at = [&](std::size_t i) { return order[is_backward ? count - 1 - i : i]; };
  Batch batch;
  batch.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t v = at(i);
    fetch_ahead(d, at, i, count);
    if (how.takes_part(d.motions[v])) visit<kAveraged, kLaw>(d, how, v, batch);
  }
  if (batch.count > 0) finish<kAveraged>(d, how, batch);
}

void sweep_all(const Descent& d, std::span<const std::uint32_t> order, bool is_backward) {
  for_kind(d, [&]<bool kAveraged, Law kLaw>() { visit_each<kAveraged, kLaw>(d, Descending(), order, is_backward); });
}

void pick_all(const Descent& d, std::span<const std::uint32_t> order) {
  for_kind(d, [&]<bool kAveraged, Law kLaw>() { visit_each<kAveraged, kLaw>(d, Picking(), order, false); });
}

inline void put_slopes(const Descent& d, Batch& b, float* slopes) {
  const Quadratics q(d, b, std::false_type());
  Floats rows[kBatch] = {};
  narrow(q.gx, rows[0]), narrow(q.gy, rows[1]), narrow(q.gz, rows[2]);
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (unsigned k = 0; k < b.count; ++k) put(rows[k], slopes + std::size_t{4} * d.slots[b.vertices[k]]);
  b.clear();
}

template <Wanted kWanted, Law kLaw>
inline void slopes_of_each(const Descent& d, std::span<const std::uint32_t> order, float* slopes) {
  Batch batch;
  batch.clear();
  for (std::size_t i = 0; i < order.size(); ++i) {
    fetch_ahead(
        d, [&](std::size_t k) { return order[k]; }, i, order.size());
    const bool has_terms = Batch::has_terms(d.motions[order[i]]);
    if (batch.count == kBatch || (has_terms && batch.with_terms < kBatch)) put_slopes(d, batch, slopes);
    sum_star<kWanted, kLaw>(d, order[i], batch);
  }
  if (batch.count > 0) put_slopes(d, batch, slopes);
}

void slopes_of_all(const Descent& d, std::span<const std::uint32_t> order, float* slopes) {
  for_kind(d, [&]<bool kAveraged, Law kLaw>() {
    slopes_of_each<kAveraged ? Wanted::kSlopeAveraged : Wanted::kSlope, kLaw>(d, order, slopes);
  });
}

/// Six volumes of the tets of a star that take part in its average.
inline float star_volume(const Descent& d, std::uint32_t vertex) {
  Lanes volumes = all(0);
  read_star(
      d, vertex, [](const NearLanes&, const Lanes&, const Lanes&, const Lanes&) INCISE_INLINED {},
      [&](const TetLanes& tets, std::uint32_t /*i*/, const auto& near) INCISE_INLINED {
        Lanes ax, ay, az, bx, by, bz, cx, cy, cz;
        near.corner(tets.a.data(), ax, ay, az);
        near.corner(tets.b.data(), bx, by, bz);
        near.corner(tets.c.data(), cx, cy, cz);
        const Lanes volume6 = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
        volumes = volumes + where_positive(load(tets.pressure.data()), volume6);
      });
  float s[4];
  sum_lanes(volumes, volumes, volumes, volumes, s);
  return s[0];
}

void pressures_of_all(const Descent& d, std::span<const std::uint32_t> vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    fetch_ahead(
        d, [&](std::size_t k) { return vertices[k]; }, i, vertices.size());
    const NodeTerm& node = d.nodes[vertices[i]];
    d.places[std::size_t{4} * vertices[i] + 3] = node.stiffness * (star_volume(d, vertices[i]) - node.rest_volume);
  }
}

/// What a block of tissue that does not stiffen has by its volumes.
template <class Near>
[[gnu::always_inline]] inline Lanes swelling_energy(const TetLanes& tets, const Near& near, Lanes& volume6) {
  Lanes ax, ay, az, bx, by, bz, cx, cy, cz;
  near.corner(tets.a.data(), ax, ay, az);
  near.corner(tets.b.data(), bx, by, bz);
  near.corner(tets.c.data(), cx, cy, cz);
  volume6 = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  const Lanes half = load(tets.bulk.data()) * volume6 * all(0.5F);
  return (half - absolute(load(tets.pressure.data()))) * volume6;
}

/// What a vertex has of the energy of its tets, and whether any of them is inside out.
struct EnergyOfStar {
  double energy;
  bool is_turned;
};

/// Eight energies in double precision: of single places, without more rounding. In a grid all stars are rounded alike,
/// so that rounding adds up to what a light load stores.
struct WideLanes {
  double sums[kLanes] = {};
  double least[kLanes] = {};  // six times a volume, or 0

  [[nodiscard]] inline bool is_turned() const {
    double all_least = 0;
    for (const double one : least) all_least = std::min(all_least, one);
    return all_least < 0;
  }
  [[nodiscard]] inline double total() const {
    return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
  }
};

/// Adds what the edges to a block of neighbours have.
inline void add_stretch_energy(const NearLanes& near, const Lanes& x, const Lanes& y, const Lanes& z, WideLanes& into) {
  float px[kLanes], py[kLanes], pz[kLanes];
  store(x, px), store(y, py), store(z, pz);
  for (std::uint32_t i = 0; i < kLanes; ++i) {
    const auto dx = static_cast<double>(px[i]), dy = static_cast<double>(py[i]), dz = static_cast<double>(pz[i]);
    into.sums[i] += static_cast<double>(near.weight[i]) * (dx * dx + dy * dy + dz * dz);
  }
}

/// Adds what a block of tets has by its volumes.
template <class Near>
inline void add_swelling_energy(const TetLanes& tets, const Near& near, WideLanes& into) {
  float p[9][kLanes];
  const std::uint8_t* codes[3] = {tets.a.data(), tets.b.data(), tets.c.data()};
  for (unsigned k = 0; k < 3; ++k) {
    Lanes x, y, z;
    near.corner(codes[k], x, y, z);
    store(x, p[3 * k]), store(y, p[3 * k + 1]), store(z, p[3 * k + 2]);
  }
  for (std::uint32_t i = 0; i < kLanes; ++i) {
    const auto wide = [&](unsigned k) { return static_cast<double>(p[k][i]); };
    const double ax = wide(0), ay = wide(1), az = wide(2), bx = wide(3), by = wide(4), bz = wide(5);
    const double cx = wide(6), cy = wide(7), cz = wide(8);
    const double volume6 = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    const double half = static_cast<double>(tets.bulk[i]) * volume6 * 0.5;
    into.least[i] = std::min(into.least[i], volume6);
    into.sums[i] += (half - std::abs(static_cast<double>(tets.pressure[i]))) * volume6;
  }
}

/// A corner's share in a tet's energy: a quarter of what its volume takes, half of what its own edges do, so that all
/// four make it up.
inline EnergyOfStar star_energy(const Descent& d, std::uint32_t vertex) {
  WideLanes swelling, stretch;
  read_star(
      d, vertex,
      [&](const NearLanes& near, const Lanes& x, const Lanes& y, const Lanes& z)
          INCISE_INLINED { add_stretch_energy(near, x, y, z, stretch); },
      [&](const TetLanes& tets, std::uint32_t /*i*/, const auto& near)
          INCISE_INLINED { add_swelling_energy(tets, near, swelling); });
  return {0.25 * (swelling.total() - stretch.total()), swelling.is_turned()};
}

/// The same where tissue stiffens: a quarter of each tet's energy.
template <bool kHasFibres>
inline EnergyOfStar stiff_star_energy(const Descent& d, std::uint32_t vertex) {
  Lanes energy = all(0), least = all(0);
  const std::size_t first = d.stars[d.slots[vertex]].first;
  read_star(
      d, vertex, [](const NearLanes&, const Lanes&, const Lanes&, const Lanes&) INCISE_INLINED {},
      [&](const TetLanes& tets, std::uint32_t i, const auto& near) INCISE_INLINED {
        Lanes ax, ay, az, bx, by, bz, cx, cy, cz;
        near.corner(tets.a.data(), ax, ay, az);
        near.corner(tets.b.data(), bx, by, bz);
        near.corner(tets.c.data(), cx, cy, cz);
        const Lanes ux = bx - ax, uy = by - ay, uz = bz - az, wx = cx - ax, wy = cy - ay, wz = cz - az;
        const Lanes vx = wx - ux, vy = wy - uy, vz = wz - uz;
        Lanes volume6;
        Lanes swelling = swelling_energy(tets, near, volume6);
        least = least_of_two(least, volume6);
        if constexpr (kHasFibres) {
          const FibreLanes fibres(d.fibres[first + i], ax, ay, az, bx, by, bz, cx, cy, cz);
          swelling = swelling + fibres.energy();
        }
        const StiffLanes stiff(d.blocks[first + i], d.stiffening[first + i], swelling, ax * ax + ay * ay + az * az,
                               bx * bx + by * by + bz * bz, cx * cx + cy * cy + cz * cz, ux * ux + uy * uy + uz * uz,
                               vx * vx + vy * vy + vz * vz, wx * wx + wy * wy + wz * wz);
        energy = energy + stiff.energy();
      });
  float s[4];
  sum_lanes(energy, least, energy, energy, s);
  return {0.25 * static_cast<double>(s[0]), s[1] < 0};
}

void add_energies(const Descent& d, std::span<const std::uint32_t> order, double& sum,
                  std::vector<std::uint32_t>& turned) {
  const auto add = [&](const auto& energy_of) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      fetch_ahead(
          d, [&](std::size_t k) { return order[k]; }, i, order.size());
      const EnergyOfStar star = energy_of(order[i]);
      sum += star.energy;
      if (star.is_turned) turned.push_back(order[i]);
    }
  };
  if (d.fibres != nullptr) {
    add([&](std::uint32_t v) { return stiff_star_energy<true>(d, v); });
  } else if (d.stiffening != nullptr) {
    add([&](std::uint32_t v) { return stiff_star_energy<false>(d, v); });
  } else {
    add([&](std::uint32_t v) { return star_energy(d, v); });
  }
}

/// Looks at a vertex, and leaves it where it is.
struct Looking {
  Quadratic& found;

  [[nodiscard]] inline bool takes_part(const Motion& /*motion*/) const { return true; }
  inline void move(const Descent& /*d*/, const Batch& /*b*/, const Quadratics& q, Floats* rows) const {
    found = {{q.gx[0], q.gy[0], q.gz[0]}, {q.xx[0], q.xy[0], q.xz[0], q.yy[0], q.yz[0], q.zz[0]}};
    rows[0] = q.x, rows[1] = q.y, rows[2] = q.z, rows[3] = q.pressure;
  }
};

void find_quadratic(const Descent& d, std::uint32_t vertex, Quadratic& quadratic) {
  for_kind(d, [&]<bool kAveraged, Law kLaw>() {
    visit_each<kAveraged, kLaw>(d, Looking{quadratic}, std::span(&vertex, 1), false);
  });
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

Vec3 off_target(const PullTerm& term, const float* places, const std::uint32_t* rows) {
  Vec3 off = -term.target;
  for (unsigned i = 0; i < term.corners; ++i) {
    if (term.weights[i] == 0) continue;
    const float* p = places + std::size_t{4} * rows[term.vertices[i]];
    off += term.weights[i] * Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
  }
  return off;
}

void add_pulls(const Descent& descent, const Motion& motion, Quadratic& q) {
  for (std::uint32_t i = 0; i < motion.pulls; ++i) {
    const PullUse& use = descent.uses[motion.first_pull + i];
    const PullTerm& term = descent.terms[use.term];
    const PullState pull = pull_state(term, off_target(term, descent.places, descent.rows));
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

double energy_share(const Descent& descent, std::span<const std::uint32_t> order, std::vector<std::uint32_t>& turned) {
  double sum = 0;
  INCISE_DISPATCH(add_energies)(descent, order, sum, turned);
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
