// SPDX-License-Identifier: Apache-2.0
#include "change/additions.hpp"

#include <utility>

namespace gltfx::change {

Additions::Additions(const json::Document& document) {
  for (const auto member : document.members(document.root())) {
    if (!document.is_array(member.value)) continue;
    counts_[std::string(document.key(member.key_id))] = document.array_size(member.value);
  }
}

std::uint64_t Additions::old_count(const std::string& array) const {
  const auto found = counts_.find(array);
  return found == counts_.end() ? 0 : found->second;
}

std::uint64_t Additions::add_image(Image image) {
  images_.push_back(std::move(image));
  return images_.back().place.value_or(old_count("images") + images_.size() - 1);
}

std::uint64_t Additions::add_accessor(Accessor accessor) {
  accessors_.push_back(std::move(accessor));
  return old_count("accessors") + accessors_.size() - 1;
}

std::uint64_t Additions::add_element(const std::string& array, std::string json) {
  std::vector<std::string>& list = elements_[array];
  list.push_back(std::move(json));
  return old_count(array) + list.size() - 1;
}

}  // namespace gltfx::change
