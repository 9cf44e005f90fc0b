// SPDX-License-Identifier: Apache-2.0
// Label images as files of every format, written for the tests.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace incise_test {

/// How the voxels of a file are stored.
struct Storage {
  const char* nrrd_type;
  const char* meta_type;
  int nifti_code;
  std::size_t bytes;
  bool is_float;
};

/// All integer and float types.
const std::vector<Storage>& storages();

/// The voxels of a test's image: 4 × 3 × 2, values 0, 1, 2 and 7, none of which is the same mirrored or transposed.
inline constexpr std::array<std::size_t, 3> kTestSize = {4, 3, 2};
std::vector<int> test_values();

std::string raw_bytes(const std::vector<int>& values, const Storage& storage, bool is_big_endian);

/// NIfTI of version 1 or 2 with an sform of steps (-2,0,0), (0,3,0), (0,0,4) and origin (10, 20, 30).
std::string nifti_header(int version, const Storage& storage, bool is_big_endian, bool is_detached = false);
std::string nifti(int version, const Storage& storage, bool is_big_endian);
/// The same image and place as NRRD, in LPS; without `data_file` the voxels follow.
std::string nrrd_header(const Storage& storage, bool is_big_endian, const std::string& encoding = "raw",
                        const std::string& data_file = "");
/// Likewise as MetaImage.
std::string meta_header(const Storage& storage, bool is_big_endian, bool is_compressed = false,
                        const std::string& data_file = "LOCAL");

/// Overwrites bytes of a header.
template <class T>
void put(std::string& bytes, std::size_t at, T value, bool is_big_endian = false) {
  const auto* raw = reinterpret_cast<const char*>(&value);
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[at + i] = raw[is_big_endian ? sizeof(T) - 1 - i : i];
}

/// One gzip member.
std::string gzipped(const std::string& bytes);

}  // namespace incise_test
