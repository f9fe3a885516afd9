// SPDX-License-Identifier: Apache-2.0
/// Allowed includes: modules on layers, and third-party headers in their modules.
#include <map>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source.hpp"

namespace gltfx::structure {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Allowed includes of a file: headers of its own module, and of modules on layers below.
const std::map<std::string, int, std::less<>> kLayers{
    {"base", 0},    {"json", 1},   {"codec", 1},   {"image", 2},  {"container", 2},
    {"schema", 2},  {"report", 2}, {"target", 2},  {"model", 3},  {"graph", 3},
    {"shader", 1},  {"render", 2}, {"preview", 3}, {"change", 4}, {"measure", 4},
    {"inspect", 5}, {"rules", 5},  {"steps", 5},   {"prove", 6},  {"pipeline", 7},
    {"interop", 7}, {"tools", 8},
};

// The module a public header belongs to.
const std::map<std::string, std::string, std::less<>> kPublicHeaders{
    {"gltfx/diagnostic.hpp", "base"},
    {"gltfx/version.hpp", "base"},
    {"gltfx/searched_folders.hpp", "base"},
    {"gltfx/edited_bytes.hpp", "base"},
    {"gltfx/memory_asset.hpp", "container"},
    {"gltfx/decoders.hpp", "codec"},
    {"gltfx/schema.hpp", "schema"},
    {"gltfx/report.hpp", "report"},
    {"gltfx/targets.hpp", "target"},
    {"gltfx/validate.hpp", "rules"},
    {"gltfx/own_rules.hpp", "rules"},
    {"gltfx/upgrade.hpp", "steps"},
    {"gltfx/compare.hpp", "prove"},
    {"gltfx/convert.hpp", "steps"},
    {"gltfx/edited_file.hpp", "change"},
    {"gltfx/fix.hpp", "rules"},
    {"gltfx/deletion.hpp", "pipeline"},
    {"gltfx/pipeline.hpp", "pipeline"},
    {"gltfx/mapping.hpp", "container"},
    {"gltfx/bake.hpp", "report"},
    {"gltfx/vec3.hpp", "base"},
    {"gltfx/loss_bounds.hpp", "base"},
    {"gltfx/material.hpp", "shader"},
    {"gltfx/result_cache.hpp", "pipeline"},
    {"gltfx/inspect.hpp", "report"},
    {"gltfx/measure.hpp", "base"},
    {"gltfx/limit.hpp", "base"},
    {"gltfx/page.hpp", "report"},
    {"gltfx/tinygltf.hpp", "interop"},
};

// Lower layers that a module must not include.
const std::vector<std::pair<std::string, std::string>> kNever{
    {"render", "json"}, {"preview", "json"}, {"preview", "schema"}};

// Where a library's headers may be included: a start of the path. A header that is named may do so.
const std::vector<std::pair<std::string, std::vector<std::string_view>>> kThirdParty{
    {"simdjson.h", {"libgltfx/json/"}},
    {"nlohmann/", {"libgltfx/schema/", "libgltfx/report/"}},
    {"tbb/", {"libgltfx/render/bvh_build.cpp"}},
    {"xxhash.h", {"libgltfx/base/hash.cpp"}},
    {"fast_float/", {"libgltfx/base/number.cpp"}},
    {"emscripten.h", {"tools/gltfx_wasm/"}},
    {"sodium.h", {"libgltfx/pipeline/seal.cpp"}},
    {"meshoptimizer.h", {"libgltfx/model/"}},
    {"embree", {"libgltfx/render/embree.hpp"}},
    {"stb/", {"libgltfx/preview/label_font.cpp"}},
    {"CLI/", {"tools/gltfx/command_line.cpp"}},
    {"toml++/", {"tools/gltfx/toml.hpp"}},
    {"fmt/", {"libgltfx/", "tools/gltfx/", "tools/gltfx_manual/"}},
    {"draco/", {"tools/gltfx_codec/draco_"}},
    {"Imf", {"tools/gltfx_codec/exr_"}},
    {"Iex", {"tools/gltfx_codec/exr_"}},
    {"jpeglib.h", {"tools/gltfx_codec/jpeg_"}},
    {"jerror.h", {"tools/gltfx_codec/jpeg_"}},
    {"webp/", {"tools/gltfx_codec/webp_"}},
    {"png.h", {"tools/gltfx_codec/png_"}},
    {"zlib.h", {"tools/gltfx_codec/png_"}},
    {"zstd.h", {"tools/gltfx_codec/ktx2_"}},
    {"avif/", {"tools/gltfx_codec/avif_"}},
    {"OpenImageIO/", {"tools/gltfx_codec/openimageio_"}},
    {"tiny_gltf.h", {"libgltfx/interop/"}},
};

const std::vector<std::string_view> kSystemHeaders{
    "fcntl.h",        "unistd.h",        "poll.h",      "fnmatch.h",     "dirent.h",
    "iconv.h",        "sys/stat.h",      "sys/mman.h",  "sys/syscall.h", "linux/openat2.h",
    "sched.h",        "sys/socket.h",    "sys/types.h", "sys/wait.h",    "spawn.h",
    "sys/prctl.h",    "sys/resource.h",  "sys/time.h",  "linux/audit.h", "linux/capability.h",
    "linux/filter.h", "linux/seccomp.h", "malloc.h",    "sys/file.h",    "sys/xattr.h",
    "elf.h",          "link.h",          "pthread.h",   "dlfcn.h"};

bool is_public(std::string_view path) { return path.starts_with("libgltfx/include/"); }

std::string module_of(std::string_view path) {
  if (path.starts_with("tools/")) return "tools";
  constexpr std::string_view kLibrary = "libgltfx/";
  if (is_public(path)) {
    const auto header = kPublicHeaders.find(path.substr(kLibrary.size() + 8));
    return header == kPublicHeaders.end() ? std::string() : header->second;
  }
  if (!path.starts_with(kLibrary)) return {};
  path.remove_prefix(kLibrary.size());
  return std::string(path.substr(0, path.find('/')));
}

// The module an include leads into; nothing for the standard library and other libraries.
std::optional<std::string> module_of(const Include& include) {
  if (include.name.starts_with("gltfx/")) {
    const auto header = kPublicHeaders.find(include.name);
    return header == kPublicHeaders.end() ? "an unknown public header" : header->second;
  }
  if (include.angled) return std::nullopt;
  const std::size_t slash = include.name.find('/');
  if (slash == std::string::npos) return std::nullopt;
  return include.name.substr(0, slash);
}

bool allowed(const std::string& from, const std::string& to) {
  if (from == to) return true;
  for (const auto& [module, other] : kNever) {
    if (module == from && other == to) return false;
  }
  const auto own = kLayers.find(from);
  const auto layer = kLayers.find(to);
  return own != kLayers.end() && layer != kLayers.end() && layer->second < own->second;
}

Problems check_layers(const Source& source) {
  Problems problems;
  const std::string own = module_of(source.path);
  if (kLayers.find(own) == kLayers.end()) {
    return {problem(source, 1, "belongs to no module: add it to the table of layers")};
  }
  for (const Include& include : includes_of(source.text)) {
    const auto module = module_of(include);
    if (!module || allowed(own, *module)) continue;
    problems.push_back(problem(source, include.line,
                               own + " must not include " + *module + " (" + include.name + ")"));
  }
  return problems;
}

bool is_standard(const Include& include) {
  return include.name.find_first_of("./") == std::string::npos;
}

Problems check_third_party(const Source& source) {
  Problems problems;
  const auto complain = [&](const Include& include, std::string_view why) {
    problems.push_back(problem(source, include.line, include.name + " " + std::string(why)));
  };
  for (const Include& include : includes_of(source.text)) {
    if (!include.angled || include.name.starts_with("gltfx/") || is_standard(include)) continue;
    if (is_public(source.path)) {
      complain(include, "must not be in a public header");
      continue;
    }
    if (starts_with_any(include.name, kSystemHeaders)) continue;
    const auto library =
        std::find_if(kThirdParty.begin(), kThirdParty.end(),
                     [&](const auto& entry) { return include.name.starts_with(entry.first); });
    if (library == kThirdParty.end()) {
      complain(include, "is in no table of allowed headers");
    } else if (!starts_with_any(source.path, library->second)) {
      complain(include, "must not be included here");
    } else if (source.path.ends_with(".hpp") &&
               std::find(library->second.begin(), library->second.end(), source.path) ==
                   library->second.end()) {
      complain(include, "must only be included in .cpp files");
    }
  }
  return problems;
}

template <class Check>
Problems over_all(const Check& check) {
  Problems problems;
  for (const Source& source : cpp_below({"libgltfx", "tools"})) {
    const Problems found = check(source);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  return problems;
}

TEST(Layers, FilesIncludeTheirOwnModuleAndLowerLayersOnly) {
  EXPECT_THAT(over_all(check_layers), IsEmpty());
}

TEST(Layers, AnUpwardIncludeIsFound) {
  EXPECT_THAT(check_layers({"libgltfx/json/a.cpp", "\n#include \"model/mesh.hpp\"\n"}),
              ElementsAre("libgltfx/json/a.cpp:2: json must not include model (model/mesh.hpp)"));
  EXPECT_THAT(check_layers({"libgltfx/report/a.cpp", "#include <gltfx/validate.hpp>\n"}),
              ElementsAre(HasSubstr("report must not include rules")));
}

TEST(Layers, AModuleOnTheSameLayerIsFound) {
  EXPECT_THAT(check_layers({"libgltfx/schema/a.hpp", "#include \"container/uri.hpp\"\n"}),
              ElementsAre(HasSubstr("schema must not include container")));
}

TEST(Layers, RenderingDoesNotReachForJson) {
  EXPECT_THAT(check_layers({"libgltfx/render/a.cpp", "#include \"json/parse.hpp\"\n"}),
              ElementsAre(HasSubstr("render must not include json")));
}

TEST(Layers, AFileOrHeaderWithoutModuleIsFound) {
  EXPECT_THAT(check_layers({"libgltfx/cellar/a.cpp", ""}), ElementsAre(HasSubstr("no module")));
  EXPECT_THAT(check_layers({"libgltfx/include/gltfx/attic.hpp", ""}),
              ElementsAre(HasSubstr("no module")));
  EXPECT_THAT(check_layers({"libgltfx/base/a.cpp", "#include <gltfx/attic.hpp>\n"}),
              ElementsAre(HasSubstr("unknown public header")));
}

TEST(Layers, WhatIsBelowMayBeIncluded) {
  EXPECT_THAT(check_layers({"libgltfx/rules/a.cpp",
                            "#include <gltfx/report.hpp>\n#include \"json/parse.hpp\"\n"
                            "#include \"rules/b.hpp\"\n#include <vector>\n"}),
              IsEmpty());
}

TEST(ThirdParty, HeadersStayInTheirModules) { EXPECT_THAT(over_all(check_third_party), IsEmpty()); }

TEST(ThirdParty, AHeaderOutsideItsModuleIsFound) {
  EXPECT_THAT(check_third_party({"libgltfx/model/a.cpp", "#include <simdjson.h>\n"}),
              ElementsAre(HasSubstr("must not be included here")));
  EXPECT_THAT(check_third_party({"libgltfx/base/a.cpp", "#include <tbb/info.h>\n"}),
              ElementsAre(HasSubstr("must not be included here")));
  EXPECT_THAT(check_third_party({"libgltfx/pipeline/a.cpp", "#include <CLI/CLI.hpp>\n"}),
              ElementsAre(HasSubstr("must not be included here")));
}

TEST(ThirdParty, AnUnknownLibraryIsFound) {
  EXPECT_THAT(check_third_party({"libgltfx/base/a.cpp", "#include <boost/any.hpp>\n"}),
              ElementsAre(HasSubstr("no table")));
}

TEST(ThirdParty, FmtInAHeaderIsFound) {
  EXPECT_THAT(check_third_party({"libgltfx/json/a.hpp", "#include <fmt/format.h>\n"}),
              ElementsAre(HasSubstr("only be included in .cpp")));
}

TEST(ThirdParty, AnyLibraryInAPublicHeaderIsFound) {
  EXPECT_THAT(
      check_third_party({"libgltfx/include/gltfx/report.hpp", "#include <nlohmann/json.hpp>\n"}),
      ElementsAre(HasSubstr("public header")));
}

}  // namespace
}  // namespace gltfx::structure
