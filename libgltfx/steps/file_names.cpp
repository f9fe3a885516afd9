// SPDX-License-Identifier: Apache-2.0
#include "steps/file_names.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.hpp"
#include "container/content.hpp"
#include "image/header.hpp"

namespace gltfx::steps {
namespace {

constexpr std::size_t kMostCodePoints = 56;

// Names of devices on Windows, with any ending.
bool is_device(std::string_view name) {
  const std::string stem = lower_case(name.substr(0, name.find('.')));
  constexpr std::array<std::string_view, 4> kDevices{"con", "prn", "aux", "nul"};
  if (std::find(kDevices.begin(), kDevices.end(), stem) != kDevices.end()) return true;
  const bool port = stem.starts_with("com") || stem.starts_with("lpt");
  return port && stem.size() == 4 && stem[3] >= '0' && stem[3] <= '9';
}

// "png" of "image/png"; empty if it has other characters than letters and digits.
std::string_view subtype_of(std::string_view media_type) {
  media_type.remove_prefix(std::min(media_type.find('/') + 1, media_type.size()));
  if (media_type.starts_with("x-")) media_type.remove_prefix(2);
  const bool plain = std::all_of(media_type.begin(), media_type.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
  return plain ? media_type : std::string_view();
}

}  // namespace

std::string clean_name(std::string_view name) {
  if (printable(name) != name) return {};
  const std::size_t slash = name.find_last_of("/\\");
  if (slash != std::string_view::npos) name.remove_prefix(slash + 1);
  std::string clean;
  for (const char c : name) {
    const bool refused = std::string_view(":*?\"<>|").find(c) != std::string_view::npos;
    if (c == '.' && clean.ends_with('.')) continue;
    clean += refused ? '_' : c;
  }
  clean.resize(bytes_of_code_points(clean, kMostCodePoints));
  const std::size_t begin = std::min(clean.find_first_not_of(" ."), clean.size());
  const std::size_t end = clean.find_last_not_of(" .") + 1;
  clean = begin < end ? clean.substr(begin, end - begin) : std::string();
  return is_device(clean) ? "_" + clean : clean;
}

std::string unescaped_name(std::string name) {
  for (char& c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_letter && !is_digit && std::string_view("-._~").find(c) == std::string_view::npos) {
      c = '_';
    }
  }
  return name;
}

bool is_media_type(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == 0 || slash == text.npos || slash + 1 == text.size()) return false;
  return std::all_of(text.begin(), text.end(), [&](const char& c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return letter || c == '.' || c == '+' || c == '-' || c == '_' || &c == text.data() + slash;
  });
}

std::string image_ending(const container::Bytes& bytes, std::string_view media_type) {
  const image::Sniffed sniffed = image::sniff(bytes.view());
  if (sniffed.known && sniffed.format == image::Format::jpeg) return ".jpg";
  if (sniffed.known) {
    media_type = image::media_type(sniffed.format);
  } else if (const auto found = container::name_content(bytes.text()); !found.media_type.empty()) {
    media_type = found.media_type;
  }
  const std::string_view subtype = subtype_of(media_type);
  return subtype.empty() ? std::string() : fmt::format(".{}", subtype);
}

FileNames::FileNames(const std::set<std::string>& taken) {
  for (const std::string& path : taken) taken_.insert(lower_case(path));
}

std::string FileNames::take(const std::string& name, std::string_view ending,
                            std::string_view mark) {
  std::string stem = name;
  const std::string own = ending_of(name);
  if (own == ending || (own == ".jpeg" && ending == ".jpg")) stem.resize(name.size() - own.size());
  stem += mark;
  unsigned& number = numbers_[lower_case(stem).append(ending)];
  while (true) {
    std::string tried = ++number == 1 ? fmt::format("{}{}", stem, ending)
                                      : fmt::format("{}-{}{}", stem, number, ending);
    if (taken_.insert(lower_case(tried)).second) return tried;
  }
}

}  // namespace gltfx::steps
