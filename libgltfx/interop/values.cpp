// SPDX-License-Identifier: Apache-2.0
#include "interop/values.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include <tiny_gltf.h>

#include "base/number.hpp"
#include "base/text.hpp"

namespace gltfx::interop {
namespace {

using tinygltf::Value;

// tinygltf and its users copy and destroy values by recursion.
constexpr unsigned kDeepest = 256;
constexpr std::string_view kTooDeep = "is nested too deep: null takes its place";

unsigned depth_of(const Path& path) {
  unsigned depth = 0;
  for (const Path* at = &path; at->parent() != nullptr; at = at->parent()) ++depth;
  return depth;
}

Value number(const json::Number& number, std::string_view literal) {
  const bool integer = literal.find_first_of(".eE") == std::string_view::npos;
  if (integer && std::abs(number.value) <= std::numeric_limits<int>::max() && literal != "-0") {
    return Value(static_cast<int>(number.value));
  }
  return Value(number.value);
}

class ValueReader {
 public:
  ValueReader(const json::Document& document, Notes& notes) : document_(document), notes_(notes) {}

  Value read(json::NodeId id, const Path& path, unsigned depth) {
    switch (document_.kind(id)) {
      case json::Kind::false_value:
      case json::Kind::true_value:
        return Value(document_.kind(id) == json::Kind::true_value);
      case json::Kind::number:
        return number(document_.number(id), document_.raw(id));
      case json::Kind::string:
        return Value(document_.string(id));
      case json::Kind::array:
      case json::Kind::number_array:
      case json::Kind::object:
        return container(id, path, depth);
      default:
        return {};
    }
  }

 private:
  Value container(json::NodeId id, const Path& path, unsigned depth) {
    if (depth >= kDeepest) {
      notes_.lost(path, kTooDeep);
      return {};
    }
    return document_.is_object(id) ? object(id, path, depth) : array(id, path, depth);
  }

  Value array(json::NodeId id, const Path& path, unsigned depth) {
    Value::Array values;
    if (document_.kind(id) == json::Kind::number_array) {
      for (json::NumberCursor at(document_, id); at.valid(); at.advance()) {
        values.push_back(number(at.number(), at.number().span.in(document_.text())));
      }
      return Value(std::move(values));
    }
    for (const json::NodeId element : document_.elements(id)) {
      values.push_back(read(element, Path(path, values.size()), depth + 1));
    }
    return Value(std::move(values));
  }

  Value object(json::NodeId id, const Path& path, unsigned depth) {
    Value::Object values;
    for (const auto member : document_.members(id)) {
      const std::string_view key = document_.key(member.key_id);
      values.insert_or_assign(std::string(key), read(member.value, Path(path, key), depth + 1));
    }
    return Value(std::move(values));
  }

  const json::Document& document_;
  Notes& notes_;
};

class ValueWriter {
 public:
  ValueWriter(json::Writer& writer, Notes& notes) : writer_(writer), notes_(notes) {}

  void write(const Value& value, const Path& path, unsigned depth) {
    if (value.IsBool()) {
      writer_.boolean(value.Get<bool>());
    } else if (value.IsInt()) {
      writer_.integer(value.Get<int>());
    } else if (value.IsReal()) {
      real(value.Get<double>());
    } else if (value.IsString()) {
      writer_.string(value.Get<std::string>());
    } else if (value.IsArray() || value.IsObject()) {
      container(value, path, depth);
    } else {
      if (value.IsBinary()) notes_.lost(path, "is binary: null takes its place");
      writer_.null();
    }
  }

 private:
  // Written so that it is not read as an integer.
  void real(double value) {
    const bool whole =
        std::abs(value) <= std::numeric_limits<int>::max() && value == std::trunc(value);
    if (whole) {
      writer_.raw(number_text(value) + ".0");
    } else {
      writer_.number(value);
    }
  }

  void container(const Value& value, const Path& path, unsigned depth) {
    if (depth >= kDeepest) {
      notes_.lost(path, kTooDeep);
      writer_.null();
      return;
    }
    if (value.IsArray()) {
      writer_.begin_array();
      std::uint64_t index = 0;
      for (const Value& each : value.Get<Value::Array>()) {
        write(each, Path(path, index++), depth + 1);
      }
      writer_.end_array();
      return;
    }
    writer_.begin_object();
    for (const auto& [key, each] : value.Get<Value::Object>()) {
      writer_.key(key);
      write(each, Path(path, key), depth + 1);
    }
    writer_.end_object();
  }

  json::Writer& writer_;
  Notes& notes_;
};

}  // namespace

Value read_value(const json::Document& document, json::NodeId id, const Path& path, Notes& notes) {
  return ValueReader(document, notes).read(id, path, depth_of(path));
}

void write_value(json::Writer& writer, const Value& value, const Path& path, Notes& notes) {
  ValueWriter(writer, notes).write(value, path, depth_of(path));
}

}  // namespace gltfx::interop
