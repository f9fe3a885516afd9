// SPDX-License-Identifier: Apache-2.0
#include "prove/equal_images.hpp"

#include <algorithm>
#include <vector>

#include "prove/hash_sum.hpp"
#include "prove/images.hpp"

namespace gltfx::prove {
namespace {

// What an object refers to, in the order of its leaves.
std::vector<ItemId> targets_of(const Content& content, const Item& item) {
  std::vector<ItemId> targets;
  for (std::uint32_t i = item.first; i < item.last; ++i) {
    const Leaf& leaf = content.leaves()[i];
    if (leaf.target && leaf.kind != LeafKind::aside) targets.push_back(leaf.target);
  }
  return targets;
}

// Of the values of an image other than its name and its texels.
Hash128 rest_of(const Content& content, const Item& image) {
  Hash128 sum;
  for (std::uint32_t i = image.first; i < image.last; ++i) {
    const Leaf& leaf = content.leaves()[i];
    if (leaf.kind == LeafKind::texels || leaf.kind == LeafKind::name) continue;
    add_to_sum(sum, hash_of_all(leaf.path, leaf.value));
  }
  return sum;
}

}  // namespace

bool EqualImages::are_equal(ItemId ours, ItemId theirs) {
  if (!ours || !theirs) return false;
  const std::string& list = all_.ours.lists()[ours.list].pointer;
  if (list != all_.theirs.lists()[theirs.list].pointer) return false;
  const Item& here = all_.ours.item(ours);
  const Item& there = all_.theirs.item(theirs);
  if (!all_.options.drawn && here.label != there.label) return false;
  if (list == "/images") {
    const auto [at, is_new] = known_.try_emplace({ours.index, theirs.index});
    if (is_new) {
      at->second = rest_of(all_.ours, here) == rest_of(all_.theirs, there) &&
                   have_equal_texels(ours.index, theirs.index);
    }
    return at->second;
  }
  if (list != "/textures" || here.own != there.own) return false;
  const std::vector<ItemId> one = targets_of(all_.ours, here);
  const std::vector<ItemId> other = targets_of(all_.theirs, there);
  if (one.size() != other.size()) return false;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const bool images = all_.ours.lists()[one[i].list].pointer == "/images";
    if (!images || !are_equal(one[i], other[i])) return false;
  }
  return !one.empty();
}

bool EqualImages::have_equal_texels(std::uint32_t ours, std::uint32_t theirs) const {
  const auto& here = all_.ours.side().resources().images;
  const auto& there = all_.theirs.side().resources().images;
  if (ours >= here.size() || theirs >= there.size()) return false;
  if (!here[ours].bytes || !there[theirs].bytes) return false;
  if (container::same_bytes(*here[ours].bytes, *there[theirs].bytes)) return true;
  const auto left = decode_image(all_.ours.side(), ours);
  const auto right = decode_image(all_.theirs.side(), theirs);
  const auto* one = std::get_if<codec::Image>(&left);
  const auto* other = std::get_if<codec::Image>(&right);
  if (one == nullptr || other == nullptr) return false;
  if (one->width != other->width || one->height != other->height) return false;
  if ((one->bits == 32) != (other->bits == 32)) return false;
  return !compare_texels(*one, *other);
}

}  // namespace gltfx::prove
