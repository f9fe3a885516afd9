// SPDX-License-Identifier: Apache-2.0
#include "base/equal_records.hpp"

#include <algorithm>
#include <utility>

#include "base/hash.hpp"

namespace gltfx {
namespace {

using Hashed = std::pair<std::uint64_t, std::uint32_t>;  // hash, record

class Records {
 public:
  Records(std::string_view bytes, std::size_t size) : bytes_(bytes), size_(size) {}

  std::string_view of(std::uint32_t record) const { return bytes_.substr(record * size_, size_); }

  // Sorts records of one hash so that equal ones are adjacent, in the order of their numbers.
  void order_by_bytes(Hashed* begin, Hashed* end) const {
    const bool same = std::all_of(
        begin, end, [&](const Hashed& each) { return of(each.second) == of(begin->second); });
    if (same) return;
    std::stable_sort(begin, end,
                     [&](const Hashed& a, const Hashed& b) { return of(a.second) < of(b.second); });
  }

 private:
  std::string_view bytes_;
  std::size_t size_;
};

}  // namespace

std::vector<std::uint32_t> first_equal_records(std::string_view bytes, std::size_t size) {
  const Records records(bytes, size);
  const auto count = static_cast<std::uint32_t>(bytes.size() / size);
  std::vector<Hashed> sorted;
  sorted.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) sorted.emplace_back(hash_bytes(records.of(i)).low, i);
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> first(count);
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    while (end < count && sorted[end].first == sorted[begin].first) ++end;
    if (end - begin > 1) records.order_by_bytes(sorted.data() + begin, sorted.data() + end);
    for (std::size_t i = begin; i < end; ++i) {
      const bool again =
          i > begin && records.of(sorted[i - 1].second) == records.of(sorted[i].second);
      first[sorted[i].second] = again ? first[sorted[i - 1].second] : sorted[i].second;
    }
  }
  return first;
}

}  // namespace gltfx
