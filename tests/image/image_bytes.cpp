// SPDX-License-Identifier: Apache-2.0
#include "image/image_bytes.h"

#include <gtest/gtest.h>

#include "io/gzip.h"

namespace incise_test {
namespace {

template <class T>
void append(std::string& out, T value, bool is_big_endian) {
  out.resize(out.size() + sizeof(T));
  put(out, out.size() - sizeof(T), value, is_big_endian);
}

template <class Real>
void put_row(std::string& header, std::size_t at, std::array<double, 4> row, bool is_big_endian) {
  for (std::size_t i = 0; i < 4; ++i) put(header, at + i * sizeof(Real), static_cast<Real>(row[i]), is_big_endian);
}

template <class Real>
void put_place(std::string& header, std::size_t at, bool is_big_endian) {
  put_row<Real>(header, at, {-2, 0, 0, 10}, is_big_endian);
  put_row<Real>(header, at + 4 * sizeof(Real), {0, 3, 0, 20}, is_big_endian);
  put_row<Real>(header, at + 8 * sizeof(Real), {0, 0, 4, 30}, is_big_endian);
}

std::string nifti1(const Storage& storage, bool is_big_endian, bool is_detached) {
  std::string h(352, '\0');
  put(h, 0, std::int32_t{348}, is_big_endian);
  const std::array<std::int16_t, 8> dim = {3, 4, 3, 2, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 8; ++i) put(h, 40 + 2 * i, dim[i], is_big_endian);
  put(h, 70, static_cast<std::int16_t>(storage.nifti_code), is_big_endian);
  put(h, 108, is_detached ? 0.0F : 352.0F, is_big_endian);
  h[123] = 2;
  put(h, 254, std::int16_t{1}, is_big_endian);
  put_place<float>(h, 280, is_big_endian);
  h.replace(344, 3, is_detached ? "ni1" : "n+1");
  return h;
}

std::string nifti2(const Storage& storage, bool is_big_endian, bool is_detached) {
  std::string h(544, '\0');
  put(h, 0, std::int32_t{540}, is_big_endian);
  h.replace(4, 8, std::string(is_detached ? "ni2" : "n+2") + std::string("\0\r\n\x1a\n", 5));
  put(h, 12, static_cast<std::int16_t>(storage.nifti_code), is_big_endian);
  const std::array<std::int64_t, 8> dim = {3, 4, 3, 2, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 8; ++i) put(h, 16 + 8 * i, dim[i], is_big_endian);
  put(h, 168, is_detached ? std::int64_t{0} : std::int64_t{544}, is_big_endian);
  put(h, 348, std::int32_t{1}, is_big_endian);
  put_place<double>(h, 400, is_big_endian);
  put(h, 500, std::int32_t{2}, is_big_endian);
  return h;
}

}  // namespace

const std::vector<Storage>& storages() {
  static const std::vector<Storage> kAll = {
      {"uint8", "MET_UCHAR", 2, 1, false},          {"int8", "MET_CHAR", 256, 1, false},
      {"uint16", "MET_USHORT", 512, 2, false},      {"int16", "MET_SHORT", 4, 2, false},
      {"uint32", "MET_UINT", 768, 4, false},        {"int32", "MET_INT", 8, 4, false},
      {"uint64", "MET_ULONG_LONG", 1280, 8, false}, {"int64", "MET_LONG_LONG", 1024, 8, false},
      {"float", "MET_FLOAT", 16, 4, true},          {"double", "MET_DOUBLE", 64, 8, true}};
  return kAll;
}

std::vector<int> test_values() {
  return {0, 1, 1, 2, 0, 0, 1, 2, 7, 0, 0, 0, 1, 1, 2, 2, 0, 7, 7, 0, 0, 0, 0, 1};
}

std::string raw_bytes(const std::vector<int>& values, const Storage& storage, bool is_big_endian) {
  std::string out;
  for (const int value : values) {
    if (storage.is_float && storage.bytes == 4) append(out, static_cast<float>(value), is_big_endian);
    if (storage.is_float && storage.bytes == 8) append(out, static_cast<double>(value), is_big_endian);
    if (storage.is_float) continue;
    if (storage.bytes == 1) append(out, static_cast<std::int8_t>(value), is_big_endian);
    if (storage.bytes == 2) append(out, static_cast<std::int16_t>(value), is_big_endian);
    if (storage.bytes == 4) append(out, static_cast<std::int32_t>(value), is_big_endian);
    if (storage.bytes == 8) append(out, static_cast<std::int64_t>(value), is_big_endian);
  }
  return out;
}

std::string nifti_header(int version, const Storage& storage, bool is_big_endian, bool is_detached) {
  return version == 1 ? nifti1(storage, is_big_endian, is_detached) : nifti2(storage, is_big_endian, is_detached);
}

std::string nifti(int version, const Storage& storage, bool is_big_endian) {
  return nifti_header(version, storage, is_big_endian) + raw_bytes(test_values(), storage, is_big_endian);
}

std::string nrrd_header(const Storage& storage, bool is_big_endian, const std::string& encoding,
                        const std::string& data_file) {
  return std::string("NRRD0004\n# a comment\ntype: ") + storage.nrrd_type +
         "\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 3 2\n"
         "space directions: (2,0,0) (0,-3,0) (0,0,4)\nkinds: domain domain domain\nendian: " +
         (is_big_endian ? "big" : "little") + "\nencoding: " + encoding + "\nspace origin: (-10,-20,30)\nmy key:=x\n" +
         (data_file.empty() ? "" : "data file: " + data_file + "\n") + "\n";
}

std::string meta_header(const Storage& storage, bool is_big_endian, bool is_compressed, const std::string& data_file) {
  return std::string("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = ") +
         (is_big_endian ? "True" : "False") + "\nCompressedData = " + (is_compressed ? "True" : "False") +
         "\nTransformMatrix = 1 0 0 0 -1 0 0 0 1\nOffset = -10 -20 30\nElementSpacing = 2 3 4\nDimSize = 4 3 2\n"
         "ElementType = " +
         storage.meta_type + "\nElementDataFile = " + data_file + "\n";
}

std::string gzipped(const std::string& bytes) {
  std::string out;
  EXPECT_TRUE(incise::io::gzip(bytes, out));
  return out;
}

}  // namespace incise_test
