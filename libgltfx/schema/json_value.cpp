// SPDX-License-Identifier: Apache-2.0
#include "schema/json_value.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/text.hpp"
#include "json/equal.hpp"
#include "schema/value.hpp"

namespace gltfx::schema {
namespace {

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15ULL + (hash << 6U) + (hash >> 2U);
  return hash * 0xff51afd7ed558ccdULL;
}

std::uint64_t hash_of_number(double value) {
  return std::hash<double>{}(value == 0 ? 0.0 : value);  // -0 equals 0
}

// Equal values have equal hashes. Iterative over the nodes of the value: members of an object are
// added, so that their order does not count.
std::uint64_t hash_of(const json::Document& document, json::NodeId root) {
  struct Open {
    json::NodeId end;
    std::uint64_t hash;
    std::uint64_t key;
    bool object;
  };
  std::vector<Open> open;
  std::uint64_t result = 0;
  const auto finish = [&](std::uint64_t hash) {
    if (open.empty()) {
      result = hash;
    } else if (open.back().object) {
      open.back().hash += mixed(open.back().key, hash);
    } else {
      open.back().hash = mixed(open.back().hash, hash);
    }
  };
  const auto close_until = [&](json::NodeId at) {
    while (!open.empty() && open.back().end <= at) {
      const Open done = open.back();
      open.pop_back();
      finish(mixed(done.object ? 1 : 2, done.hash));
    }
  };
  std::string buffer;
  const json::NodeId end = document.next(root);
  for (json::NodeId id = root; id < end; ++id) {
    close_until(id);
    const json::Kind kind = document.kind(id);
    if (kind == json::Kind::key) {
      open.back().key = std::hash<std::string_view>{}(document.key(document.node(id).next));
    } else if (kind == json::Kind::object || kind == json::Kind::array) {
      open.push_back({document.next(id), 0, 0, kind == json::Kind::object});
    } else if (kind == json::Kind::string) {
      finish(std::hash<std::string_view>{}(document.string(id, buffer)));
    } else if (kind == json::Kind::number) {
      finish(hash_of_number(document.number(id).value));
    } else if (kind == json::Kind::number_array) {
      std::uint64_t hash = 0;
      for (json::NumberCursor at(document, id); at.valid(); at.advance()) {
        hash = mixed(hash, hash_of_number(at.number().value));
      }
      finish(mixed(2, hash));
    } else {
      finish(static_cast<std::uint64_t>(kind));
    }
  }
  close_until(end);
  return result;
}

}  // namespace

json::Kind JsonValue::kind() const {
  if (element != nullptr) return json::Kind::number;
  const json::Kind found = document->kind(node);
  return found == json::Kind::key ? json::Kind::string : found;
}

std::uint8_t JsonValue::types() const {
  const std::uint8_t bit = type_bit(kind());
  return bit == kNumber && number() == std::floor(number()) ? kNumber | kInteger : bit;
}

double JsonValue::number() const {
  return element != nullptr ? element->value : document->number(node).value;
}

std::string_view JsonValue::raw() const {
  return (element != nullptr ? element->span : document->span(node)).in(document->text());
}

bool equal_values(const JsonValue& one, const JsonValue& other) {
  if (one.kind() == json::Kind::number && other.kind() == json::Kind::number) {
    return one.number() == other.number();
  }
  if (one.element != nullptr || other.element != nullptr) return false;
  if (one.kind() == json::Kind::string && other.kind() == json::Kind::string) {
    std::string mine, theirs;  // a key is a string
    return one.document->string(one.node, mine) == other.document->string(other.node, theirs);
  }
  return json::equal_by_value(*one.document, one.node, *other.document, other.node);
}

std::optional<std::pair<std::uint64_t, std::uint64_t>> equal_elements(const JsonValue& array,
                                                                      std::uint64_t& work,
                                                                      bool& exhausted) {
  struct Hashed {
    std::uint64_t hash;
    std::uint64_t index;
    JsonValue value;
    double number;  ///< of an element without a node
  };
  std::vector<Hashed> all;
  array.all_elements([&](std::uint64_t index, const JsonValue& value) {
    const bool number = value.kind() == json::Kind::number;
    const std::uint64_t hash =
        number ? hash_of_number(value.number()) : hash_of(*value.document, value.node);
    all.push_back({hash, index, {value.document, value.node}, number ? value.number() : 0});
    return true;
  });
  std::sort(all.begin(), all.end(), [](const Hashed& a, const Hashed& b) {
    return a.hash != b.hash ? a.hash < b.hash : a.index < b.index;
  });
  const bool numbers = array.document->kind(array.node) == json::Kind::number_array;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> first;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size() && all[j].hash == all[i].hash; ++j) {
      const std::uint64_t cost = 1 + (numbers ? 0 : all[i].value.raw().size());
      exhausted = exhausted || cost > work;
      if (exhausted) return std::nullopt;
      work -= cost;
      const bool equal =
          numbers ? all[i].number == all[j].number : equal_values(all[i].value, all[j].value);
      if (!equal) continue;
      const std::pair<std::uint64_t, std::uint64_t> pair{all[i].index, all[j].index};
      if (!first || pair.second < first->second) first = pair;
      break;
    }
  }
  return first;
}

std::string shown(std::string_view raw) {
  constexpr std::size_t kLongest = 60;
  const std::string text = printable(raw.substr(0, 4 * kLongest));
  if (count_code_points(text) <= kLongest && raw.size() <= 4 * kLongest) return text;
  return text.substr(0, bytes_of_code_points(text, kLongest)) + "…";
}

}  // namespace gltfx::schema
