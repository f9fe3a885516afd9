// SPDX-License-Identifier: Apache-2.0
#include "compare_pictures.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "base/replace_file.hpp"
#include "base/temporary_file.hpp"
#include "base/text.hpp"
#include "change/companions.hpp"
#include "pipeline/encode_pixels.hpp"

namespace gltfx::tool {
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

// "parts-chair.glb" of "parts/chair.glb": letters and digits of ASCII, not hidden, not long.
std::string plain_name(std::string_view place) {
  constexpr std::size_t kMost = 120;
  std::string name;
  for (const char c : place) name += c == '/' ? '-' : is_plain(c) ? c : '_';
  const std::size_t begin = std::min(name.find_first_not_of(".-"), name.size());
  name.erase(0, begin);
  if (name.size() > kMost) name.erase(0, name.size() - kMost);
  return name.empty() ? "asset" : name;
}

std::string in_small_letters(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::string ComparePictureFiles::name_for(std::string_view place) {
  std::string name = plain_name(place);
  const std::string plain = name;
  for (std::uint64_t i = 0; !taken_.insert(in_small_letters(name)).second; ++i) {
    const Hash128 hash = hash_bytes(fmt::format("{} {}", i, place));
    name = fmt::format("{}-{:08x}", plain, static_cast<std::uint32_t>(hash.low));
  }
  return name;
}

std::optional<Error> ComparePictureFiles::prepare() const {
  if (folder_.empty()) return std::nullopt;
  if (auto trouble = change::make_folder(folder_)) return trouble;
  return TemporaryFile(std::filesystem::path(folder_) / "picture.png").write("");
}

std::optional<Error> ComparePictureFiles::write(CompareReport& report, std::string_view place) {
  if (folder_.empty() || report.pictures.empty()) return std::nullopt;
  const std::string name = name_for(place);
  for (ComparePicture& picture : report.pictures) {
    const std::string view =
        picture.view == "usual" ? std::string() : fmt::format(".{}", picture.view);
    const auto put = [&](const BakedPixels& pixels, std::string_view which,
                         std::string& file) -> std::optional<Error> {
      if (pixels.bytes.empty()) return std::nullopt;
      file = fmt::format("{}{}.{}.png", name, view, which);
      const auto bytes = encode_pixels(pixels, codec::EncodedFormat::png, 0);
      if (!bytes) return bytes.error();
      return write_file(std::filesystem::path(folder_) / file, *bytes);
    };
    if (auto trouble = put(picture.old_pixels, "old", picture.old_file)) return trouble;
    if (auto trouble = put(picture.new_pixels, "new", picture.new_file)) return trouble;
    if (auto trouble = put(picture.difference, "difference", picture.difference_file)) {
      return trouble;
    }
  }
  return std::nullopt;
}

std::string link_prefix(std::string_view prefix) {
  constexpr std::string_view kKept = "/:?#@!$&'*+,;=%~";
  std::string link;
  for (const char c : prefix) {
    if (is_plain(c) || kKept.find(c) != std::string_view::npos) {
      link += c;
    } else {
      link += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return link;
}

}  // namespace gltfx::tool
