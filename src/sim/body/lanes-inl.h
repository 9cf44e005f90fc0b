// SPDX-License-Identifier: Apache-2.0
// Eight floats at once, with the same results on every target: vectors of the instruction set for which the file is
// compiled where Highway is there, plain loops elsewhere. No fused multiply-add, one order of sums.
// Included once for each instruction set, by star_kernel.cpp alone.
#if defined(INCISE_SIM_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef INCISE_SIM_LANES_INL_H
#undef INCISE_SIM_LANES_INL_H
#else
#define INCISE_SIM_LANES_INL_H
#endif

#if INCISE_WITH_HIGHWAY
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
#define INCISE_LANES_NAMESPACE HWY_NAMESPACE
#else
#define INCISE_LANES_NAMESPACE plain
#endif

namespace incise {
inline namespace v0 {
namespace detail {
namespace INCISE_LANES_NAMESPACE {

#undef INCISE_LANES_OF_MACHINE
#if INCISE_WITH_HIGHWAY
#define INCISE_LANES_OF_MACHINE (HWY_TARGET != HWY_SCALAR)
#else
#define INCISE_LANES_OF_MACHINE 0
#endif

#if INCISE_LANES_OF_MACHINE

namespace hn = hwy::HWY_NAMESPACE;
using Four = hn::FixedTag<float, 4>;
using FourV = hn::Vec<Four>;

/// Rows of points, x y z and a fourth number each, to columns.
HWY_INLINE void columns(FourV r0, FourV r1, FourV r2, FourV r3, FourV& x, FourV& y, FourV& z) {
  const Four d;
  const hn::Repartition<double, Four> d64;
  const auto xy01 = hn::BitCast(d64, hn::InterleaveLower(r0, r1)), xy23 = hn::BitCast(d64, hn::InterleaveLower(r2, r3));
  const auto zw01 = hn::BitCast(d64, hn::InterleaveUpper(d, r0, r1));
  const auto zw23 = hn::BitCast(d64, hn::InterleaveUpper(d, r2, r3));
  x = hn::BitCast(d, hn::InterleaveLower(xy01, xy23));
  y = hn::BitCast(d, hn::InterleaveUpper(d64, xy01, xy23));
  z = hn::BitCast(d, hn::InterleaveLower(zw01, zw23));
}

/// a0+a1 of four lanes in the order (0+2)+(1+3), for four vectors at once.
HWY_INLINE FourV sums(FourV a, FourV b, FourV c, FourV e) {
  const Four d;
  const hn::Repartition<double, Four> d64;
  const auto ab = hn::BitCast(d64, hn::Add(hn::InterleaveLower(a, b), hn::InterleaveUpper(d, a, b)));
  const auto ce = hn::BitCast(d64, hn::Add(hn::InterleaveLower(c, e), hn::InterleaveUpper(d, c, e)));
  return hn::Add(hn::BitCast(d, hn::InterleaveLower(ab, ce)), hn::BitCast(d, hn::InterleaveUpper(d64, ab, ce)));
}

#if HWY_MAX_BYTES >= 32

using Eight = hn::FixedTag<float, 8>;
struct Lanes {
  hn::Vec<Eight> v;
};
HWY_INLINE Lanes load(const float* p) {
  return {hn::LoadU(Eight(), p)};
}
HWY_INLINE Lanes all(float x) {
  return {hn::Set(Eight(), x)};
}
HWY_INLINE Lanes operator+(Lanes a, Lanes b) {
  return {hn::Add(a.v, b.v)};
}
HWY_INLINE Lanes operator-(Lanes a, Lanes b) {
  return {hn::Sub(a.v, b.v)};
}
HWY_INLINE Lanes operator*(Lanes a, Lanes b) {
  return {hn::Mul(a.v, b.v)};
}

HWY_INLINE hn::Vec<Eight> two_points(const float* places, std::uint32_t low, std::uint32_t high) {
  const Four d4;
  return hn::Combine(Eight(), hn::LoadU(d4, places + std::size_t{4} * high),
                     hn::LoadU(d4, places + std::size_t{4} * low));
}
/// The places of eight vertices.
HWY_INLINE void load_points(const float* places, const std::uint32_t* i, Lanes& x, Lanes& y, Lanes& z) {
  const Eight d;
  const hn::Repartition<double, Eight> d64;
  const auto r0 = two_points(places, i[0], i[4]), r1 = two_points(places, i[1], i[5]);
  const auto r2 = two_points(places, i[2], i[6]), r3 = two_points(places, i[3], i[7]);
  const auto xy01 = hn::BitCast(d64, hn::InterleaveLower(r0, r1)), xy23 = hn::BitCast(d64, hn::InterleaveLower(r2, r3));
  const auto zw01 = hn::BitCast(d64, hn::InterleaveUpper(d, r0, r1));
  const auto zw23 = hn::BitCast(d64, hn::InterleaveUpper(d, r2, r3));
  x.v = hn::BitCast(d, hn::InterleaveLower(xy01, xy23));
  y.v = hn::BitCast(d, hn::InterleaveUpper(d64, xy01, xy23));
  z.v = hn::BitCast(d, hn::InterleaveLower(zw01, zw23));
}
/// Lanes 0 to 3 plus lanes 4 to 7.
HWY_INLINE FourV halves(Lanes a) {
  return hn::Add(hn::LowerHalf(Four(), a.v), hn::UpperHalf(Four(), a.v));
}

#else

struct Lanes {
  FourV low, high;
};
HWY_INLINE Lanes load(const float* p) {
  return {hn::LoadU(Four(), p), hn::LoadU(Four(), p + 4)};
}
HWY_INLINE Lanes all(float x) {
  return {hn::Set(Four(), x), hn::Set(Four(), x)};
}
HWY_INLINE Lanes operator+(Lanes a, Lanes b) {
  return {hn::Add(a.low, b.low), hn::Add(a.high, b.high)};
}
HWY_INLINE Lanes operator-(Lanes a, Lanes b) {
  return {hn::Sub(a.low, b.low), hn::Sub(a.high, b.high)};
}
HWY_INLINE Lanes operator*(Lanes a, Lanes b) {
  return {hn::Mul(a.low, b.low), hn::Mul(a.high, b.high)};
}

HWY_INLINE FourV point(const float* places, std::uint32_t i) {
  return hn::LoadU(Four(), places + std::size_t{4} * i);
}
HWY_INLINE void load_points(const float* p, const std::uint32_t* i, Lanes& x, Lanes& y, Lanes& z) {
  columns(point(p, i[0]), point(p, i[1]), point(p, i[2]), point(p, i[3]), x.low, y.low, z.low);
  columns(point(p, i[4]), point(p, i[5]), point(p, i[6]), point(p, i[7]), x.high, y.high, z.high);
}
HWY_INLINE FourV halves(Lanes a) {
  return hn::Add(a.low, a.high);
}

#endif

/// The sums of the lanes of four vectors: ((0+4)+(2+6)) + ((1+5)+(3+7)).
HWY_INLINE void sum_lanes(Lanes a, Lanes b, Lanes c, Lanes e, float* out) {
  hn::StoreU(sums(halves(a), halves(b), halves(c), halves(e)), Four(), out);
}

#else

struct Lanes {
  float v[8];
};
template <class Each>
inline Lanes each(const Each& value) {
  Lanes r;
  for (unsigned i = 0; i < 8; ++i) r.v[i] = value(i);
  return r;
}
inline Lanes load(const float* p) {
  return each([&](unsigned i) { return p[i]; });
}
inline Lanes all(float x) {
  return each([&](unsigned /*i*/) { return x; });
}
inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return each([&](unsigned i) { return a.v[i] + b.v[i]; });
}
inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return each([&](unsigned i) { return a.v[i] - b.v[i]; });
}
inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return each([&](unsigned i) { return a.v[i] * b.v[i]; });
}
inline void load_points(const float* places, const std::uint32_t* i, Lanes& x, Lanes& y, Lanes& z) {
  for (unsigned k = 0; k < 8; ++k) {
    const float* p = places + std::size_t{4} * i[k];
    x.v[k] = p[0];
    y.v[k] = p[1];
    z.v[k] = p[2];
  }
}
inline float sum_of(const Lanes& a) {
  const float* v = a.v;
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}
inline void sum_lanes(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& e, float* out) {
  out[0] = sum_of(a);
  out[1] = sum_of(b);
  out[2] = sum_of(c);
  out[3] = sum_of(e);
}

#endif

}  // namespace INCISE_LANES_NAMESPACE
}  // namespace detail
}  // namespace v0
}  // namespace incise

#if INCISE_WITH_HIGHWAY
HWY_AFTER_NAMESPACE();
#endif
#endif  // per-target guard
