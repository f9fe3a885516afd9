// SPDX-License-Identifier: Apache-2.0
#include "report/packed.hpp"

#include <bit>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "report/fields.hpp"
#include "report/rule_lookup.hpp"

namespace gltfx::report {
namespace {

/// Bytes have all members, in order and without names: JSON alone leaves some out.
struct PackedForm {
  static constexpr bool kIsJson = false;
  static constexpr bool is_full() { return true; }
  static constexpr bool is_readable() { return true; }
};

class Packer : public PackedForm {
 public:
  template <class Value>
  using Of = const Value;

  void number(std::string_view /*name*/, std::uint64_t value, bool /*when*/ = true) {
    for (; value >= 0x80; value >>= 7U) out_ += static_cast<char>(value | 0x80U);
    out_ += static_cast<char>(value);
  }
  void text(std::string_view name, std::string_view value, bool /*when*/ = true) {
    number(name, value.size());
    out_ += value;
  }
  void long_text(std::string_view name, std::string_view value, bool /*when*/ = true) {
    text(name, value);
  }
  void bytes(std::string_view name, std::string_view value) { text(name, value); }
  void code(std::string_view name, std::string_view value) { text(name, value); }
  void flag(std::string_view name, bool value, bool /*when*/ = true) {
    number(name, value ? 1 : 0);
  }
  void severity(std::string_view name, Severity value) {
    number(name, static_cast<std::uint64_t>(value));
  }
  void verdict(std::string_view name, Verdict value) {
    number(name, static_cast<std::uint64_t>(value));
  }
  void value(std::string_view name, const CheckedValue& value) {
    number(name, value.index());
    if (const auto* amount = std::get_if<double>(&value)) {
      number(name, std::bit_cast<std::uint64_t>(*amount));
    } else if (const auto* truth = std::get_if<bool>(&value)) {
      flag(name, *truth);
    } else if (const auto* words = std::get_if<std::string>(&value)) {
      text(name, *words);
    } else if (const auto* set = std::get_if<std::vector<std::string>>(&value)) {
      texts(name, *set);
    }
  }
  void texts(std::string_view name, const std::vector<std::string>& values) {
    number(name, values.size());
    for (const std::string& value : values) text(name, value);
  }
  template <class Holder>
  void optional(std::string_view name, const Holder& holder, bool /*when*/ = true) {
    flag(name, bool(holder));
    if (holder) content(name, *holder);
  }
  template <class Value>
  void object(std::string_view /*name*/, const Value& value, bool /*when*/ = true) {
    fields(*this, value);
  }
  template <class Value>
  void list(std::string_view name, const std::vector<Value>& values, bool /*when*/ = true) {
    number(name, values.size());
    for (const Value& value : values) fields(*this, value);
  }
  std::string finish() { return std::move(out_); }

 private:
  void content(std::string_view name, std::uint64_t value) { number(name, value); }
  void content(std::string_view name, const std::string& value) { text(name, value); }
  template <class Value>
  void content(std::string_view /*name*/, const Value& value) {
    fields(*this, value);
  }

  std::string out_;
};

class Unpacker : public PackedForm {
 public:
  template <class Value>
  using Of = Value;

  Unpacker(std::string_view bytes, std::span<const RuleDescription> rules)
      : rest_(bytes), rules_(rules) {}

  template <class Integer>
  void number(std::string_view /*name*/, Integer& value, bool /*when*/ = true) {
    value = static_cast<Integer>(next());
  }
  void text(std::string_view /*name*/, std::string& value, bool /*when*/ = true) {
    value = next_text();
  }
  void long_text(std::string_view name, std::string& value, bool /*when*/ = true) {
    text(name, value);
  }
  void bytes(std::string_view name, std::string& value) { text(name, value); }
  void code(std::string_view /*name*/, std::string_view& value) {
    const RuleDescription* rule = find_rule_in(rules_, next_text());
    whole_ = whole_ && rule != nullptr;
    if (rule != nullptr) value = rule->code;
  }
  void flag(std::string_view /*name*/, bool& value, bool /*when*/ = true) { value = next() != 0; }
  void severity(std::string_view /*name*/, Severity& value) {
    const std::uint64_t number = next();
    whole_ = whole_ && number <= static_cast<std::uint64_t>(Severity::hint);
    if (whole_) value = static_cast<Severity>(number);
  }
  void verdict(std::string_view /*name*/, Verdict& value) {
    const std::uint64_t number = next();
    whole_ = whole_ && number <= static_cast<std::uint64_t>(Verdict::not_applicable);
    if (whole_) value = static_cast<Verdict>(number);
  }
  void value(std::string_view name, CheckedValue& value);
  void texts(std::string_view /*name*/, std::vector<std::string>& values) {
    for (std::uint64_t left = length(); left > 0 && whole_; --left)
      values.emplace_back(next_text());
  }
  template <class Value>
  void optional(std::string_view name, std::optional<Value>& value) {
    if (next() == 0) return;
    value = Value();  // clang 14 cannot emplace what lies in a class
    content(name, *value);
  }
  template <class Value>
  void optional(std::string_view name, std::shared_ptr<const Value>& value, bool /*when*/ = true) {
    if (next() == 0) return;
    const auto made = std::make_shared<Value>();
    content(name, *made);
    value = made;
  }
  template <class Value>
  void object(std::string_view /*name*/, Value& value, bool /*when*/ = true) {
    fields(*this, value);
  }
  template <class Value>
  void list(std::string_view /*name*/, std::vector<Value>& values, bool /*when*/ = true) {
    for (std::uint64_t left = length(); left > 0 && whole_; --left) {
      fields(*this, values.emplace_back());
    }
  }
  // An element takes at least a byte: neither a list nor a text is longer than the remaining bytes.
  std::uint64_t length() {
    const std::uint64_t size = next();
    whole_ = whole_ && size <= rest_.size();
    return whole_ ? size : 0;
  }
  bool is_whole() const { return whole_; }
  bool finished() const { return whole_ && rest_.empty(); }

 private:
  void content(std::string_view name, std::uint64_t& value) { number(name, value); }
  void content(std::string_view name, std::string& value) { text(name, value); }
  template <class Value>
  void content(std::string_view /*name*/, Value& value) {
    fields(*this, value);
  }
  std::uint64_t next();
  std::string_view next_text() {
    const std::uint64_t size = length();
    const std::string_view value = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return value;
  }

  std::string_view rest_;
  std::span<const RuleDescription> rules_;
  bool whole_ = true;
};

void Unpacker::value(std::string_view name, CheckedValue& value) {
  switch (next()) {
    case 0:
      return;
    case 1:
      value = std::bit_cast<double>(next());
      return;
    case 2:
      return flag(name, value.emplace<bool>());
    case 3:
      return text(name, value.emplace<std::string>());
    case 4:
      return texts(name, value.emplace<std::vector<std::string>>());
    default:
      whole_ = false;
  }
}

std::uint64_t Unpacker::next() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    if (rest_.empty()) break;
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    value |= std::uint64_t{byte & 0x7FU} << shift;
    if (byte < 0x80) return value;
  }
  whole_ = false;
  return 0;
}

}  // namespace

std::string pack(const FileReport& report) {
  Packer packer;
  fields(packer, report);
  packer.number("externalAssets", report.external_assets.size());
  for (const FileReport& external : report.external_assets) {
    packer.text("path", external.path);
    fields(packer, external);
  }
  return packer.finish();
}

std::optional<FileReport> unpack(std::string_view bytes, std::span<const RuleDescription> rules) {
  Unpacker unpacker(bytes, rules);
  FileReport report;
  fields(unpacker, report);
  for (std::uint64_t left = unpacker.length(); left > 0 && unpacker.is_whole(); --left) {
    FileReport& external = report.external_assets.emplace_back();
    unpacker.text("path", external.path);
    fields(unpacker, external);
  }
  if (!unpacker.finished()) return std::nullopt;
  return report;
}

}  // namespace gltfx::report
