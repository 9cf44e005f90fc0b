// SPDX-License-Identifier: Apache-2.0
// Only after reading has failed is a file looked at again: the first key "format" of JSON, or a mesh reader, says what
// it is.
#include "input_kind.h"

#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "incise/io/mesh_file.h"

namespace incise_cli {
namespace {

using namespace incise;

const std::string kStdin = "/dev/stdin";
constexpr std::size_t kHead = 4096;  // bytes in which a JSON file of ours names its format

std::string head_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

/// The value of the first key "format" of JSON that begins so; empty where there is none.
std::string format_in(std::string_view json) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = json.find_first_not_of(kSpace);
  const std::size_t key = json.find("\"format\"");
  if (first == std::string_view::npos || json[first] != '{' || key == std::string_view::npos) return {};
  const std::size_t colon = json.find_first_not_of(kSpace, key + 8);
  if (colon == std::string_view::npos || json[colon] != ':') return {};
  const std::size_t open = json.find_first_not_of(kSpace, colon + 1);
  if (open == std::string_view::npos || json[open] != '"') return {};
  const std::size_t close = json.find('"', open + 1);
  return close == std::string_view::npos ? std::string() : std::string(json.substr(open + 1, close - open - 1));
}

struct Kind {
  FileKind kind = FileKind::kUnknown;
  std::string text;  // what it is, and what to do with it
};

Kind kind_of(const std::string& file) {
  const std::string format = format_in(head_of(file));
  if (format == "incise-scene") return {FileKind::kScene, "is a scene; run it with incise simulate"};
  if (format == "incise-blade")
    return {FileKind::kBlade, "is a blade file; cut a mesh with it: incise cut MESH --blade"};
  if (format == "incise-recording" || format == "incise-simulation") {
    return {FileKind::kRecording, "is a recording; run it again with incise replay"};
  }
  if (format == "incise-plan") return {FileKind::kPlan, "is the plan of a batch; run it with incise batch"};
  if (format.rfind("incise-", 0) == 0)
    return {FileKind::kReport, "is a report of incise (" + format + "); read it as JSON"};
  const Result<io::MeshFile> mesh = io::read_mesh(file);
  if (!mesh.ok()) return {};
  return {FileKind::kMesh, "is a mesh (" + mesh->format_name + ", " + std::to_string(mesh->file_tets) +
                               " tets); cut it with incise cut, see it with incise-view, or name it in a scene as "
                               "\"model\": {\"file\": ...} (docs/scenes.md)"};
}

}  // namespace

std::string input_of(const std::string& argument) {
  return argument == "-" ? kStdin : argument;
}

bool is_stdin(const std::string& argument) {
  return input_of(argument) == kStdin;
}

std::string name_of_input(const std::string& argument) {
  return is_stdin(argument) ? "stdin" : argument;
}

Error explain_kind(Error error, const std::string& file, FileKind wanted) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) return error;
  const Kind found = kind_of(file);
  if (found.kind == FileKind::kUnknown || found.kind == wanted) return error;
  error.message = file + ": " + found.text;
  return error;
}

}  // namespace incise_cli
