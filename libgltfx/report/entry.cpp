// SPDX-License-Identifier: Apache-2.0
#include "report/entry.hpp"

#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "json/literals.hpp"
#include "report/fields.hpp"
#include "report/safe_text.hpp"
#include "report/value_json.hpp"

namespace gltfx::report {
namespace {

/// Members of JSON objects.
class JsonOut {
 public:
  static constexpr bool kIsJson = true;
  template <class Value>
  using Of = const Value;

  JsonOut(json::Writer& writer, Detail detail, bool readable, bool timings)
      : writer_(writer), detail_(detail), readable_(readable), timings_(timings) {}

  bool is_full() const { return detail_ == Detail::full; }
  bool is_readable() const { return readable_; }
  bool has_timings() const { return timings_; }

  void text(std::string_view name, std::string_view value, bool when = true) {
    if (when) writer_.member(name, value);
  }
  void long_text(std::string_view name, const std::string& value, bool when = true) {
    if (when) writer_.member(name, long_value(value));
  }
  // JSON holds text only: bytes that are not UTF-8 are also written as hexadecimal digits.
  void bytes(std::string_view name, std::string_view value) {
    writer_.member(name, value);
    if (!is_full() || json::is_utf8(value)) return;
    std::string digits;
    for (const char byte : value) {
      fmt::format_to(std::back_inserter(digits), "{:02x}", static_cast<unsigned char>(byte));
    }
    writer_.member(fmt::format("{}Hex", name), digits);
  }
  void number(std::string_view name, std::uint64_t value, bool when = true) {
    if (when) writer_.member(name, value);
  }
  void flag(std::string_view name, bool value, bool when = true) {
    if (when) writer_.member(name, value);
  }
  void code(std::string_view name, std::string_view value) { writer_.member(name, value); }
  void severity(std::string_view name, Severity value) {
    writer_.member(name, severity_name(value));
  }
  void verdict(std::string_view name, Verdict value) { writer_.member(name, verdict_name(value)); }
  void value(std::string_view name, const CheckedValue& value) {
    writer_.key(name);
    write_value(writer_, value);
  }
  void texts(std::string_view name, const std::vector<std::string>& values) {
    if (!values.empty()) write_long_values(writer_, name, values);
  }
  void optional(std::string_view name, const std::optional<std::uint64_t>& value) {
    if (value) writer_.member(name, *value);
  }
  void optional(std::string_view name, const std::optional<std::string>& value) {
    if (value) writer_.member(name, long_value(*value));
  }
  template <class Holder>
  void optional(std::string_view name, const Holder& holder, bool when = true) {
    if (holder) object(name, *holder, when);
  }
  template <class Value>
  void object(std::string_view name, const Value& value, bool when = true) {
    if (!when) return;
    writer_.key(name);
    element(value);
  }
  template <class Value>
  void list(std::string_view name, const std::vector<Value>& values, bool when = true) {
    if (!when) return;
    writer_.key(name);
    writer_.begin_array();
    for (const Value& value : values) element(value);
    writer_.end_array();
  }
  template <class Value>
  void element(const Value& value) {
    writer_.begin_object();
    fields(*this, value);
    writer_.end_object();
  }

 private:
  json::Writer& writer_;
  Detail detail_;
  bool readable_;
  bool timings_;
};

}  // namespace

void write_checked_limit(json::Writer& writer, const CheckedLimit& limit) {
  JsonOut(writer, Detail::plain, true, false).element(limit);
}

void write_asset_info(json::Writer& writer, const AssetInfo& info) {
  JsonOut(writer, Detail::plain, true, false).element(info);
}

void write_entry(json::Writer& writer, const FileReport& report, Detail detail, bool timings) {
  JsonOut(writer, detail, report.readable, timings).element(report);
}

void write_summary(json::Writer& writer, const RunSummary& summary) {
  JsonOut(writer, Detail::plain, true, false).element(summary);
}

}  // namespace gltfx::report
