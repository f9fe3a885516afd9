// SPDX-License-Identifier: Apache-2.0
// All fixtures are packed into a GLB and unpacked. Only the location of bytes changes.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <gmock/gmock.h>

#include "convert_support.hpp"
#include "model/asset_bytes.hpp"
#include "model/opened_asset.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using container::test::content_of;
using container::test::TempFolder;
using test::options_to;
using test::OrderedJson;
using test::StoredAsset;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

// All but those of glTF 2.1; convert_glb_version_test.cpp has its containers.
std::vector<fs::path> assets_below_fixtures() {
  std::vector<fs::path> assets;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(GLTFX_SOURCE_DIR) / "fixtures")) {
    const std::string ending = entry.path().extension().native();
    if (entry.path().parent_path().parent_path().filename() == "gltf-2.1") continue;
    if (ending == ".gltf" || ending == ".glb") assets.push_back(entry.path());
  }
  std::sort(assets.begin(), assets.end());
  return assets;
}

// Removes all members that define the location of bytes.
void forget_places(OrderedJson& json) {
  for (auto& image : json["images"]) {
    for (const char* member : {"uri", "bufferView", "mimeType"}) image.erase(member);
  }
  json.erase("buffers");
  for (auto& view : json["bufferViews"]) {
    for (const char* member : {"buffer", "byteOffset"}) view.erase(member);
    if (!view.contains("extensions")) continue;
    for (auto& extension : view["extensions"]) {
      for (const char* member : {"buffer", "byteOffset"}) extension.erase(member);
    }
  }
}

// Renumbers references to other views as if there were no views of images.
void renumber_views(OrderedJson& json, const std::set<std::uint64_t>& of_images) {
  if (!json.is_structured()) return;
  for (auto& value : json) renumber_views(value, of_images);
  if (!json.is_object() || !json.contains("bufferView")) return;
  auto& view = json["bufferView"];
  if (!view.is_number_unsigned()) return;
  const auto before =
      std::distance(of_images.begin(), of_images.lower_bound(view.get<std::uint64_t>()));
  view = view.get<std::uint64_t>() - static_cast<std::uint64_t>(before);
}

// Views of images are added and removed; all others keep their order.
void forget_image_views(OrderedJson& json, const std::set<std::uint64_t>& of_images) {
  if (!json.contains("bufferViews") && of_images.empty()) return;
  OrderedJson kept = OrderedJson::array();
  for (std::size_t i = 0; i < json["bufferViews"].size(); ++i) {
    if (!of_images.contains(i)) kept.push_back(json["bufferViews"][i]);
  }
  json["bufferViews"] = kept;
}

std::set<std::uint64_t> views_of_images(const OrderedJson& json) {
  std::set<std::uint64_t> views;
  if (!json.contains("images")) return views;
  for (const auto& image : json["images"]) {
    if (image.is_object() && image.contains("bufferView"))
      views.insert(image["bufferView"].get<std::uint64_t>());
  }
  return views;
}

OrderedJson without_places(const fs::path& path) {
  OrderedJson json = StoredAsset::at(path).json();
  const auto views = views_of_images(json);
  forget_places(json);
  renumber_views(json, views);
  forget_image_views(json, views);
  return json;
}

model::OpenedAsset open(const fs::path& path) {
  return {path.native(), *container::open_file(path),
          container::Resolver(path.parent_path(), path.parent_path())};
}

// The bytes of all views, with images separate.
std::vector<std::string> data_of(const fs::path& path) {
  const model::OpenedAsset asset = open(path);
  const model::Asset elements(asset.document());
  model::AssetBytes bytes(elements, asset.container(), asset.resolver());
  const auto of_images = views_of_images(StoredAsset::at(path).json());
  std::vector<std::string> data;
  for (std::size_t i = 0; i < asset.views().buffer_views.size(); ++i) {
    const model::BufferView& view = asset.views().buffer_views[i];
    if (of_images.contains(i) || !view.buffer) continue;
    const auto buffer = bytes.buffer(*view.buffer);
    const std::uint64_t begin = view.byte_offset.value_or(0);
    const bool there = buffer && begin + *view.byte_length <= buffer->size();
    data.emplace_back(there ? buffer->text().substr(begin, *view.byte_length) : "none");
  }
  for (std::uint64_t i = 0; i < elements.count(model::RootArray::images); ++i) {
    const auto image = bytes.image(i);
    data.emplace_back(image ? image->text() : "none");
  }
  return data;
}

bool is_binary(const fs::path& path) { return path.extension() == ".glb"; }

class EveryFixture : public testing::Test {
 protected:
  // Nothing: the asset was refused with a reason.
  std::optional<fs::path> stored(const fs::path& from, std::string_view folder, StoredAs to) {
    ConvertOptions options =
        options_to(folder_.path() / folder / (to == StoredAs::glb ? "a.glb" : "a.gltf"));
    options.to = to;
    const ConvertReport report = convert_file(from.native(), options);
    if (report.written) return options.output;
    EXPECT_NE(report.error, "") << from;
    EXPECT_FALSE(fs::exists(options.output)) << from;
    return std::nullopt;
  }

  void expect_same(const fs::path& from, const fs::path& now) {
    EXPECT_EQ(without_places(from), without_places(now)) << from;
    EXPECT_EQ(data_of(from), data_of(now)) << from;
  }

  // A second conversion changes nothing.
  void expect_settled(const fs::path& now, StoredAs to) {
    const auto again = stored(now, "again", to);
    ASSERT_TRUE(again) << now;
    EXPECT_EQ(content_of(*again), content_of(now)) << now;
    fs::remove_all(again->parent_path());
  }

  TempFolder folder_;
};

TEST_F(EveryFixture, CanBePackedAndUnpacked) {
  std::vector<std::string> refused;
  for (const fs::path& from : assets_below_fixtures()) {
    const auto glb = stored(from, "glb", StoredAs::glb);
    if (glb) {
      expect_same(from, *glb);
      expect_settled(*glb, StoredAs::glb);
      if (const auto back = stored(*glb, "back", StoredAs::gltf)) {
        expect_same(from, *back);
        expect_settled(*back, StoredAs::gltf);
        fs::remove_all(back->parent_path());
      } else {
        ADD_FAILURE() << from << " does not come back";
      }
    } else {
      refused.push_back(from.filename().native());
    }
    fs::remove_all(folder_.path() / "glb");
  }
  // Assets without text, with glTF 1.0, and with missing data.
  EXPECT_THAT(refused,
              UnorderedElementsAre("triangle-lfs-buffer.gltf", "triangle-missing-file.gltf",
                                   "tumbler-version-3.glb", "version-1.gltf"));
}

TEST_F(EveryFixture, CanBeStoredInDataUris) {
  for (const fs::path& from : assets_below_fixtures()) {
    const auto embedded = stored(from, "embedded", StoredAs::embedded);
    if (!embedded) continue;
    expect_same(from, *embedded);
    EXPECT_THAT(StoredAsset::at(*embedded).json().value("buffers", OrderedJson()).dump(),
                Not(HasSubstr(".bin\"")))
        << from;
    fs::remove_all(embedded->parent_path());
  }
}

TEST_F(EveryFixture, StoresItsImagesInAnotherFormat) {
  std::size_t changed = 0;
  for (const fs::path& from : assets_below_fixtures()) {
    for (const ImageTarget target :
         {ImageTarget::webp, ImageTarget::png, ImageTarget::ktx2, ImageTarget::legal}) {
      ConvertOptions options =
          options_to(folder_.path() / "images" / ("a" + from.extension().native()));
      options.images = {{target, std::nullopt}};
      const ConvertReport report = convert_file(from.native(), options);
      if (!report.written) {
        EXPECT_NE(report.error, "") << from;
        continue;
      }
      changed += report.changes ? 1 : 0;
      if (report.changes && is_binary(from) && report.new_files.empty()) {
        EXPECT_EQ(report.steps.back().bytes_after, fs::file_size(options.output)) << from;
      }
      EXPECT_FALSE(convert_file(options.output, ConvertOptions(options)).changes) << from;
      fs::remove_all(folder_.path() / "images");
    }
  }
  EXPECT_GT(changed, 20U);
}

TEST_F(EveryFixture, CanBePrunedOnce) {
  int changed = 0;
  for (const fs::path& from : assets_below_fixtures()) {
    ConvertOptions options = options_to(folder_.path() / "once" / from.filename());
    options.prune = options.dedup = options.partial = true;
    const ConvertReport report = convert_file(from.native(), options);
    if (!report.changes) continue;
    ++changed;
    ASSERT_TRUE(report.written) << from << report.error;
    const fs::path once = options.output;
    EXPECT_LE(report.steps.back().bytes_after, report.steps.front().bytes_before) << from;
    const OrderedJson before = StoredAsset::at(from).json();
    const OrderedJson after = StoredAsset::at(once).json();
    for (const char* list : {"scenes", "nodes", "cameras", "animations"}) {
      EXPECT_EQ(before.value(list, OrderedJson()).size(), after.value(list, OrderedJson()).size())
          << from << list;
    }
    options.output = (folder_.path() / "twice" / from.filename()).native();
    const ConvertReport again = convert_file(once.native(), options);
    EXPECT_FALSE(again.changes) << from << again.steps[0].what << again.steps[1].what;
  }
  EXPECT_GE(changed, 10);
}

TEST_F(EveryFixture, ConvertsToTheSameBytesInMemory) {
  for (const fs::path& from : assets_below_fixtures()) {
    if (is_binary(from)) continue;
    const auto glb = stored(from, "glb", StoredAs::glb);
    if (!glb) continue;
    MemoryAsset asset{content_of(from), from.filename().native()};
    asset.names = MemoryAsset::Names::paths;
    asset.read = [&](const std::string& path) -> std::optional<std::string> {
      const fs::path file = from.parent_path() / path;
      return fs::is_regular_file(file) ? std::optional(content_of(file)) : std::nullopt;
    };
    ConvertOptions options;
    options.to = StoredAs::glb;
    const auto now = convert_bytes(asset, options);
    EXPECT_EQ(now.bytes, content_of(*glb)) << from << now.report.error;
    EXPECT_THAT(now.files, IsEmpty());
    fs::remove_all(glb->parent_path());
  }
}

TEST_F(EveryFixture, ConvertsToTheSameBytesForAnyNumberOfThreads) {
  std::map<fs::path, std::string> results[2];
  for (const unsigned jobs : {1U, 4U}) {
    std::vector<EditInput> inputs;
    const std::vector<fs::path> assets = assets_below_fixtures();
    const fs::path out = folder_.path() / std::to_string(jobs);
    for (std::size_t i = 0; i < assets.size(); ++i) {
      inputs.push_back({assets[i].native(), (out / (std::to_string(i) + ".gltf")).native()});
    }
    ConvertOptions options;
    options.to = StoredAs::gltf;
    options.shared_folder = true;
    std::string errors;
    convert_files(inputs, options, jobs, [&](ConvertReport&& report) { errors += report.error; });
    auto& found = results[jobs == 1 ? 0 : 1];
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
      if (entry.is_regular_file())
        found[fs::relative(entry.path(), out)] = content_of(entry.path());
    }
    found["errors"] = errors.substr(0, errors.find(out.native()));
  }
  EXPECT_EQ(results[0], results[1]);
}

// Each conversion compares all geometry; a second compression changes nothing.
TEST_F(EveryFixture, CanBeCompressedAndDecodedWithBothCodecs) {
  for (const Compression codec : {Compression::meshopt, Compression::draco, Compression::none}) {
    for (const fs::path& from : assets_below_fixtures()) {
      ConvertOptions options = options_to(folder_.path() / "one" / "a.gltf");
      options.to = StoredAs::gltf;
      options.compress = codec;
      const ConvertReport report = convert_file(from.native(), options);
      EXPECT_THAT(report.error, Not(HasSubstr("the new file would"))) << from;
      if (report.written) {
        const fs::path one = options.output;
        options.output = (folder_.path() / "two" / "a.gltf").native();
        EXPECT_FALSE(convert_file(one.native(), options).changes) << from;
      }
      fs::remove_all(folder_.path() / "one");
      fs::remove_all(folder_.path() / "two");
    }
  }
}

}  // namespace
}  // namespace gltfx
