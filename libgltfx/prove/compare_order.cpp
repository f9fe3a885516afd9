// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "prove/compare_values.hpp"

namespace gltfx::prove {
namespace {

// How many partners come before the partner of an object that is listed before theirs.
std::size_t count_out_of_order(const std::vector<std::uint32_t>& partners) {
  std::size_t count = 0;
  std::uint32_t greatest = 0;
  for (const std::uint32_t partner : partners) {
    count += partner < greatest ? 1U : 0U;
    greatest = std::max(greatest, partner);
  }
  return count;
}

class OrderOfLists {
 public:
  explicit OrderOfLists(const Comparison& all) : all_(all), nodes_(all.ours.list("/nodes")) {}

  void run() const {
    for (std::uint32_t list = 0; list < all_.ours.lists().size(); ++list) compare_items(list);
    all_.for_each_pair("/nodes", [this](ItemId ours, ItemId theirs) {
      compare_nodes(all_.our_nodes.children(ours.index), all_.our_pointer(ours) + "/children",
                    all_.their_nodes.children(theirs.index),
                    all_.their_pointer(theirs) + "/children");
    });
    all_.for_each_pair("/scenes", [this](ItemId ours, ItemId theirs) {
      compare_nodes(nodes_of_scene(all_.ours, ours), all_.our_pointer(ours) + "/nodes",
                    nodes_of_scene(all_.theirs, theirs), all_.their_pointer(theirs) + "/nodes");
    });
  }

 private:
  void compare_items(std::uint32_t list) const {
    std::vector<std::uint32_t> partners;
    for (std::uint32_t i = 0; i < all_.ours.lists()[list].items.size(); ++i) {
      if (const ItemId other = all_.match.theirs({list, i})) partners.push_back(other.index);
    }
    const std::string& pointer = all_.ours.lists()[list].pointer;
    tell(partners, pointer, pointer);
  }

  // Of nodes that are in both lists.
  void compare_nodes(const std::vector<std::uint32_t>& ours, const std::string& our_place,
                     const std::vector<std::uint32_t>& theirs,
                     const std::string& their_place) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> positions;  // by number, sorted
    for (std::uint32_t i = 0; i < theirs.size(); ++i) positions.emplace_back(theirs[i], i);
    std::sort(positions.begin(), positions.end());
    std::vector<std::uint32_t> partners;
    for (const std::uint32_t node : ours) {
      const ItemId other = all_.match.theirs({nodes_, node});
      const std::pair<std::uint32_t, std::uint32_t> wanted{other.index, 0};
      const auto found = std::lower_bound(positions.begin(), positions.end(), wanted);
      if (!other || found == positions.end() || found->first != other.index) continue;
      partners.push_back(found->second);
    }
    tell(partners, our_place, their_place);
  }

  void tell(const std::vector<std::uint32_t>& partners, const std::string& our_place,
            const std::string& their_place) const {
    const std::size_t count = count_out_of_order(partners);
    if (count == 0) return;
    Change change;
    change.kind = "order";
    change.old_pointer = our_place;
    change.new_pointer = their_place;
    change.what = fmt::format("{} of {} elements come in another order", count, partners.size());
    all_.log.add(std::move(change));
  }

  const Comparison& all_;
  const std::uint32_t nodes_;
};

}  // namespace

void compare_order_of_lists(const Comparison& comparison) { OrderOfLists(comparison).run(); }

}  // namespace gltfx::prove
