// SPDX-License-Identifier: Apache-2.0
// Values that break one rule of a shape.
#include <cmath>

#include "schema/case_values.hpp"

namespace gltfx::test {
namespace {

using schema::kNone;
using schema::Shape;
using schema::ShapeId;

class BadValues {
 public:
  BadValues(const schema::Set& set, ShapeId id, const Json& good)
      : set_(set), maker_(set), id_(id), shape_(set.shape(id)), good_(good) {}

  std::vector<BadValue> run() {
    types();
    if (good_.is_number()) numbers();
    if (good_.is_string()) strings();
    const bool is_open = shape_.open_since != schema::Version();
    if (!shape_.literals.empty() && !is_open) literals();
    if (good_.is_array()) arrays();
    if (good_.is_object() && shape_.type == kNone) maps();
    return std::move(bad_);
  }

 private:
  void add(std::string how, Json value) { bad_.push_back({std::move(how), std::move(value)}); }

  void types() {
    if (shape_.types == 0 && shape_.any_of.empty() && shape_.one_of.empty() &&
        shape_.literals.empty())
      return;
    for (const Json& other : {Json("wrong"), Json(7), Json(true), Json::object({{"a", "b"}}),
                              Json::array({Json::array()})}) {
      if (other.type() == good_.type() || (other.is_number() && good_.is_number())) continue;
      if (maker_.holds(id_, other)) continue;
      add("wrong type " + other.dump(), other);
    }
    if (!maker_.holds(id_, nullptr)) add("null", nullptr);
    if ((shape_.types & schema::kInteger) != 0) add("a fraction", 0.5);
  }

  void numbers() {
    if (std::isfinite(shape_.minimum)) {
      add("below", shape_.minimum - 1);
      if (shape_.exclusive_minimum) add("on the lower limit", whole(shape_.minimum));
    }
    if (std::isfinite(shape_.maximum)) {
      add("above", whole(shape_.maximum + 1));
      if (shape_.exclusive_maximum) add("on the upper limit", whole(shape_.maximum));
    }
    if (shape_.multiple_of != 0)
      add("no multiple", whole(good_.get<double>() + shape_.multiple_of / 2));
    if (shape_.ref) {
      add("dangling", 9999);
      add("negative", std::isfinite(shape_.minimum) ? whole(shape_.minimum - 1) : Json(-1));
    }
  }

  static Json whole(double value) {
    return value == std::floor(value) ? Json(static_cast<std::int64_t>(value)) : Json(value);
  }

  void strings() {
    if (shape_.min_length > 0) add("too short", "");
    if (shape_.max_length != UINT64_MAX) add("too long", std::string(shape_.max_length + 1, 'a'));
    if (shape_.ref_name) add("unknown name", "nobody");
    if (shape_.format == "json-pointer") add("no pointer", "nodes/0");
    if (shape_.pattern == kNone) return;
    for (const char* text : {"", " ", "a b", "***"}) {
      if (!set_.matches(shape_.pattern, text)) return add("no match", text);
    }
  }

  void literals() {
    if (good_.is_string()) add("unlisted", "noSuchValue");
    if (good_.is_number()) add("unlisted", 987654);
  }

  void arrays() {
    if (shape_.min_items > 0) add("empty", Json::array());
    if (shape_.min_items > 1) {
      Json shorter = good_;
      shorter.erase(shorter.size() - 1);
      add("too short", shorter);
    }
    if (shape_.max_items < 1000) {
      Json longer = good_;
      while (longer.size() <= shape_.max_items) longer.push_back(longer.back());
      add("too long", longer);
    }
    if (shape_.unique_items && !good_.empty()) {
      Json twice = good_;
      twice.push_back(twice.front());
      add("twice the same", twice);
    }
    items();
  }

  // Each way an element can be wrong; objects inside have cases of their own.
  void items() {
    if (shape_.items == kNone || good_.empty()) return;
    for (const BadValue& item : bad_values(set_, shape_.items, good_.front())) {
      Json array = good_;
      array.front() = item.value;
      add("item: " + item.how, array);
    }
  }

  void maps() {
    if (shape_.min_properties > 0) add("empty", Json::object());
    if (shape_.values == kNone || good_.empty()) return;
    for (const BadValue& item : bad_values(set_, shape_.values, good_.front())) {
      Json map = good_;
      map.front() = item.value;
      add("member: " + item.how, map);
    }
    if (shape_.property_names == kNone) return;
    for (const char* name : {"a name nobody chose", "event"}) {
      if (maker_.holds(shape_.property_names, name)) continue;
      Json map = good_;
      map[name] = good_.front();
      return add("name", map);
    }
  }

  const schema::Set& set_;
  ValueMaker maker_;
  ShapeId id_;
  const Shape& shape_;
  const Json& good_;
  std::vector<BadValue> bad_;
};

}  // namespace

std::vector<BadValue> bad_values(const schema::Set& set, ShapeId shape, const Json& good) {
  if (shape == kNone) return {};
  return BadValues(set, shape, good).run();
}

}  // namespace gltfx::test
