// SPDX-License-Identifier: Apache-2.0
#include <gltfx/tinygltf.hpp>

#include <filesystem>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <tiny_gltf.h>

#include "container/container.hpp"
#include "interop/decoded_data.hpp"
#include "interop/image_data.hpp"
#include "interop/model_text.hpp"
#include "json/parse.hpp"
#include "model/fields.hpp"
#include "model/load_resources.hpp"
#include "schema/compile.hpp"
#include "validate/validator.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;

/// One asset on its way into a model.
class Conversion {
 public:
  Conversion(const container::Container& container, const std::string& name,
             const container::Resolver& resolver, const ToTinygltfOptions& options)
      : container_(container), name_(name), resolver_(resolver), options_(options) {}

  TinygltfReport run(tinygltf::Model& model) {
    tinygltf::Model fresh;
    if (validate()) convert(fresh);
    report_.error = notes_.error();
    report_.notes = notes_.take();
    report_.done = report_.error.empty();
    if (report_.done) model = std::move(fresh);
    return std::move(report_);
  }

 private:
  bool validate() {
    ValidateOptions options;
    options.root = options_.root;
    options.jobs = options_.jobs;
    options.schemas = options_.schemas;
    report_.validation = validate::validate(container_, name_, resolver_, options);
    if (report_.validation.counts.errors > 0) notes_.fail("it is not valid");
    if (report_.validation.unverified > 0) notes_.fail("Git-LFS pointers stand for its files");
    if (!container_.json) notes_.fail("it holds no glTF");
    return notes_.error().empty();
  }

  void convert(tinygltf::Model& model) {
    const json::Parsed parsed = json::parse(container_.json);
    interop::read_model(parsed.document, model, notes_);
    const model::Asset asset(parsed.document);
    const model::Views views(asset);
    const auto loaded = model::load_resources(container_, resolver_, asset, views, options_.jobs);
    if (!loaded.notes.empty()) {
      std::string why = loaded.notes.front();
      if (why.ends_with('.')) why.pop_back();
      notes_.fail(std::move(why));
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

  // As many bytes as are declared: files may be longer.
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

  const container::Container& container_;
  const std::string& name_;
  const container::Resolver& resolver_;
  const ToTinygltfOptions& options_;
  TinygltfReport report_;
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
    const auto opened = container::open_file(path);
    if (!opened) return failed(path, opened.error().message);
    const fs::path folder = fs::path(path).parent_path();
    const container::Resolver resolver(options.root.empty() ? folder : fs::path(options.root),
                                       folder);
    return Conversion(*opened, path, resolver, options).run(model);
  });
}

TinygltfReport to_tinygltf(const MemoryAsset& asset, tinygltf::Model& model,
                           const ToTinygltfOptions& options) {
  return guarded(asset.name, [&] {
    const container::Container opened =
        container::open_bytes(container::Bytes::from_string(asset.bytes), asset.name);
    container::Resolver resolver;
    if (!options.root.empty()) resolver = container::Resolver(options.root, options.root);
    for (const auto& [path, bytes] : asset.files) {
      resolver.add(path, container::Bytes::from_string(bytes));
    }
    return Conversion(opened, asset.name, resolver, options).run(model);
  });
}

}  // namespace gltfx
