// SPDX-License-Identifier: Apache-2.0
// Pictures go to a folder, and ffmpeg is run on it as a program of its own.
#include "film.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "app/text/formatted.h"

extern char** environ;

namespace incise_view {
namespace {

using namespace incise;

/// Runs a program that is looked for in $PATH. Returns its exit code; -1 where there is no such program.
int run_program(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return 1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

Status make_film(const std::filesystem::path& folder, const std::filesystem::path& film, double pictures_per_second) {
  // What players everywhere take: H.264 with colours at half resolution, which asks for even sizes.
  const int code = run_program({"ffmpeg", "-loglevel", "error", "-y", "-framerate",
                                app::formatted("{:.6g}", pictures_per_second), "-i", (folder / "%06d.png").string(),
                                "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", film.string()});
  constexpr int kNotFound = 127;  // where the program vanishes between looking and running
  if (code == 0) return {};
  if (code == -1 || code == kNotFound) {
    return Error{ErrorCode::kIo,
                 "--film needs the program ffmpeg: install it, or use --sequence FOLDER and make the film elsewhere",
                 {}};
  }
  return Error{ErrorCode::kIo, app::formatted("{}: ffmpeg ended with {}", film.string(), code), {}};
}

TemporaryFolder::TemporaryFolder() {
  std::error_code code;
  std::string name = (std::filesystem::temp_directory_path(code) / "incise-film-XXXXXX").string();
  if (mkdtemp(name.data()) != nullptr) path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code code;
  if (!path_.empty()) std::filesystem::remove_all(path_, code);
}

}  // namespace incise_view
