// SPDX-License-Identifier: Apache-2.0
// A part's name has the number of the process that writes it: where that is no more, nobody will finish it.
#include "incise/io/part_file.h"

#include <cerrno>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/text.h"

#if (defined(__unix__) || defined(__APPLE__)) && !defined(__EMSCRIPTEN__)
#define INCISE_HAS_PROCESSES 1
#include <signal.h>
#include <unistd.h>
#else
#define INCISE_HAS_PROCESSES 0
#endif

namespace incise {
inline namespace v0 {
namespace io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPart = ".incise-part";

long process_number() {
#if INCISE_HAS_PROCESSES
  return static_cast<long>(getpid());
#else
  return 0;
#endif
}

bool is_running([[maybe_unused]] std::int64_t process) {
#if INCISE_HAS_PROCESSES
  return kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH;
#else
  return true;
#endif
}

// Whether a file was being written in the place of `path` by a process that is no more.
bool is_stale(const std::string& name, const std::string& beside) {
  if (name.size() <= beside.size() + kPart.size() || name.compare(0, beside.size(), beside) != 0) return false;
  if (name.compare(name.size() - kPart.size(), kPart.size(), kPart) != 0) return false;
  const std::string_view rest = std::string_view(name).substr(beside.size());
  std::int64_t process = 0;
  return parse_int(rest.substr(0, rest.find('.')), process) && process > 0 && process <= 0x7FFFFFFF &&
         !is_running(process);
}

// What links lead to, whether it is there or not.
fs::path behind_links(fs::path path) {
  constexpr unsigned kMostLinks = 40;
  std::error_code code;
  for (unsigned i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, code)); ++i) {
    const fs::path target = fs::read_symlink(path, code);
    if (code) break;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

// The name of a file as its parts begin: whole, or so much of it that the rest has room in 255 bytes.
std::string part_beginning(const fs::path& path) {
  constexpr std::size_t kMost = 220;
  std::string name = path.filename().string();
  if (name.size() <= kMost) return name;
  std::size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;  // within a character of UTF-8
  return name.substr(0, end);
}

}  // namespace

fs::path part_file(const fs::path& path, unsigned number) {
  fs::path part = behind_links(path);
  part.replace_filename(part_beginning(part));
  part += "." + std::to_string(process_number()) + "." + std::to_string(number);
  part += kPart;
  return part;
}

std::error_code put_in_place(const fs::path& part, const fs::path& place) {
  const fs::path target = behind_links(place);
  std::error_code code;
  const fs::file_status old = fs::status(target, code);
  if (fs::is_regular_file(old)) fs::permissions(part, old.permissions(), code);  // where that fails, it is ours alone
  fs::rename(part, target, code);
  return code;
}

bool is_protected([[maybe_unused]] const fs::path& place) {
#if INCISE_HAS_PROCESSES
  std::error_code code;
  return fs::is_regular_file(place, code) && access(place.c_str(), W_OK) != 0 && errno == EACCES;
#else
  return false;
#endif
}

void remove_stale_parts(const fs::path& place) {
  const fs::path path = behind_links(place);
  constexpr unsigned kNamesToLookAt = 1000;
  std::error_code code;
  unsigned looked_at = 0;
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  const std::string beside = part_beginning(path) + ".";
  std::vector<fs::path> stale;
  for (fs::directory_iterator at(folder, code), end; !code && at != end && looked_at < kNamesToLookAt;
       at.increment(code), ++looked_at) {
    if (is_stale(at->path().filename().string(), beside)) stale.push_back(at->path());
  }
  for (const fs::path& file : stale) fs::remove(file, code);
}

}  // namespace io
}  // namespace v0
}  // namespace incise
