// SPDX-License-Identifier: Apache-2.0
#include "upgrade/accessor_values.hpp"

#include <utility>

#include "model/fields.hpp"

namespace gltfx::upgrade {

void AccessorValues::read_all() {
  views_.emplace(asset_);
  for (std::uint64_t i = 0; i < asset_.count(model::RootArray::buffers); ++i) {
    auto bytes = bytes_->buffer(i);
    const json::NodeId buffer = asset_.elements(model::RootArray::buffers)[i];
    const auto length = model::unsigned_member(asset_.document(), buffer, "byteLength");
    const bool enough = bytes && length && bytes->size() >= *length;
    resources_.buffers.push_back(enough ? std::optional(*std::move(bytes)) : std::nullopt);
  }
}

// Extensions of buffer views and accessors tell how else to read them.
bool AccessorValues::is_plain(const model::Accessor& accessor) const {
  const json::Document& document = asset_.document();
  const model::BufferView* view = views_->view_of(accessor);
  return document.find(accessor.node, "extensions") == json::kNoNode &&
         (view == nullptr || document.find(view->node, "extensions") == json::kNoNode);
}

std::optional<model::AccessorData> AccessorValues::open(std::uint64_t accessor) {
  if (bytes_ == nullptr) return std::nullopt;
  if (!views_) read_all();
  if (accessor >= views_->accessors.size()) return std::nullopt;
  const model::Accessor& described = views_->accessors[accessor];
  if (described.node == json::kNoNode || !is_plain(described)) return std::nullopt;
  auto data =
      model::AccessorData::open(asset_, *views_, resources_, described, model::Malformed::unusable);
  // Zeros that take no bytes may be any number.
  return data && data->implied() ? std::nullopt : data;
}

}  // namespace gltfx::upgrade
