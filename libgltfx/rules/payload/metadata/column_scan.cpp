// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"
#include "container/mapped_files.hpp"
#include "json/literals.hpp"
#include "rules/payload/metadata/property_table.hpp"

namespace gltfx::validate {
namespace {

using model::MetadataProperty;
using model::MetadataType;

constexpr std::size_t kOffsetsOfBlock = 4096;
constexpr std::uint64_t kValuesAtOnce = std::uint64_t{1} << 20U;

// Calls `use(values, count, first)` for blocks of packed numbers, each of which begins with the
// last number of the previous one. Returns early if `use` returns false.
template <typename T, typename Use>
bool for_each_block(const container::Bytes& bytes, std::uint64_t total, Use use) {
  const container::ReadMeter meter(bytes);
  std::vector<T> buffer(kOffsetsOfBlock);
  for (std::uint64_t first = 0; first + 1 < total; first += kOffsetsOfBlock - 1) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(kOffsetsOfBlock, total - first));
    std::memcpy(buffer.data(), bytes.view().data() + first * sizeof(T), count * sizeof(T));
    if (!use(buffer.data(), count, first)) return false;
    meter.add(count * sizeof(T));
  }
  return true;
}

template <typename Use>
auto with_offset_type(unsigned size, Use use) {
  switch (size) {
    case 1:
      return use(std::uint8_t{});
    case 2:
      return use(std::uint16_t{});
    case 8:
      return use(std::uint64_t{});
    default:
      return use(std::uint32_t{});
  }
}

template <typename T>
bool is_ascending(const T* offsets, std::size_t count) {
  bool ascending = true;
  for (std::size_t i = 0; i + 1 < count; ++i) ascending &= offsets[i] <= offsets[i + 1];
  return ascending;
}

template <typename T>
std::uint64_t number_at(const container::Bytes& bytes, std::uint64_t index) {
  T value{};
  std::memcpy(&value, bytes.view().data() + index * sizeof(T), sizeof(T));
  return value;
}

class ColumnScan {
 public:
  explicit ColumnScan(const Column& column) : column_(column), property_(*column.property) {}

  std::vector<StoredFinding> run() {
    check_alignments();
    std::optional<std::uint64_t> elements = column_.rows;
    if (property_.is_variable()) {
      elements = end_of(column_.array_offsets, column_.rows, false);
    } else if (property_.array) {
      elements = checked_mul(column_.rows, property_.count);
    }
    if (elements && property_.type == MetadataType::string) {
      elements = end_of(column_.string_offsets, *elements, true);
    }
    if (elements && column_.values.bytes) check_values(*elements);
    return std::move(findings_);
  }

 private:
  void find(std::string_view member, Code code, std::string message,
            std::optional<Severity> severity = {}) {
    Finding finding(code, std::move(message));
    finding.severity = severity;
    findings_.push_back({member, std::move(finding)});
  }

  void check_alignments() {
    const bool packed =
        property_.type == MetadataType::string || property_.type == MetadataType::boolean;
    check_alignment(column_.values, packed ? 1 : metadata_component_size(property_.component));
    check_alignment(column_.array_offsets, column_.array_offsets.size);
    check_alignment(column_.string_offsets, column_.string_offsets.size);
  }

  void check_alignment(const ColumnPart& part, unsigned size) {
    if (!part.bytes || size == 0 || part.byte_offset % size == 0) return;
    find(part.member, Code::PROPERTY_TABLE_ALIGNMENT,
         fmt::format("The buffer view begins at byte {}; it must begin at a multiple of {}.",
                     part.byte_offset, size));
  }

  // Reports a buffer view of the wrong length. True if it has at least the wanted number of bytes.
  bool has_length(const ColumnPart& part, std::optional<std::uint64_t> wanted,
                  std::string_view what) {
    const std::uint64_t length = part.bytes->size();
    if (wanted && *wanted == length) return true;
    const bool longer = wanted && length > *wanted;
    find(part.member, Code::PROPERTY_TABLE_LENGTH_MISMATCH,
         wanted
             ? fmt::format("The buffer view has {} bytes; {} take {}.", length, what, *wanted)
             : fmt::format("The buffer view has {} bytes; {} take more than 2^64.", length, what),
         longer ? std::optional(Severity::warning) : std::nullopt);
    return longer;
  }

  // The last of count + 1 offsets; nothing if they are invalid, which is reported.
  std::optional<std::uint64_t> end_of(const ColumnPart& part, std::uint64_t count, bool strings) {
    if (!part.bytes || part.size == 0) return std::nullopt;
    const auto total = checked_add(count, 1);
    const auto wanted = total ? checked_mul(*total, part.size) : std::nullopt;
    if (!has_length(part, wanted, total ? fmt::format("{} offsets", *total) : "the offsets")) {
      return std::nullopt;
    }
    return with_offset_type(part.size, [&](auto zero) {
      return strings ? read_strings<decltype(zero)>(part, *total)
                     : read_arrays<decltype(zero)>(part, *total);
    });
  }

  template <typename T>
  std::optional<std::uint64_t> read_arrays(const ColumnPart& part, std::uint64_t total) {
    const bool sound = for_each_block<T>(
        *part.bytes, total, [&](const T* offsets, std::size_t count, std::uint64_t first) {
          return is_ascending(offsets, count) || report_descent(part, offsets, count, first);
        });
    if (!sound) return std::nullopt;
    return number_at<T>(*part.bytes, total - 1);
  }

  template <typename T>
  bool report_descent(const ColumnPart& part, const T* offsets, std::size_t count,
                      std::uint64_t first) {
    for (std::size_t i = 0; i + 1 < count; ++i) {
      if (offsets[i] <= offsets[i + 1]) continue;
      find(part.member, Code::PROPERTY_TABLE_OFFSETS_INVALID,
           fmt::format("Offset {} is {}; it must not be less than offset {}, {}.", first + i + 1,
                       offsets[i + 1], first + i, offsets[i]));
      break;
    }
    return false;
  }

  // Checks offsets of strings together with the strings between them. A range of valid UTF-8
  // consists of valid strings if none of them begins inside a character.
  template <typename T>
  std::optional<std::uint64_t> read_strings(const ColumnPart& part, std::uint64_t total) {
    const std::uint64_t start = number_at<T>(*part.bytes, 0);
    if (start != 0) {
      find(part.member, Code::PROPERTY_TABLE_OFFSETS_INVALID,
           fmt::format("The first offset is {}; it must be 0.", start));
    }
    if (!column_.values.bytes) return std::nullopt;
    const std::string_view text = column_.values.bytes->text();
    const container::ReadMeter meter(*column_.values.bytes);
    bool valid = true;
    const bool sound = for_each_block<T>(
        *part.bytes, total, [&](const T* offsets, std::size_t count, std::uint64_t first) {
          if (!is_ascending(offsets, count)) return report_descent(part, offsets, count, first);
          if (offsets[count - 1] > text.size()) return report_beyond(part, offsets, count, first);
          valid = valid && check_strings(text, offsets, count, first);
          meter.add(static_cast<std::size_t>(offsets[count - 1] - offsets[0]));
          return true;
        });
    if (!sound) return std::nullopt;
    return number_at<T>(*part.bytes, total - 1);
  }

  template <typename T>
  bool report_beyond(const ColumnPart& part, const T* offsets, std::size_t count,
                     std::uint64_t first) {
    const std::uint64_t size = column_.values.bytes->size();
    const T* beyond = std::find_if(offsets, offsets + count, [&](T at) { return at > size; });
    find(part.member, Code::PROPERTY_TABLE_OFFSETS_INVALID,
         fmt::format("Offset {} is {}, but the values have only {} bytes.",
                     first + static_cast<std::uint64_t>(beyond - offsets), *beyond, size));
    return false;
  }

  template <typename T>
  bool check_strings(std::string_view text, const T* offsets, std::size_t count,
                     std::uint64_t first) {
    const auto slice = [&](std::size_t i, std::size_t j) {
      return text.substr(static_cast<std::size_t>(offsets[i]),
                         static_cast<std::size_t>(offsets[j] - offsets[i]));
    };
    bool whole = json::is_utf8(slice(0, count - 1));
    for (std::size_t i = 0; whole && i + 1 < count; ++i) {
      const auto at = static_cast<std::size_t>(offsets[i]);
      whole = at == text.size() || (static_cast<unsigned char>(text[at]) & 0xC0U) != 0x80U;
    }
    if (whole) return true;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      if (json::is_utf8(slice(i, i + 1))) continue;
      find("values", Code::PROPERTY_TABLE_STRING_INVALID,
           fmt::format("String {} is not valid UTF-8.", first + i));
      return false;
    }
    return true;
  }

  // `elements`: number of elements of the column; for strings, number of bytes.
  void check_values(std::uint64_t elements) {
    const ColumnPart& values = column_.values;
    if (property_.type == MetadataType::string) {
      has_length(values, elements, "the strings");
      return;
    }
    if (property_.type == MetadataType::boolean) {
      const std::uint64_t bytes = elements / 8 + (elements % 8 != 0 ? 1 : 0);
      if (has_length(values, bytes, fmt::format("{} flags", elements))) check_padding(elements);
      return;
    }
    const unsigned components = std::max(metadata_components(property_.type), 1U);
    const unsigned size = components * metadata_component_size(property_.component);
    if (size == 0) return;
    if (!has_length(values, checked_mul(elements, size), fmt::format("{} elements", elements))) {
      return;
    }
    scan(elements, components);
  }

  void check_padding(std::uint64_t bits) {
    if (bits % 8 == 0) return;
    const auto last = std::to_integer<unsigned>(column_.values.bytes->view()[bits / 8]);
    if (last >> (bits % 8) == 0) return;
    find("values", Code::PROPERTY_TABLE_PADDING,
         fmt::format("The bits after the {} flags are not 0.", bits));
  }

  void scan(std::uint64_t elements, unsigned components) {
    const bool rows = !property_.is_variable() && property_.width() <= kMostWidth;
    const std::uint64_t width = rows ? property_.width() : components;
    ValueLimits limits = column_.limits;
    if (!rows) limits = {};
    const auto scan = make_value_scan(property_, limits, width);
    if (!scan) return;
    const container::Bytes& bytes = *column_.values.bytes;
    const container::ReadMeter meter(bytes);
    const std::uint64_t total = elements * components / width;
    const std::uint64_t row_bytes = width * metadata_component_size(property_.component);
    const std::uint64_t step = std::max<std::uint64_t>(kValuesAtOnce / row_bytes / 48 * 48, 48);
    for (std::uint64_t done = 0; done < total; done += step) {
      const std::uint64_t some = std::min(step, total - done);
      const auto length = static_cast<std::size_t>(some * row_bytes);
      scan->add(bytes.view().subspan(static_cast<std::size_t>(done * row_bytes), length), some);
      meter.add(length);
    }
    auto found = describe_values(property_, limits, scan->finish(),
                                 property_.is_variable() ? "element" : "row");
    for (StoredFinding& each : found) findings_.push_back(std::move(each));
  }

  const Column& column_;
  const MetadataProperty& property_;
  std::vector<StoredFinding> findings_;
};

}  // namespace

std::vector<StoredFinding> scan_column(const Column& column) { return ColumnScan(column).run(); }

}  // namespace gltfx::validate
