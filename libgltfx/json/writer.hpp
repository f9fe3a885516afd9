// SPDX-License-Identifier: Apache-2.0
/// A small streaming writer of JSON. Output is always valid UTF-8 and one value.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx::json {

/// Appends `text` as a JSON string with quotes. Invalid UTF-8 becomes U+FFFD; control characters,
/// U+2028, U+2029 and DEL are escaped, so that the output is safe in a terminal and in a script.
void append_string(std::string& out, std::string_view text);
/// The same as a new string.
std::string string_value(std::string_view text);

/// Writes into a string it does not own. Two-space indentation when `pretty`.
///
///     Writer w(out);  w.begin_object();  w.key("a");  w.number(1);  w.end_object();
class Writer {
 public:
  explicit Writer(std::string& out, bool pretty = false)
      : out_(out), pretty_(pretty), separator_(pretty ? ",\n" : ",") {}

  void begin_object();
  void end_object();
  void begin_array();
  void end_array();
  void key(std::string_view name);
  void string(std::string_view value);
  void number(double value);
  void integer(std::int64_t value);
  void unsigned_integer(std::uint64_t value);
  void boolean(bool value);
  void null();
  /// Writes text that is a JSON value already.
  void raw(std::string_view json);

  /// key and value in one call.
  void member(std::string_view name, std::string_view value);
  void member(std::string_view name, const char* value) { member(name, std::string_view(value)); }
  void member(std::string_view name, std::uint64_t value);
  void member(std::string_view name, bool value);

 private:
  void before_value();
  void open(char bracket);
  void close(char bracket);
  void line_break();
  std::string& out_;
  bool pretty_;
  std::string separator_;  ///< between values: a comma; when pretty, line break and indentation
  bool after_key_ = false;
  std::vector<char> has_items_;  ///< for each open container: whether it is not empty
};

}  // namespace gltfx::json
