// SPDX-License-Identifier: Apache-2.0
#include "product_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "config_import.hpp"
#include "json/document.hpp"
#include "json/parse.hpp"
#include "measure/quantity.hpp"
#include "read_input.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLongestProducts = std::uint64_t{16} << 20U;
constexpr std::array<std::string_view, 4> kColumns{"file", "size-x", "size-y", "size-z"};

/// Reads CSV: fields with commas, quotes or line breaks are in quotes, which are doubled inside.
class CsvReader {
 public:
  explicit CsvReader(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }

  bool at_end() const { return rest_.empty(); }
  std::size_t line() const { return line_; }

  std::vector<std::string> row() {
    std::vector<std::string> fields;
    line_ = next_line_;
    bool more = true;
    while (more) more = take_field(fields.emplace_back());
    ++next_line_;
    return fields;
  }

 private:
  // Whether a comma follows.
  bool take_field(std::string& field) {
    if (rest_.starts_with('"')) take_quoted(field);
    const std::size_t end = std::min(rest_.find_first_of(",\n"), rest_.size());
    field += rest_.substr(0, end);
    const bool comma = end < rest_.size() && rest_[end] == ',';
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (!comma && field.ends_with('\r')) field.pop_back();
    return comma;
  }
  void take_quoted(std::string& field) {
    rest_.remove_prefix(1);
    while (!rest_.empty()) {
      const char c = rest_.front();
      rest_.remove_prefix(1);
      if (c == '\n') ++next_line_;
      if (c != '"') {
        field += c;
      } else if (rest_.starts_with('"')) {
        field += '"';
        rest_.remove_prefix(1);
      } else {
        return;
      }
    }
  }

  std::string_view rest_;
  std::size_t line_ = 1, next_line_ = 1;
};

Error wrong_line(const std::string& path, std::size_t line, std::string_view what) {
  return {fmt::format("{}:{}: {}", printable(path), line, what)};
}

// The position of each of the columns.
std::optional<std::array<std::size_t, 4>> columns_in(const std::vector<std::string>& heading) {
  std::array<std::size_t, 4> places{};
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const auto at = std::find(heading.begin(), heading.end(), kColumns[i]);
    if (at == heading.end()) return std::nullopt;
    places[i] = static_cast<std::size_t>(at - heading.begin());
  }
  return places;
}

Result<ProductSize> size_in(const std::vector<std::string>& fields,
                            const std::array<std::size_t, 4>& places) {
  ProductSize size{};
  for (std::size_t axis = 0; axis < size.size(); ++axis) {
    const std::string& field = fields[places[axis + 1]];
    if (field.empty()) continue;
    const auto value = measure::read_quantity(field, "m");
    if (!value) return value.error();
    if (*value <= 0) return Error{fmt::format("{} is not above 0", gltfx::quoted(field))};
    size[axis] = *value;
  }
  return size;
}

Result<ProductList> read_csv(std::string_view text, const std::string& path) {
  CsvReader csv(text);
  const auto places = columns_in(csv.row());
  if (!places) {
    return wrong_line(path, 1,
                      fmt::format("the first line names the columns {}", fmt::join(kColumns, ",")));
  }
  std::error_code error;
  const fs::path folder = fs::absolute(path, error).parent_path();
  const std::size_t most = *std::max_element(places->begin(), places->end());
  ProductList list;
  while (!csv.at_end()) {
    const std::vector<std::string> fields = csv.row();
    if (fields.size() == 1 && fields.front().empty()) continue;
    if (fields.size() <= most) return wrong_line(path, csv.line(), "a field is missing");
    const auto size = size_in(fields, *places);
    if (!size) return wrong_line(path, csv.line(), size.error().message);
    const std::string& file = fields[places->front()];
    if (file.empty()) return wrong_line(path, csv.line(), "no file is named");
    if (file.find('/') == std::string::npos) {
      list.by_name.insert_or_assign(file, *size);
    } else {
      list.by_path.insert_or_assign((folder / file).lexically_normal().native(), *size);
    }
  }
  return list;
}

Result<ProductList> read_json(std::string_view text, const std::string& path) {
  const json::Parsed parsed = json::parse(text);
  const json::Document& document = parsed.document;
  const auto wrong = [&] {
    return Error{
        fmt::format("{}: a product is {{\"dimensions\": {{\"length\": 1, \"height\": 2, "
                    "\"width\": 3}}}}, in metres",
                    printable(path))};
  };
  if (!parsed.ok() || !document.is_object(document.root())) return wrong();
  const json::NodeId dimensions = document.find(document.root(), "dimensions");
  if (dimensions == json::kNoNode || !document.is_object(dimensions)) return wrong();
  constexpr std::array<std::string_view, 3> kAxes{"length", "height", "width"};
  ProductList list;
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    const json::NodeId value = document.find(dimensions, kAxes[axis]);
    if (value == json::kNoNode) continue;
    if (!document.is_number(value)) return wrong();
    // The auditor has -1 and 0 for any size.
    list.others[axis] = std::max(document.number(value).value, 0.0);
  }
  return list;
}

}  // namespace

Result<std::shared_ptr<const ProductList>> read_products(const std::string& path) {
  const auto text = read_text_file(path, kLongestProducts);
  if (!text) return text.error();
  auto list = looks_like_json(*text) ? read_json(*text, path) : read_csv(*text, path);
  if (!list) return list.error();
  return std::shared_ptr<const ProductList>(std::make_shared<ProductList>(*std::move(list)));
}

}  // namespace gltfx::tool
