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

/// A complete magic, or a file that was truncated inside it.
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
  return {name, media_type, true, {}};
}
constexpr Content other(std::string_view name) { return {name, {}, false, {}}; }
constexpr Content model_file(std::string_view name) {
  return {name, {}, false, "convert it to glTF 2.0: another name does not do that"};
}
constexpr Content tile(std::string_view name) {
  return {name, {}, false, "take the GLB out of the tile"};
}

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
    Magic{"\x28\xb5\x2f\xfd"sv, other("a Zstandard archive")},
    Magic{"7z\xbc\xaf\x27\x1c"sv, other("a 7-Zip archive")},
    Magic{"Rar!\x1a\x07"sv, other("a RAR archive")},
    Magic{"Kaydara FBX Binary"sv, model_file("an FBX model")},
    Magic{"; FBX "sv, model_file("an FBX model")},
    Magic{"BLENDER"sv, model_file("a Blender file")},
    Magic{"PXR-USDC"sv, model_file("a USD model")},
    Magic{"#usda"sv, model_file("a USD model")},
    Magic{"ply\n"sv, model_file("a PLY model")},
    Magic{"ply\r"sv, model_file("a PLY model")},
    Magic{"#VRML"sv, model_file("a VRML model")},
    Magic{"b3dm\1\0\0\0"sv, tile("a b3dm tile of 3D Tiles")},
    Magic{"i3dm\1\0\0\0"sv, tile("an i3dm tile of 3D Tiles")},
    Magic{"pnts\1\0\0\0"sv, model_file("a pnts tile of 3D Tiles (a point cloud)")},
    Magic{"cmpt\1\0\0\0"sv, tile("a cmpt tile of 3D Tiles")},
    Magic{"DRACO"sv, other("bare Draco data")},
};

bool begins_with(std::string_view text, std::string_view lower) {
  return text.size() >= lower.size() &&
         std::equal(lower.begin(), lower.end(), text.begin(),
                    [](char a, char b) { return a == ascii_lower(b); });
}

bool is_bmp(std::string_view bytes) {
  // After the size of the file are four reserved bytes, always 0.
  return bytes.size() >= 10 && bytes.starts_with("BM") && bytes.substr(6, 4) == "\0\0\0\0"sv;
}

// A ZIP archive whose first file is a USD layer.
bool is_usdz(std::string_view bytes) {
  if (!bytes.starts_with("PK\x03\x04") || bytes.size() < 30) return false;
  const auto length = static_cast<unsigned char>(bytes[26]);
  const std::string_view name = bytes.substr(30, length);
  const std::size_t dot = name.rfind(".usd");
  return dot != name.npos && name.size() - dot <= 5;
}

// 80 arbitrary bytes, the number of triangles, and 50 bytes per triangle.
bool is_binary_stl(std::string_view bytes, std::uint64_t size) {
  if (bytes.size() < 84) return false;
  std::uint64_t count = 0;
  for (unsigned i = 0; i < 4; ++i) {
    count |= std::uint64_t{static_cast<unsigned char>(bytes[80 + i])} << (8U * i);
  }
  return count > 0 && size == 84 + 50 * count;
}

// A statement of Wavefront OBJ at the start of a line: a vertex, a group or a material file.
bool is_obj(std::string_view text) {
  if (std::any_of(text.begin(), text.end(), is_binary_byte)) return false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    if (line.starts_with("mtllib ")) return true;
    const bool vertex = line.starts_with("v ") && line.find_first_of("0123456789") != line.npos;
    if (vertex) return true;
    constexpr std::string_view kSilent = "#og\r";
    if (!line.empty() && kSilent.find(line.front()) == kSilent.npos) return false;
  }
  return false;
}

Content name_model_text(std::string_view head) {
  if (head.starts_with("solid") && head.find("facet") != head.npos)
    return model_file("an STL model");
  if (head.starts_with("Z2xURg")) {
    return {"the base64 text of a GLB", {}, false, "decode it, for example with 'base64 --decode'"};
  }
  return is_obj(head) ? model_file("a Wavefront OBJ model") : Content{};
}

// Names text that may be the answer of a server instead of a file.
Content name_text(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  for (const std::string_view tag : {"<!doctype html"sv, "<html"sv, "<head"sv, "<body"sv}) {
    if (begins_with(head, tag)) return other("an HTML page (a failed download?)");
  }
  if (head.starts_with("<svg") || (head.starts_with("<?xml") && head.find("<svg") != head.npos)) {
    return image("an SVG drawing", "image/svg+xml");
  }
  if (head.find("<COLLADA") != head.npos) return model_file("a COLLADA model");
  if (head.starts_with("<?xml") || head.starts_with("<Error>")) {
    return other("an XML document (a failed download?)");
  }
  if (head.starts_with('{')) return other("JSON text (a failed download?)");
  if (head.starts_with("data:")) return other("text of a data URI");
  return name_model_text(head);
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

Content name_content(std::string_view bytes, std::uint64_t size) {
  if (bytes.empty()) return other("an empty file");
  if (is_usdz(bytes)) return model_file("a USDZ model");
  for (const Magic& magic : kMagics) {
    if (bytes.size() >= magic.offset && bytes.substr(magic.offset).starts_with(magic.bytes)) {
      return magic.content;
    }
  }
  if (is_bmp(bytes)) return image("a BMP", "image/bmp");
  if (is_git_lfs_pointer(bytes, bytes.size())) return other("a Git LFS pointer");
  const std::string_view head = bytes.substr(0, kSniffBytes);
  if (head.find_first_not_of('\0') == head.npos) return other("a file of zeros");
  if (is_binary_stl(bytes, size)) return model_file("an STL model");
  return name_text(head);
}

}  // namespace gltfx::container
