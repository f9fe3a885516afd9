// SPDX-License-Identifier: Apache-2.0
#include "container/content.hpp"

#include <algorithm>
#include <array>

#include "base/text.hpp"

namespace gltfx::container {
namespace {

constexpr std::string_view kGlbMagic = "glTF";
constexpr std::string_view kGlbSuffix = ".glb";
// https://github.com/git-lfs/git-lfs/blob/main/docs/spec.md: the version line comes first and the
// whole pointer has less than 1024 bytes.
constexpr std::string_view kLfsLine = "version https://git-lfs.github.com/spec/v1";
constexpr std::size_t kLfsMaximum = 1024;

bool named_glb(std::string_view name) {
  if (name.size() < kGlbSuffix.size()) return false;
  const std::string_view end = name.substr(name.size() - kGlbSuffix.size());
  return std::equal(end.begin(), end.end(), kGlbSuffix.begin(),
                    [](char a, char b) { return ascii_lower(a) == b; });
}

/// A whole magic, or a file that was cut inside it.
bool begins_glb(std::string_view head) {
  return head.starts_with(kGlbMagic) || kGlbMagic.starts_with(head);
}

bool is_binary_byte(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 && (byte < '\t' || byte > '\r');
}

bool begins_json(std::string_view head) {
  constexpr std::string_view kWhitespace = "{\t\n\r ";
  return kWhitespace.find(head.front()) != std::string_view::npos ||
         head.starts_with("\xEF\xBB\xBF") || head.starts_with("\xFF\xFE") ||
         head.starts_with("\xFE\xFF");
}

using namespace std::literals;

struct Magic {
  std::string_view bytes;
  Content content;
  std::size_t offset = 0;
};

constexpr Content image(std::string_view name, std::string_view media_type = {}) {
  return {name, media_type, true};
}
constexpr Content other(std::string_view name) { return {name, {}, false}; }

constexpr std::array kMagics{
    Magic{"GIF87a"sv, image("a GIF", "image/gif")},
    Magic{"GIF89a"sv, image("a GIF", "image/gif")},
    Magic{"II*\0"sv, image("a TIFF", "image/tiff")},
    Magic{"MM\0*"sv, image("a TIFF", "image/tiff")},
    Magic{"II+\0"sv, image("a BigTIFF", "image/tiff")},
    Magic{"MM\0+"sv, image("a BigTIFF", "image/tiff")},
    Magic{"\x76\x2f\x31\x01"sv, image("an OpenEXR file", "image/x-exr")},
    Magic{"\x20\x42\x44\x56\0\0\0\0"sv, image("an OpenVDB volume", "application/x-vdb")},
    Magic{"DDS "sv, image("a DDS texture", "image/vnd-ms.dds")},
    Magic{"\xabKTX 11\xbb\r\n\x1a\n"sv, image("KTX 1, not KTX 2", "image/ktx")},
    Magic{"\x13\xab\xa1\x5c"sv, image("a bare ASTC texture")},
    Magic{"sB\x13\0"sv, image("a .basis texture, not KTX 2")},
    Magic{"PVR\x03"sv, image("a PVR texture")},
    Magic{"#?RADIANCE"sv, image("a Radiance HDR file", "image/vnd.radiance")},
    Magic{"#?RGBE"sv, image("a Radiance HDR file", "image/vnd.radiance")},
    Magic{"8BPS"sv, image("a Photoshop document")},
    Magic{"\0\0\x01\0"sv, image("a Windows icon")},
    Magic{"\0\0\0\x0cjP  \r\n\x87\n"sv, image("a JPEG 2000 file", "image/jp2")},
    Magic{"\0\0\0\x0cJXL \r\n\x87\n"sv, image("a JPEG XL file", "image/jxl")},
    Magic{"\xff\x0a"sv, image("a JPEG XL file", "image/jxl")},
    Magic{"ftypavif"sv, image("an AVIF", "image/avif"), 4},
    Magic{"ftypavis"sv, image("an AVIF", "image/avif"), 4},
    Magic{"ftypheic"sv, image("a HEIC", "image/heic"), 4},
    Magic{"ftypheix"sv, image("a HEIC", "image/heic"), 4},
    Magic{"ftypmif1"sv, image("a HEIF", "image/heif"), 4},
    Magic{"ftyp"sv, image("a video or another MP4 file"), 4},
    Magic{"\x89PNG\r\n\x1a\n"sv, image("a truncated PNG")},
    Magic{"\xff\xd8\xff"sv, image("a truncated JPEG")},
    Magic{"\xabKTX 20\xbb\r\n\x1a\n"sv, image("a truncated KTX 2 file")},
    Magic{"RIFF"sv, image("a RIFF file, but not a WebP image")},
    Magic{"glTF"sv, other("a GLB file")},
    Magic{"PK\x03\x04"sv, other("a ZIP archive")},
    Magic{"\x1f\x8b"sv, other("a gzip archive")},
    Magic{"%PDF-"sv, other("a PDF document")},
};

bool begins_with(std::string_view text, std::string_view lower) {
  return text.size() >= lower.size() &&
         std::equal(lower.begin(), lower.end(), text.begin(),
                    [](char a, char b) { return a == ascii_lower(b); });
}

bool is_bmp(std::string_view bytes) {
  // Behind the size of the file are four reserved bytes, always 0.
  return bytes.size() >= 10 && bytes.starts_with("BM") && bytes.substr(6, 4) == "\0\0\0\0"sv;
}

// Of text that may be an answer of a server instead of a file.
Content name_text(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  for (const std::string_view tag : {"<!doctype html"sv, "<html"sv, "<head"sv, "<body"sv}) {
    if (begins_with(head, tag)) return other("an HTML page (a failed download?)");
  }
  if (head.starts_with("<svg") || (head.starts_with("<?xml") && head.find("<svg") != head.npos)) {
    return image("an SVG drawing", "image/svg+xml");
  }
  if (head.starts_with("<?xml") || head.starts_with("<Error>")) {
    return other("an XML document (a failed download?)");
  }
  if (head.starts_with('{')) return other("JSON text (a failed download?)");
  if (head.starts_with("data:")) return other("text of a data URI");
  return {};
}

}  // namespace

bool is_git_lfs_pointer(std::string_view head, std::size_t file_size) {
  return file_size < kLfsMaximum && head.starts_with(kLfsLine);
}

Format sniff(std::string_view head, std::size_t file_size, std::string_view name) {
  head = head.substr(0, kSniffBytes);
  if (head.empty()) return named_glb(name) ? Format::glb : Format::empty;
  if (begins_glb(head)) return Format::glb;
  if (is_git_lfs_pointer(head, file_size)) return Format::git_lfs_pointer;
  if (begins_json(head)) return Format::gltf;
  if (named_glb(name)) return Format::glb;
  return std::any_of(head.begin(), head.end(), is_binary_byte) ? Format::unknown : Format::gltf;
}

Content name_content(std::string_view bytes) {
  if (bytes.empty()) return other("an empty file");
  for (const Magic& magic : kMagics) {
    if (bytes.size() >= magic.offset && bytes.substr(magic.offset).starts_with(magic.bytes)) {
      return magic.content;
    }
  }
  if (is_bmp(bytes)) return image("a BMP", "image/bmp");
  if (is_git_lfs_pointer(bytes, bytes.size())) return other("a Git LFS pointer");
  const std::string_view head = bytes.substr(0, kSniffBytes);
  if (head.find_first_not_of('\0') == head.npos) return other("a file of zeros");
  return name_text(head);
}

}  // namespace gltfx::container
