// SPDX-License-Identifier: Apache-2.0
#include <gltfx/tinygltf.hpp>

#include <filesystem>
#include <new>
#include <utility>

#include <tiny_gltf.h>

#include "base/text.hpp"
#include "change/commit.hpp"
#include "change/rewrite.hpp"
#include "container/bytes.hpp"
#include "container/container.hpp"
#include "interop/model_text.hpp"
#include "interop/stored_bytes.hpp"
#include "rules/validated_asset.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

/// The conversion of one model into a valid asset.
class Serialization {
 public:
  Serialization(const tinygltf::Model& model, const FromTinygltfOptions& options)
      : model_(model), options_(options) {}

  /// `resolver` finds existing files.
  TinygltfReport run(MemoryAsset& asset, container::Resolver resolver) {
    MemoryAsset fresh;
    fresh.name = asset.name;
    write(fresh);
    if (notes_.error().empty()) validate(fresh, resolver);
    report_.error = notes_.error();
    report_.notes = notes_.take();
    report_.done = report_.error.empty();
    if (report_.done) asset = std::move(fresh);
    return std::move(report_);
  }

 private:
  void write(MemoryAsset& asset) {
    const bool glb = has_glb_ending(asset.name);
    interop::StoredBytes stored(model_, {asset.name, glb, options_.embed}, notes_);
    asset.bytes = interop::write_model(model_, stored.buffers(), stored.images(), notes_);
    asset.files = stored.take_files();
    if (!glb || !notes_.error().empty()) return;
    std::vector<container::Bytes> bin{container::Bytes::from_string(stored.take_bin())};
    if (bin.front().empty()) bin.clear();
    auto whole = change::make_glb(asset.bytes, std::move(bin));
    if (whole) {
      asset.bytes = container::join(*whole);
    } else {
      notes_.fail(whole.error().message);
    }
  }

  void validate(const MemoryAsset& asset, container::Resolver& resolver) {
    for (const auto& [path, bytes] : asset.files) {
      resolver.add(path, container::Bytes::from_string(bytes));
    }
    ValidateOptions options;
    options.jobs = options_.jobs;
    options.schemas = options_.schemas;
    container::Container opened =
        container::open_bytes(container::Bytes::from_string(asset.bytes), asset.name);
    validate::ValidatedAsset validated({asset.name, std::move(opened), resolver}, options);
    report_.validation = validated.take_report();
    if (report_.validation.counts.errors > 0) notes_.fail("the model is no valid glTF");
  }

  const tinygltf::Model& model_;
  const FromTinygltfOptions& options_;
  TinygltfReport report_;
  interop::Notes notes_;
};

void write_all(const MemoryAsset& asset, const std::string& path, TinygltfReport& report) {
  const fs::path folder = fs::path(path).parent_path();
  const auto write = [&](const fs::path& target, std::string_view bytes) {
    if (!report.done) return;
    if (auto trouble = change::write_new_asset_file(target, bytes)) {
      report.done = false;
      report.error = std::move(trouble->message);
      return;
    }
    report.written.push_back(target.native());
  };
  for (const auto& [name, bytes] : asset.files) write(folder / name, bytes);
  write(path, asset.bytes);
}

TinygltfReport failed(std::string why) {
  TinygltfReport report;
  report.error = std::move(why);
  return report;
}

// The library does not throw.
template <class Work>
TinygltfReport guarded(const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return failed("there is not enough memory to convert it");
  } catch (const fs::filesystem_error&) {
    return failed("the path cannot be looked up");
  }
}

}  // namespace

TinygltfReport from_tinygltf(const tinygltf::Model& model, MemoryAsset& asset,
                             const FromTinygltfOptions& options) {
  return guarded([&] { return Serialization(model, options).run(asset, {}); });
}

TinygltfReport from_tinygltf(const tinygltf::Model& model, const std::string& path,
                             const FromTinygltfOptions& options) {
  return guarded([&] {
    MemoryAsset asset;
    asset.name = path;
    const fs::path folder = fs::path(path).parent_path();
    TinygltfReport report = Serialization(model, options).run(asset, {folder, folder});
    if (report.done) write_all(asset, path, report);
    return report;
  });
}

}  // namespace gltfx
