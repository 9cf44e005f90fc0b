// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incise/core/result.h"
#include "incise/io/mesh_data.h"

namespace incise {
inline namespace v0 {
namespace io {

/// A mesh as its file has it: nothing is reordered, turned, merged or dropped.
struct MeshFile {
  std::string format_name;               ///< for people, for instance "Gmsh MSH 2.2 ASCII"
  bool gzipped = false;                  ///< the file was compressed
  MeshData data;                         ///< points, tets, triangles and labels
  bool ten_node = false;                 ///< tets had mid-edge nodes: their four corners are in `data`
  std::vector<std::uint32_t> mid_nodes;  ///< rising: points that are only mid-edge nodes of tets
  std::size_t file_vertices = 0;         ///< vertices in the file, mid-edge nodes included
  std::size_t file_tets = 0;             ///< tets in the file
  std::vector<std::string> notes;        ///< what was left out, in words
};

/// Bounds on what a reader may take.
struct ReadLimits {
  /// Bytes after gunzip; unit byte, usual size below 1 GB. Smaller values refuse large gzipped meshes.
  std::uint64_t max_inflated_bytes = std::uint64_t{4} << 30U;
};

/// Gets a file that stands beside the one being read: TetGen's other half, or what *INCLUDE names.
///
/// @param name  a file name or relative path, as the format gives it.
/// @return its bytes, gunzipped.
using SiblingLoader = std::function<Result<std::string>(const std::string& name)>;

/// A format of one's own, beside those that Incise knows.
struct MeshFormat {
  std::string name;       ///< for people, for instance "Acme 2 binary"
  std::string extension;  ///< of files that are written so, with its dot, in lower case; empty: it is only read
  /// Whether a file is of this format, by its bytes, gunzipped. Asked before all formats that Incise knows. Empty: it
  /// is only written.
  std::function<bool(std::string_view bytes)> recognises;
  /// Reads a file. What it returns is checked as if Incise had read it: indices in range, finite points, a tet at
  /// least.
  std::function<Result<MeshData>(std::string_view bytes, const std::string& name, const SiblingLoader& sibling)> read;
  /// Makes the bytes of a file, before they are gzipped where `.gz` follows the extension.
  std::function<Result<std::string>(const MeshData& data)> write;
};

/// Read a tetrahedral mesh; the format is found from the content, not from the name.
///
/// MEDIT .mesh; Gmsh .msh 1.0, 2.x and 4.1, ASCII and binary; legacy .vtk 2.0 to 5.1; .vtu in all encodings but
/// LZ4 and LZMA; TetGen .node or .ele (the other is looked for beside it); Vega .veg; Abaqus .inp; tetrahedral
/// .ply; any of them gzipped. Ten-node tets keep their corners; their other nodes stay in `data.soup.points`.
/// @param own  formats of one's own.
/// @return the mesh, with all indices in range and all coordinates finite, and at least one tet.
/// Errors: `kBadFile` "FILE:LINE: what; remedy" (or a byte offset), `kUnsupported` for a format of no use here,
/// `kOutOfMemory`. Cost: O(n); holds the file's bytes and the mesh at once. Thread-safe.
[[nodiscard]] Result<MeshFile> read_mesh(const std::filesystem::path& path, const ReadLimits& limits = {},
                                         const std::vector<MeshFormat>& own = {});

/// Read a mesh from memory, as `read_mesh` does; this is what the fuzzers call.
///
/// @param bytes    the content of a file, gzipped or not.
/// @param name     stands for FILE in messages; for TetGen it names the other half (`a.ele` asks for `a.node`).
/// @param sibling  where the format needs a second file; without it such files are refused.
[[nodiscard]] Result<MeshFile> read_mesh_bytes(std::string_view bytes, const std::string& name = "mesh",
                                               const SiblingLoader& sibling = {}, const ReadLimits& limits = {},
                                               const std::vector<MeshFormat>& own = {});

/// The variants of Gmsh's format that can be written.
enum class MshVariant : std::uint8_t {
  k41,        ///< MSH 4.1 ASCII: each region and each stroke is an entity with a physical group
  k41Binary,  ///< MSH 4.1 binary: half the size, and faster
  k22,        ///< MSH 2.2 ASCII, for programs that read no later one
};

/// How a mesh is written, where the name of its file leaves that open.
struct WriteOptions {
  std::string extension = {};            ///< such as ".vtu", instead of the file's own; empty: the file's own
  MshVariant msh = MshVariant::k41;      ///< of ".msh"
  std::vector<MeshFormat> formats = {};  ///< formats of one's own, before those that Incise knows
};

/// The options that a short name stands for: "mesh", "msh" or "msh41", "msh41-binary", "msh22", "vtk", "vtu", "node",
/// "veg" or "inp"; nothing where it stands for none.
[[nodiscard]] std::optional<WriteOptions> write_options_named(std::string_view name);
/// The names that `write_options_named` knows, but for "msh". Cost: O(names).
[[nodiscard]] std::vector<std::string> write_option_names();
/// The extensions that meshes are written under, each once, with its dot. Cost: O(extensions).
[[nodiscard]] std::vector<std::string> written_extensions();

/// Write a mesh in the format that the extension names, gzipped where `.gz` follows.
///
/// `.mesh`, `.msh` (4.1 ASCII; see `MshVariant`), `.msh2` (2.2 ASCII), `.vtk` (4.2 ASCII), `.vtu`, `.node` or `.ele`
/// (both are written), `.veg`, `.inp`. Numbers read back bit for bit. `region` goes everywhere; `piece` everywhere but
/// `.mesh`; triangles with `stroke`, and `cut_front`, to `.mesh .msh .msh2 .vtk .vtu`; `origin_vertex` to these and
/// `.node`. Foreign face labels stay what they are: no reader takes them for strokes.
/// The file is written beside its place and renamed: no partial file is ever seen under its name. What a killed process
/// left there of the same file is taken away. Pipes and devices are written in place.
/// @param data  indices in range, finite points, arrays of the documented lengths.
/// Errors: `kBadArgument` for bad data or an unknown extension, `kIo`. Cost: O(n); holds the file's bytes.
[[nodiscard]] Status write_mesh(const std::filesystem::path& path, const MeshData& data,
                                const WriteOptions& options = {});

/// The files that `write_mesh` makes: the path itself, except for TetGen's pair. Cost: O(1).
[[nodiscard]] std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path,
                                                            const WriteOptions& options = {});

/// The bytes that `write_mesh` would put into the file of that extension (without `.gz`), for tests, pipes and the web.
///
/// @param extension  ".mesh", ".msh", ".msh2", ".vtk", ".vtu", ".node", ".ele", ".veg" or ".inp".
[[nodiscard]] Result<std::string> write_mesh_bytes(std::string_view extension, const MeshData& data,
                                                   MshVariant msh = MshVariant::k41);

}  // namespace io
}  // namespace v0
}  // namespace incise
