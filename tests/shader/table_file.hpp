// SPDX-License-Identifier: Apache-2.0
/// Writes the tables of the shader.
#pragma once

#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace gltfx::shader {

/// A file in libgltfx/shader/tables: nested lists of numbers.
class TableFile {
 public:
  explicit TableFile(const std::string& name)
      : file_(fmt::format("{}/libgltfx/shader/tables/{}.inc", GLTFX_SOURCE_DIR, name)) {
    file_ << "// SPDX-License-Identifier: Apache-2.0\n"
             "// Written by the tests of the shader: do not edit.\n";
  }

  void open() { file_ << "{{"; }
  void close() { file_ << "}},\n"; }
  void row(std::span<const double> values) {
    open();
    numbers(values);
    close();
  }
  void numbers(std::span<const double> values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string_view before = i == 0 ? "" : i % 8 == 0 ? ",\n " : ", ";
      file_ << before << fmt::format("{:.5f}F", values[i]);
    }
  }

 private:
  std::ofstream file_;
};

}  // namespace gltfx::shader
