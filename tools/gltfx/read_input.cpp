// SPDX-License-Identifier: Apache-2.0
#include "read_input.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/directory.hpp"
#include "base/text.hpp"
#include "container/file.hpp"
#include "schema/compile.hpp"

namespace gltfx::tool {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 18U;

Error too_long(std::uint64_t most) { return {fmt::format("it has more than {} bytes", most)}; }

// Appends the bytes of one read; false at the end.
Result<bool> read_on(int fd, std::string& text) {
  const std::size_t before = text.size();
  text.resize(before + kChunk);
  ssize_t got = -1;
  do {
    got = ::read(fd, text.data() + before, kChunk);
  } while (got < 0 && errno == EINTR);
  text.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  if (got < 0) return Error{std::error_code(errno, std::generic_category()).message()};
  return got > 0;
}

// In pieces: a growing string takes twice its memory whenever it moves.
Result<std::string> read_all(int fd, std::uint64_t most) {
  constexpr std::size_t kPiece = 16 * kChunk;
  std::vector<std::string> pieces;
  std::uint64_t size = 0;
  for (bool more = true; more;) {
    if (pieces.empty() || pieces.back().size() + kChunk > kPiece) {
      pieces.emplace_back().reserve(kPiece);
    }
    const std::size_t before = pieces.back().size();
    const auto read = read_on(fd, pieces.back());
    if (!read) return read.error();
    size += pieces.back().size() - before;
    if (size > most) return too_long(most);
    more = *read;
  }
  std::string text;
  text.reserve(static_cast<std::size_t>(size));
  for (std::string& piece : pieces) {
    text += piece;
    piece = std::string();
  }
  return text;
}

std::string why_not(const container::File& file) {
  if (!file.problem.empty()) return file.problem;
  const int error = file.error == container::ResolveError::no_permission ? EACCES : ENOENT;
  return std::error_code(error, std::generic_category()).message();
}

Error cannot_read(const std::string& path, std::string_view why) {
  return {fmt::format("cannot read {}: {}", quoted(path, 200), why)};
}

namespace fs = std::filesystem;
using SetPointer = std::shared_ptr<const schema::Set>;

constexpr std::string_view kEnding = ".schema.json";

Result<std::vector<std::string>> schema_files_in(const std::string& folder) {
  auto files = files_in(folder, kEnding);
  if (!files) return Error{"--schema-dir: " + files.error().message};
  if (!files->empty()) return files;
  return Error{"--schema-dir: " + quoted(folder, 200) + " holds no file named *.schema.json"};
}

std::string error_lines(const std::vector<schema::SchemaError>& errors) {
  std::string lines = "the schema files have mistakes";
  for (const schema::SchemaError& error : errors) lines += '\n' + printable(error.text());
  return lines;
}

}  // namespace

Result<std::string> read_stdin(std::uint64_t most) { return read_all(STDIN_FILENO, most); }

Result<std::string> read_text_file(const std::string& path, std::uint64_t most) {
  const container::File file = container::open_regular(AT_FDCWD, path.c_str());
  if (!file.fd) return cannot_read(path, why_not(file));
  if (file.size > most) return cannot_read(path, too_long(most).message);
  auto text = read_all(file.fd.get(), most);
  if (text) return text;
  return cannot_read(path, text.error().message);
}

Result<std::vector<std::string>> files_in(const std::string& folder, std::string_view ending) {
  std::vector<std::string> files;
  DirectoryReader directory(folder);
  while (const char* entry = directory.next()) {
    if (std::string_view(entry).ends_with(ending)) files.push_back(fs::path(folder) / entry);
  }
  if (directory.error()) {
    return Error{"cannot list " + quoted(folder, 200) + ": " + directory.error().message()};
  }
  std::sort(files.begin(), files.end());
  return files;
}

Result<LineReader> LineReader::open(const std::string& path) {
  container::File file = container::open_regular(AT_FDCWD, path.c_str());
  if (!file.fd) return cannot_read(path, why_not(file));
  return LineReader(std::move(file.fd));
}

Result<std::optional<std::string>> LineReader::next() {
  for (std::size_t looked_at = begin_;;) {
    const std::size_t end = buffer_.find('\n', looked_at);
    if (end != std::string::npos) {
      std::string line = buffer_.substr(begin_, end - begin_);
      begin_ = end + 1;
      return std::optional<std::string>(std::move(line));
    }
    buffer_.erase(0, begin_);
    begin_ = 0;
    looked_at = buffer_.size();
    if (buffer_.size() > kLongestLine) return too_long(kLongestLine);
    const auto more = read_on(fd_.get(), buffer_);
    if (!more) return more.error();
    if (!*more) return std::optional<std::string>();
  }
}

Result<SetPointer> load_schemas(const std::vector<std::string>& files,
                                const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders) {
    const auto found = schema_files_in(folder);
    if (!found) return found.error();
    names.insert(names.end(), found->begin(), found->end());
  }
  names.insert(names.end(), files.begin(), files.end());
  if (names.empty()) return SetPointer();
  std::vector<schema::SourceFile> sources;
  for (const std::string& name : names) {
    auto text = read_text_file(name, schema::kLongestFile);
    if (!text) return text.error();
    sources.push_back({name, *std::move(text), true});
  }
  schema::Compiled compiled = schema::compile_with(sources);
  if (!compiled.errors.empty()) return Error{error_lines(compiled.errors)};
  return std::move(compiled.set);
}

}  // namespace gltfx::tool
