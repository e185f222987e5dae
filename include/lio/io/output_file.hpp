// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Writes a file in whole rows, and names it in errors.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "lio/io/input_error.hpp"

namespace lio {

class OutputFile {
 public:
  // A symbolic link at the place of the file is treated so.
  enum class Links { kReplaced, kFollowed };

  // Overwrites an existing file. Throws OutputError naming the file when it cannot.
  explicit OutputFile(const std::filesystem::path& path, Links links = Links::kReplaced);
  ~OutputFile();  // writes what is kept, if it can
  OutputFile(OutputFile&&) = default;
  OutputFile& operator=(OutputFile&&) = delete;

  // Keeps whole rows until the next Flush, or until a megabyte has come together. The three throw
  // WriteError naming the file and the reason when not all could be written; the file then ends
  // with its last whole row, and what was kept is lost.
  void Write(std::string_view rows);
  void Flush();
  // Nothing may be written afterwards.
  void Close();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Closer> file_;  // without a buffer of its own
  std::string kept_;
  std::uint64_t size_ = 0;  // bytes written
};

// Returns the first rows, as many as end within the page of the file that `at` is in, or the one
// row that does not. A process that is killed while it writes leaves its file cut at the end of a
// page: the kernel looks for a signal after each.
[[nodiscard]] std::string_view RowsWithinPage(std::string_view rows, std::uint64_t at);

// Opens a file as OutputFile does, without its errors: returns -1, and errno says why.
[[nodiscard]] int OpenToWrite(const std::filesystem::path& path, OutputFile::Links links);

// Closes all of them, also after one has thrown; then throws what the first one did.
void CloseAll(std::span<OutputFile* const> files);

// Writes a whole file; the errors are those of OutputFile.
void WriteText(const std::filesystem::path& path, std::string_view text,
               OutputFile::Links links = OutputFile::Links::kReplaced);

}  // namespace lio
