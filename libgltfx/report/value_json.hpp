// SPDX-License-Identifier: Apache-2.0
/// Values of measures as JSON.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "json/writer.hpp"
#include "report/safe_text.hpp"

namespace gltfx::report {

/// `cut`: by long_value(), for readers; `whole`: for what is compared.
enum class Texts : std::uint8_t { cut, whole };

/// A CheckedValue or a MeasureValue: a number, true or false, a text or an array of texts; null if
/// there is none.
template <class Value>
void write_value(json::Writer& writer, const Value& value, Texts texts = Texts::cut) {
  const auto write_text = [&](const std::string& text) {
    writer.string(texts == Texts::cut ? long_value(text) : text);
  };
  const auto write = [&](const auto& one) {
    using One = std::decay_t<decltype(one)>;
    if constexpr (std::is_same_v<One, double>) {
      writer.number(one);
    } else if constexpr (std::is_same_v<One, bool>) {
      writer.boolean(one);
    } else if constexpr (std::is_same_v<One, std::string>) {
      write_text(one);
    } else if constexpr (std::is_same_v<One, std::vector<std::string>>) {
      writer.begin_array();
      for (const std::string& text : one) write_text(text);
      writer.end_array();
    } else {
      writer.null();
    }
  };
  std::visit(write, value);
}

}  // namespace gltfx::report
