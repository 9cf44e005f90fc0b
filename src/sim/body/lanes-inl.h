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

/// Four numbers at once, of four vertices or of one.
using Floats = float __attribute__((vector_size(16)));
using Doubles = double __attribute__((vector_size(32)));

#undef INCISE_LANES_OF_MACHINE
#undef INCISE_LANES_PICK
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
HWY_INLINE void columns(FourV r0, FourV r1, FourV r2, FourV r3, FourV& x, FourV& y, FourV& z, FourV& w) {
  const Four d;
  const hn::Repartition<double, Four> d64;
  const auto xy01 = hn::BitCast(d64, hn::InterleaveLower(r0, r1)), xy23 = hn::BitCast(d64, hn::InterleaveLower(r2, r3));
  const auto zw01 = hn::BitCast(d64, hn::InterleaveUpper(d, r0, r1));
  const auto zw23 = hn::BitCast(d64, hn::InterleaveUpper(d, r2, r3));
  x = hn::BitCast(d, hn::InterleaveLower(xy01, xy23));
  y = hn::BitCast(d, hn::InterleaveUpper(d64, xy01, xy23));
  z = hn::BitCast(d, hn::InterleaveLower(zw01, zw23));
  w = hn::BitCast(d, hn::InterleaveUpper(d64, zw01, zw23));
}

/// a0+a1 of four lanes in the order (0+2)+(1+3), for four vectors at once.
HWY_INLINE FourV sums(FourV a, FourV b, FourV c, FourV e) {
  const Four d;
  const hn::Repartition<double, Four> d64;
  const auto ab = hn::BitCast(d64, hn::Add(hn::InterleaveLower(a, b), hn::InterleaveUpper(d, a, b)));
  const auto ce = hn::BitCast(d64, hn::Add(hn::InterleaveLower(c, e), hn::InterleaveUpper(d, c, e)));
  return hn::Add(hn::BitCast(d, hn::InterleaveLower(ab, ce)), hn::BitCast(d, hn::InterleaveUpper(d64, ab, ce)));
}

/// Four floats of one vertex.
struct Row {
  FourV v;
};
HWY_INLINE Row load_row(const float* p) {
  return {hn::LoadU(Four(), p)};
}
HWY_INLINE void store_row(Row r, float* p) {
  hn::StoreU(r.v, Four(), p);
}

#if HWY_MAX_BYTES >= 32

using Eight = hn::FixedTag<float, 8>;
struct Lanes {
  hn::Vec<Eight> v;
};
/// Whether some number of eight is some number of `count`, at least 1.
HWY_INLINE bool names_any(const std::uint32_t* eight, const std::uint32_t* numbers, unsigned count) {
  const hn::FixedTag<std::uint32_t, 8> d;
  const auto names = hn::LoadU(d, eight);
  auto found = hn::Eq(names, hn::Set(d, numbers[0]));
  for (unsigned i = 1; i < count; ++i) found = hn::Or(found, hn::Eq(names, hn::Set(d, numbers[i])));
  return !hn::AllFalse(d, found);
}
HWY_INLINE Lanes load(const float* p) {
  return {hn::LoadU(Eight(), p)};
}
HWY_INLINE void store(Lanes a, float* p) {
  hn::StoreU(a.v, Eight(), p);
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

HWY_INLINE Lanes operator/(Lanes a, Lanes b) {
  return {hn::Div(a.v, b.v)};
}
HWY_INLINE Lanes square_root(Lanes a) {
  return {hn::Sqrt(a.v)};
}
HWY_INLINE Lanes absolute(Lanes a) {
  return {hn::Abs(a.v)};
}
/// `value` where `sign` is above 0, 0 elsewhere.
HWY_INLINE Lanes where_positive(Lanes sign, Lanes value) {
  return {hn::IfThenElseZero(hn::Gt(sign.v, hn::Zero(Eight())), value.v)};
}

HWY_INLINE hn::Vec<Eight> two_points(const float* places, std::uint32_t low, std::uint32_t high) {
  const Four d4;
  return hn::Combine(Eight(), hn::LoadU(d4, places + std::size_t{4} * high),
                     hn::LoadU(d4, places + std::size_t{4} * low));
}
/// The places of eight vertices, and their fourth numbers.
template <class Index>
HWY_INLINE void load_rows(const float* places, const Index* i, Lanes& x, Lanes& y, Lanes& z, Lanes& w) {
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
  w.v = hn::BitCast(d, hn::InterleaveUpper(d64, zw01, zw23));
}
template <class Index>
HWY_INLINE void load_points(const float* places, const Index* i, Lanes& x, Lanes& y, Lanes& z) {
  Lanes unused;
  load_rows(places, i, x, y, z, unused);
}
/// Lanes 0 to 3 plus lanes 4 to 7.
HWY_INLINE FourV halves(Lanes a) {
  return hn::Add(hn::LowerHalf(Four(), a.v), hn::UpperHalf(Four(), a.v));
}

/// Powers of two by eighths: `power_of` of eight bytes.
HWY_INLINE Lanes load_powers(const std::uint8_t* p) {
  const hn::FixedTag<std::uint32_t, 8> d;
  const hn::FixedTag<std::uint8_t, 8> bytes;
  const auto bits = hn::ShiftLeft<20>(hn::PromoteTo(d, hn::LoadU(bytes, p)));
  return {hn::BitCast(Eight(), hn::Add(bits, hn::Set(d, kPowerOne)))};
}

#if HWY_TARGET == HWY_AVX2
#define INCISE_LANES_PICK 1
/// The rows that begin at eight places, as columns.
HWY_INLINE void load_at(const float* places, const std::uint32_t* at, Lanes& x, Lanes& y, Lanes& z, Lanes& w) {
  const Four d4;
  const Eight d;
  const hn::Repartition<double, Eight> d64;
  const auto two = [&](unsigned low, unsigned high) HWY_ATTR {
    return hn::Combine(d, hn::LoadU(d4, places + at[high]), hn::LoadU(d4, places + at[low]));
  };
  const auto r0 = two(0, 4), r1 = two(1, 5), r2 = two(2, 6), r3 = two(3, 7);
  const auto xy01 = hn::BitCast(d64, hn::InterleaveLower(r0, r1)), xy23 = hn::BitCast(d64, hn::InterleaveLower(r2, r3));
  const auto zw01 = hn::BitCast(d64, hn::InterleaveUpper(d, r0, r1));
  const auto zw23 = hn::BitCast(d64, hn::InterleaveUpper(d, r2, r3));
  x.v = hn::BitCast(d, hn::InterleaveLower(xy01, xy23));
  y.v = hn::BitCast(d, hn::InterleaveUpper(d64, xy01, xy23));
  z.v = hn::BitCast(d, hn::InterleaveLower(zw01, zw23));
  w.v = hn::BitCast(d, hn::InterleaveUpper(d64, zw01, zw23));
}
/// Codes of neighbours, of which there are at most 16.
struct Codes {
  __m256i v;
};
HWY_INLINE Codes load_codes(const std::uint8_t* p) {
  return {_mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)))};
}
/// The numbers that the codes name: of the first table, or where the upper bit is set of the second.
HWY_INLINE Lanes pick(const Lanes* tables, Codes codes) {
  const __m256 low = _mm256_permutevar8x32_ps(tables[0].v.raw, codes.v);
  const __m256 high = _mm256_permutevar8x32_ps(tables[1].v.raw, codes.v);
  return {hn::Vec<Eight>{_mm256_blendv_ps(low, high, _mm256_castsi256_ps(codes.v))}};
}
#endif

#else

struct Lanes {
  FourV low, high;
};
HWY_INLINE bool names_any(const std::uint32_t* eight, const std::uint32_t* numbers, unsigned count) {
  const hn::FixedTag<std::uint32_t, 4> d;
  const auto low = hn::LoadU(d, eight), high = hn::LoadU(d, eight + 4);
  auto found = hn::Or(hn::Eq(low, hn::Set(d, numbers[0])), hn::Eq(high, hn::Set(d, numbers[0])));
  for (unsigned i = 1; i < count; ++i) {
    const auto number = hn::Set(d, numbers[i]);
    found = hn::Or(found, hn::Or(hn::Eq(low, number), hn::Eq(high, number)));
  }
  return !hn::AllFalse(d, found);
}
HWY_INLINE Lanes load(const float* p) {
  return {hn::LoadU(Four(), p), hn::LoadU(Four(), p + 4)};
}
HWY_INLINE void store(Lanes a, float* p) {
  hn::StoreU(a.low, Four(), p);
  hn::StoreU(a.high, Four(), p + 4);
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

HWY_INLINE Lanes operator/(Lanes a, Lanes b) {
  return {hn::Div(a.low, b.low), hn::Div(a.high, b.high)};
}
HWY_INLINE Lanes square_root(Lanes a) {
  return {hn::Sqrt(a.low), hn::Sqrt(a.high)};
}
HWY_INLINE Lanes absolute(Lanes a) {
  return {hn::Abs(a.low), hn::Abs(a.high)};
}
HWY_INLINE Lanes where_positive(Lanes sign, Lanes value) {
  const auto zero = hn::Zero(Four());
  return {hn::IfThenElseZero(hn::Gt(sign.low, zero), value.low),
          hn::IfThenElseZero(hn::Gt(sign.high, zero), value.high)};
}

HWY_INLINE FourV point(const float* places, std::uint32_t i) {
  return hn::LoadU(Four(), places + std::size_t{4} * i);
}
template <class Index>
HWY_INLINE void load_rows(const float* p, const Index* i, Lanes& x, Lanes& y, Lanes& z, Lanes& w) {
  columns(point(p, i[0]), point(p, i[1]), point(p, i[2]), point(p, i[3]), x.low, y.low, z.low, w.low);
  columns(point(p, i[4]), point(p, i[5]), point(p, i[6]), point(p, i[7]), x.high, y.high, z.high, w.high);
}
template <class Index>
HWY_INLINE void load_points(const float* places, const Index* i, Lanes& x, Lanes& y, Lanes& z) {
  Lanes unused;
  load_rows(places, i, x, y, z, unused);
}
HWY_INLINE FourV halves(Lanes a) {
  return hn::Add(a.low, a.high);
}

HWY_INLINE Lanes load_powers(const std::uint8_t* p) {
  const hn::FixedTag<std::uint32_t, 4> d;
  const hn::FixedTag<std::uint8_t, 4> bytes;
  const auto four_of = [&](const std::uint8_t* from) HWY_ATTR {
    const auto bits = hn::ShiftLeft<20>(hn::PromoteTo(d, hn::LoadU(bytes, from)));
    return hn::BitCast(Four(), hn::Add(bits, hn::Set(d, kPowerOne)));
  };
  return {four_of(p), four_of(p + 4)};
}

#endif

HWY_INLINE Row operator-(Row a, Row b) {
  return {hn::Sub(a.v, b.v)};
}

/// The sums of the lanes of four vectors: ((0+4)+(2+6)) + ((1+5)+(3+7)).
HWY_INLINE void sum_lanes(Lanes a, Lanes b, Lanes c, Lanes e, float* out) {
  hn::StoreU(sums(halves(a), halves(b), halves(c), halves(e)), Four(), out);
}

#else

struct Lanes {
  float v[8];
};
inline bool names_any(const std::uint32_t* eight, const std::uint32_t* numbers, unsigned count) {
  bool found = false;
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned k = 0; k < count; ++k) found = found || eight[i] == numbers[k];
  }
  return found;
}
template <class Each>
inline Lanes each(const Each& value) {
  Lanes r;
  for (unsigned i = 0; i < 8; ++i) r.v[i] = value(i);
  return r;
}
inline Lanes load(const float* p) {
  return each([&](unsigned i) { return p[i]; });
}
inline void store(const Lanes& a, float* p) {
  for (unsigned i = 0; i < 8; ++i) p[i] = a.v[i];
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
inline Lanes operator/(const Lanes& a, const Lanes& b) {
  return each([&](unsigned i) { return a.v[i] / b.v[i]; });
}
inline Lanes square_root(const Lanes& a) {
  return each([&](unsigned i) { return std::sqrt(a.v[i]); });
}
inline Lanes absolute(const Lanes& a) {
  return each([&](unsigned i) { return a.v[i] < 0 ? -a.v[i] : a.v[i]; });
}
inline Lanes where_positive(const Lanes& sign, const Lanes& value) {
  return each([&](unsigned i) { return sign.v[i] > 0 ? value.v[i] : 0.0F; });
}
inline Lanes load_powers(const std::uint8_t* p) {
  return each([&](unsigned i) { return power_of(p[i]); });
}
struct Row {
  float v[4];
};
inline Row load_row(const float* p) {
  return {{p[0], p[1], p[2], p[3]}};
}
inline void store_row(const Row& r, float* p) {
  for (unsigned i = 0; i < 4; ++i) p[i] = r.v[i];
}
inline Row operator-(const Row& a, const Row& b) {
  return {{a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2], a.v[3] - b.v[3]}};
}
template <class Index>
inline void load_rows(const float* places, const Index* i, Lanes& x, Lanes& y, Lanes& z, Lanes& w) {
  for (unsigned k = 0; k < 8; ++k) {
    const float* p = places + std::size_t{4} * i[k];
    x.v[k] = p[0];
    y.v[k] = p[1];
    z.v[k] = p[2];
    w.v[k] = p[3];
  }
}
template <class Index>
inline void load_points(const float* places, const Index* i, Lanes& x, Lanes& y, Lanes& z) {
  Lanes unused;
  load_rows(places, i, x, y, z, unused);
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

// What the compiler makes of its own conversion is slow.
#if INCISE_LANES_OF_MACHINE && HWY_TARGET == HWY_AVX2
HWY_INLINE void widen(const Floats& from, Doubles& into) {
  into = _mm256_cvtps_pd(from);
}
HWY_INLINE void narrow(const Doubles& from, Floats& into) {
  into = _mm256_cvtpd_ps(from);
}
#else
inline void widen(const Floats& from, Doubles& into) {
  into = __builtin_convertvector(from, Doubles);
}
inline void narrow(const Doubles& from, Floats& into) {
  into = __builtin_convertvector(from, Floats);
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
