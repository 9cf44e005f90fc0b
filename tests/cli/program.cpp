// SPDX-License-Identifier: Apache-2.0
#include "cli/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "incise/io/mesh_file.h"
#include "incise/mesh/shapes.h"

namespace incise_test {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void become_program(const std::vector<std::string>& arguments, const std::string& out,
                                 const std::string& err) {
  std::vector<std::string> words = {INCISE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  dup2(open("/dev/null", O_RDONLY), 0);
  dup2(open(out.c_str(), flags, 0600), 1);
  dup2(open(err.c_str(), flags, 0600), 2);
  execv(argv[0], argv.data());
  _exit(127);
}

Outcome run_for(const std::vector<std::string>& arguments, double interrupt_after) {
  const Folder folder;
  const std::string out = folder / "stdout";
  const std::string err = folder / "stderr";
  const pid_t child = fork();
  if (child == 0) become_program(arguments, out, err);
  if (interrupt_after > 0) {
    usleep(static_cast<useconds_t>(interrupt_after * 1e6));
    kill(child, SIGINT);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(out), read(err)};
}

}  // namespace

Outcome run(const std::vector<std::string>& arguments) {
  return run_for(arguments, 0);
}

Outcome run_interrupted(const std::vector<std::string>& arguments, double seconds) {
  return run_for(arguments, seconds);
}

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "incise test XXXXXX").string();
  if (mkdtemp(name.data()) != nullptr) path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return *this / name;
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(path_)) found.push_back(entry.path().filename().string());
  std::sort(found.begin(), found.end());
  return found;
}

std::string read(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string cube_mesh(unsigned n) {
  incise::io::MeshData data;
  data.soup = incise::kuhn_cube(n);
  auto bytes = incise::io::write_mesh_bytes(".mesh", data);
  return bytes.ok() ? *bytes : std::string();
}

}  // namespace incise_test
