// SPDX-License-Identifier: Apache-2.0
#include <gltfx/tinygltf.hpp>

#include <filesystem>
#include <new>
#include <utility>

#include <tiny_gltf.h>

#include "base/text.hpp"
#include "container/container.hpp"
#include "container/memory_asset.hpp"
#include "interop/decoded_data.hpp"
#include "interop/image_data.hpp"
#include "interop/model_text.hpp"
#include "model/fields.hpp"
#include "model/resource_data.hpp"
#include "rules/validated_asset.hpp"
#include "rules/validator.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

/// The conversion of one asset into a model.
class Conversion {
 public:
  Conversion(model::OpenedAsset asset, const ToTinygltfOptions& options)
      : options_(options), asset_(std::move(asset), validate_options(options)) {}

  TinygltfReport run(tinygltf::Model& model) {
    tinygltf::Model fresh;
    if (is_convertible()) convert(fresh);
    TinygltfReport report;
    report.validation = asset_.take_report();
    report.error = notes_.error();
    report.notes = notes_.take();
    report.done = report.error.empty();
    if (report.done) model = std::move(fresh);
    return report;
  }

 private:
  static ValidateOptions validate_options(const ToTinygltfOptions& options) {
    ValidateOptions wanted;
    wanted.root = options.root;
    wanted.jobs = options.jobs;
    wanted.schemas = options.schemas;
    return wanted;
  }

  bool is_convertible() {
    if (asset_.report().counts.errors > 0) notes_.fail("it is not valid");
    if (asset_.report().unverified > 0) notes_.fail("some of its files are Git LFS pointers");
    if (!asset_.asset().container().json) notes_.fail("it holds no glTF");
    return notes_.error().empty();
  }

  void convert(tinygltf::Model& model) {
    const model::OpenedAsset& opened = asset_.asset();
    interop::read_model(opened.document(), model, notes_);
    const model::Asset asset(opened.document());
    const model::Views& views = opened.views();
    container::OpenedFiles files(opened.resolver());
    const auto loaded =
        model::load_resources(opened.container(), files, asset, views, options_.jobs);
    if (!loaded.missing.empty()) {
      notes_.fail(std::string(without_stop(loaded.missing.front().sentence())));
      return;
    }
    copy_buffers(asset, loaded.data, model);
    model::DracoMeshes draco;
    draco.add_all(asset, views, loaded.data);
    draco.decode(codec::Client::shared(), options_.jobs);
    if (!notes_.error().empty()) return;
    interop::place_decoded({asset, views, loaded.data, draco}, options_.expand_sparse, model,
                           notes_);
    interop::place_images(loaded.data, options_.images, options_.jobs, model, notes_);
  }

  // Copies the declared number of bytes: files may be longer.
  void copy_buffers(const model::Asset& asset, const model::ResourceData& resources,
                    tinygltf::Model& model) {
    const auto& objects = asset.elements(model::RootArray::buffers);
    for (std::size_t i = 0; i < model.buffers.size() && i < objects.size(); ++i) {
      const auto length = model::unsigned_member(asset.document(), objects[i], "byteLength");
      if (!resources.buffers[i] || !length || *length > resources.buffers[i]->size()) continue;
      const auto bytes = resources.buffers[i]->view().first(static_cast<std::size_t>(*length));
      const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
      model.buffers[i].data.assign(first, first + bytes.size());
    }
  }

  const ToTinygltfOptions& options_;
  validate::ValidatedAsset asset_;
  interop::Notes notes_;
};

TinygltfReport failed(const std::string& name, std::string why) {
  TinygltfReport report;
  report.validation = validate::unreadable(name, why, {});
  report.error = std::move(why);
  return report;
}

// The library does not throw.
template <class Work>
TinygltfReport guarded(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return failed(name, "there is not enough memory to convert it");
  } catch (const fs::filesystem_error&) {
    return failed(name, "the path cannot be looked up");
  }
}

}  // namespace

TinygltfReport to_tinygltf(const std::string& path, tinygltf::Model& model,
                           const ToTinygltfOptions& options) {
  return guarded(path, [&] {
    auto opened = options.root.empty()
                      ? container::open_file(path)
                      : container::open_file(container::open_within(options.root, path), path);
    if (!opened) return failed(path, opened.error().message);
    const fs::path folder = fs::path(path).parent_path();
    const container::Resolver resolver(options.root.empty() ? folder : fs::path(options.root),
                                       folder);
    return Conversion({path, *std::move(opened), resolver}, options).run(model);
  });
}

TinygltfReport to_tinygltf(const MemoryAsset& asset, tinygltf::Model& model,
                           const ToTinygltfOptions& options) {
  return guarded(asset.name, [&] {
    container::Container opened = container::open_memory(asset.bytes, asset.name, asset.format);
    MemoryAsset rest{{}, {}, asset.format, asset.read, asset.names, asset.files};
    return Conversion({asset.name, std::move(opened),
                       container::resolver_of(std::move(rest), options.root)},
                      options)
        .run(model);
  });
}

}  // namespace gltfx
