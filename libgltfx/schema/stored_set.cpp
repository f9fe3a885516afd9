// SPDX-License-Identifier: Apache-2.0
#include "schema/stored_set.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

#include "schema/build.hpp"
#include "schema/stored_parts.hpp"

namespace gltfx::schema {
namespace {

constexpr std::uint64_t kMagic =
    0x6778'5363'6865'000a;  // its last digits count the format's versions

class Writer {
 public:
  explicit Writer(const TextIndex& index) : index_(&index) {}
  template <class... T>
  void operator()(T&... values) {
    (put(values), ...);
  }
  std::string bytes;

 private:
  // Small numbers take one byte, and so do all ones, which mean "none".
  void put_number(std::uint64_t value) {
    ++value;
    while (value >= 0x80) {
      bytes += static_cast<char>((value & 0x7F) | 0x80);
      value >>= 7;
    }
    bytes += static_cast<char>(value);
  }
  template <class T>
  void put(T& value) {
    if constexpr (std::is_same_v<T, double>) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool> || sizeof(T) == 1) {
      bytes += static_cast<char>(value);
    } else if constexpr (std::is_integral_v<T>) {
      put_number(value == std::numeric_limits<T>::max() ? UINT64_MAX : value);
    } else {
      exchange(*this, value);
    }
  }
  // Writes twice the size, plus one for a place.
  void put(std::string_view text) {
    const auto place = index_->find(text);
    put_number(2 * text.size() + (place ? 1 : 0));
    if (place) {
      put_number(place->text);
      put_number(place->begin);
    } else {
      bytes += text;
    }
  }
  void put(std::string& text) { put(std::string_view(text)); }
  template <class T>
  void put(std::vector<T>& list) {
    put_number(list.size());
    for (T& item : list) put(item);
  }
  template <class A, class B>
  void put(std::pair<A, B>& pair) {
    put(pair.first);
    put(pair.second);
  }
  template <class T>
  void put(std::optional<T>& maybe) {
    bytes += maybe ? '\1' : '\0';
    if (maybe) put(*maybe);
  }

  const TextIndex* index_;
};

// Relies on bytes that Writer wrote; only checks that they are complete.
class Reader {
 public:
  Reader(std::string_view bytes, Texts texts)
      : at_(bytes.data()), end_(at_ + bytes.size()), texts_(texts) {}
  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  bool is_done() const { return at_ == end_ && !short_; }
  /// The next bytes.
  std::string_view take(std::size_t size) {
    if (!has(size)) return {};
    return {std::exchange(at_, at_ + size), size};
  }

 private:
  bool has(std::size_t bytes) {
    if (static_cast<std::size_t>(end_ - at_) >= bytes) return true;
    short_ = true;
    at_ = end_;
    return false;
  }
  std::uint64_t get_number() {
    std::uint64_t value = 0;
    for (int shift = 0; has(1) && shift < 64; shift += 7) {
      const auto byte = static_cast<unsigned char>(*at_++);
      value |= std::uint64_t{byte & 0x7Fu} << shift;
      if (byte < 0x80) break;
    }
    return value - 1;
  }
  // Each counted item takes at least a byte.
  std::size_t get_count() {
    const std::uint64_t count = get_number();
    return has(count) ? static_cast<std::size_t>(count) : 0;
  }
  template <class T>
  void get(T& value) {
    if constexpr (std::is_same_v<T, double>) {
      if (!has(sizeof value)) return;
      std::memcpy(&value, at_, sizeof value);
      at_ += sizeof value;
    } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool> || sizeof(T) == 1) {
      if (has(1)) value = static_cast<T>(*at_++);
    } else if constexpr (std::is_integral_v<T>) {
      value = static_cast<T>(get_number());
    } else {
      exchange(*this, value);
    }
  }
  void get(std::string_view& text) {
    const std::uint64_t size = get_number();
    text = size % 2 == 0 ? take(size / 2) : find(size / 2);
  }
  std::string_view find(std::uint64_t size) {
    const std::uint64_t text = get_number();
    const std::uint64_t begin = get_number();
    if (text < texts_.size() && begin <= texts_[text].size() &&
        size <= texts_[text].size() - begin) {
      return texts_[text].substr(begin, size);
    }
    short_ = true;
    return {};
  }
  void get(std::string& text) {
    std::string_view bytes;
    get(bytes);
    text = bytes;
  }
  template <class T>
  void get(std::vector<T>& list) {
    list.resize(get_count());
    for (T& item : list) get(item);
  }
  template <class A, class B>
  void get(std::pair<A, B>& pair) {
    get(pair.first);
    get(pair.second);
  }
  template <class T>
  void get(std::optional<T>& maybe) {
    if (has(1) && *at_++ != 0) get(maybe.emplace());
  }

  const char* at_;
  const char* end_;
  Texts texts_;
  bool short_ = false;
};

// Alternative names of types: those of definitions with several attachment points.
using Names = std::vector<std::pair<std::string, std::uint32_t>>;

template <class Map>
Names sorted(const Map& map) {
  Names names(map.begin(), map.end());
  std::sort(names.begin(), names.end());
  return names;
}

// Parts that are read one by one: the end of each, then all of them.
template <class T>
void put_parts(Writer& writer, const TextIndex& index, std::vector<T>& parts) {
  Writer all(index);
  std::vector<std::uint32_t> ends;
  for (T& part : parts) {
    all(part);
    ends.push_back(static_cast<std::uint32_t>(all.bytes.size()));
  }
  writer(ends);
  writer.bytes += all.bytes;
}

template <class T>
std::shared_ptr<const Lazy<T>> get_parts(Reader& reader, Texts texts) {
  std::vector<std::uint32_t> ends;
  reader(ends);
  const std::string_view bytes = reader.take(ends.empty() ? 0 : ends.back());
  return std::make_shared<const Lazy<T>>(bytes, std::move(ends), texts);
}

}  // namespace

std::string write_set(const Set& set, Texts texts) {
  SetParts parts = SetWriter::open(set);
  Names types = sorted(parts.type_ids);
  Names extensions = sorted(parts.extension_ids);
  std::vector<std::string> patterns;
  for (const Pattern& pattern : parts.patterns) patterns.push_back(pattern.text());
  const TextIndex index(texts);
  Writer writer(index);
  std::uint64_t magic = kMagic;
  WalkPlans plans = set.walk_tables();
  writer(magic, parts.extensions, parts.versions, types, extensions, patterns, plans);
  put_parts(writer, index, parts.shapes);
  put_parts(writer, index, parts.types);
  return std::move(writer.bytes);
}

std::shared_ptr<const Set> read_set(std::string_view bytes, Texts texts) {
  SetParts parts;
  Names types;
  Names extensions;
  std::vector<std::string> patterns;
  std::uint64_t magic = 0;
  Reader reader(bytes, texts);
  reader(magic);
  if (magic != kMagic) return nullptr;
  WalkPlans plans;
  reader(parts.extensions, parts.versions, types, extensions, patterns, plans);
  LazyParts lazy{get_parts<Shape>(reader, texts), get_parts<ObjectType>(reader, texts)};
  if (!reader.is_done()) return nullptr;
  for (const std::string& expression : patterns) {
    auto pattern = Pattern::compile(expression);
    if (!pattern) return nullptr;
    parts.patterns.push_back(*std::move(pattern));
  }
  parts.type_ids.reserve(types.size());
  for (auto& [name, id] : types) parts.type_ids.emplace(std::move(name), id);
  for (auto& [name, id] : extensions) parts.extension_ids.emplace(std::move(name), id);
  return SetWriter::close(std::move(parts), std::move(lazy), std::move(plans));
}

void read_part(std::string_view bytes, Texts texts, Shape& shape) { Reader(bytes, texts)(shape); }

void read_part(std::string_view bytes, Texts texts, ObjectType& type) {
  Reader(bytes, texts)(type);
}

}  // namespace gltfx::schema
