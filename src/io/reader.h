// SPDX-License-Identifier: Apache-2.0
// What the readers of all formats share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "incise/io/mesh_file.h"
#include "io/text.h"

namespace incise {
inline namespace v0 {
namespace io {

/// One file being read: its bytes, and the mesh or the error that comes out.
struct Job {
  std::string name;        // for messages
  std::string_view bytes;  // gunzipped
  const SiblingLoader& sibling;
  ReadLimits limits;
  MeshFile out;
  Error error;
  std::vector<std::uint32_t> mids = {};  // mid-edge nodes in any order, repeated

  TetSoup& soup() { return out.data.soup; }

  /// Record an error without a place, unless there is one already. Always false.
  bool fail(const std::string& what, ErrorCode code = ErrorCode::kBadFile) {
    if (error.message.empty()) error = {code, name + ": " + what};
    return false;
  }
};

/// A MEDIT file that Incise wrote has a comment that begins so, before its vertices; then the names of what it carries.
inline constexpr std::string_view kMeditMark = "# incise:";
/// Another, for each region that has a name, before its number and name.
inline constexpr std::string_view kMeditRegion = "# incise region";

// One reader per format, named in formats.cpp alone: bool read_x(Job& job), which returns false with `job.error` set.

/// Check what a reader made: tets exist, indices in range; drop labels that say nothing; find mid nodes.
bool finish(Job& job);

/// Numbers as files name elements, to positions. Costs nothing where they rise by one.
class IdMap {
 public:
  /// The next element's number.
  void add(std::int64_t id);
  /// Call after the last `add`; false where a number is repeated (then `repeated()` is one).
  [[nodiscard]] bool seal();
  [[nodiscard]] std::int64_t repeated() const { return repeated_; }
  /// The position, or `kInvalidIndex`.
  [[nodiscard]] std::uint32_t find(std::int64_t id) const;
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  struct Entry {
    std::int64_t id;
    std::uint32_t position;
  };
  std::int64_t first_ = 0;
  std::size_t size_ = 0;
  std::vector<Entry> entries_;  // only once the numbers stop rising by one
  std::int64_t repeated_ = 0;
};

/// One of what a kind names many of: "hexahedron" of "hexahedra", "cell of type 99" of "cells of type 99".
[[nodiscard]] std::string singular(std::string_view kind);

/// Counts, by what they are, the elements that a reader has no use for.
class LeftOut {
 public:
  /// `kind` in the plural; nothing is counted where it is empty.
  void add(std::string_view kind, std::uint64_t n = 1);
  /// Adds a line such as "12 hexahedra and 3 prisms were left out"; nothing where all was taken.
  void note(std::vector<std::string>& notes) const;

 private:
  std::map<std::string, std::uint64_t, std::less<>> counts_;
};

/// A number that counts from `base` as an index below `n`, where it is one.
[[nodiscard]] inline bool to_index(std::int64_t value, std::size_t n, std::uint32_t& out, std::int64_t base = 0) {
  if (value < base || static_cast<std::uint64_t>(value - base) >= n) return false;
  out = static_cast<std::uint32_t>(value - base);
  return true;
}
[[nodiscard]] inline bool to_label(std::int64_t value, std::int32_t& out) {
  out = static_cast<std::int32_t>(value);
  return value >= std::numeric_limits<std::int32_t>::min() && value <= std::numeric_limits<std::int32_t>::max();
}
/// A real number as a label, where it is one.
[[nodiscard]] bool to_label(double value, std::int32_t& out);

/// Labels from cell data of a foreign file, best first: how well `name` suits a region; 0 for not at all.
[[nodiscard]] int region_rank(std::string_view name);

/// "region_12" with prefix "region_" gives 12.
[[nodiscard]] bool parse_suffix(std::string_view text, std::string_view prefix, std::int32_t& out);

}  // namespace io
}  // namespace v0
}  // namespace incise
