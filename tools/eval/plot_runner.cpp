// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "plot_runner.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>

#include "lio/io/command_line.hpp"

extern char** environ;

namespace lio {
namespace {

std::optional<std::filesystem::path> FindScript(const std::string& script) {
  std::error_code ignored;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  std::vector<std::filesystem::path> folders = {self / "../share/liod/plot",
                                                self / "../../tools/plot", LIO_PLOT_DIR};
  if (const char* chosen = std::getenv("LIO_PLOT_DIR")) folders = {chosen};
  for (const auto& folder : folders) {
    if (std::filesystem::is_regular_file(folder / script, ignored)) return folder / script;
  }
  return std::nullopt;
}

// A file that is removed with this object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) {
    std::string pattern = (std::filesystem::temp_directory_path() / "lio-eval-XXXXXX").string();
    const int descriptor = mkstemp(pattern.data());
    if (descriptor < 0) return;
    close(descriptor);
    path_ = pattern;
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// Returns the child's exit code; nothing when it could not be started or was killed.
std::optional<int> RunChild(std::vector<std::string> command) {
  std::vector<char*> argv;
  for (std::string& word : command) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0) {
    return std::nullopt;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return std::nullopt;
  }
  return WIFEXITED(status) ? std::optional(WEXITSTATUS(status)) : std::nullopt;
}

}  // namespace

int RunPlot(const std::string& program, const std::string& script,
            const nlohmann::ordered_json& data, const std::vector<std::string>& arguments) {
  const std::optional<std::filesystem::path> file = FindScript(script);
  if (!file) {
    std::cerr << program << ": " << script << " is not found; set LIO_PLOT_DIR to tools/plot\n";
    return kExitConfiguration;
  }
  const TemporaryFile input(data.dump());
  const char* const chosen_python = std::getenv("LIO_PYTHON");
  std::vector<std::string> command = {chosen_python != nullptr ? chosen_python : "/usr/bin/python3",
                                      file->string(), input.path()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const std::optional<int> exit_code = RunChild(command);
  if (exit_code && *exit_code != 127) return *exit_code;
  std::cerr << program << ": " << command[0]
            << " cannot be run; install python3 and python3-matplotlib, or set LIO_PYTHON\n";
  return kExitConfiguration;
}

}  // namespace lio
