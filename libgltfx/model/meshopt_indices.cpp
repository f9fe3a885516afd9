// SPDX-License-Identifier: Apache-2.0
// Index streams. Triangles are encoded by previous edges and vertices, other indices by the
// difference to one of two previous ones.
#include <array>

#include "model/meshopt.hpp"

namespace gltfx::model::meshopt {
namespace {

// The bytes between the codes and the tail, with the first error: numbers after it are zeros.
class Data {
 public:
  explicit Data(std::span<const std::byte> bytes) : bytes_(bytes) {}

  unsigned byte() {
    if (at_ < bytes_.size()) return std::to_integer<unsigned>(bytes_[at_++]);
    set(DecodeError::cut);
    return 0;
  }

  // One to five bytes of seven bits each, the least significant ones first.
  std::uint32_t number() {
    std::uint32_t value = 0;
    for (unsigned shift = 0; shift < 35; shift += 7) {
      const unsigned group = byte();
      value |= (group & 0x7fU) << shift;
      if (group < 0x80U) return value;
    }
    set(DecodeError::number);
    return 0;
  }

  void set(DecodeError error) {
    if (error_ == DecodeError::none) error_ = error;
  }
  DecodeError error() const { return error_; }
  DecodeError finish() const {
    if (error_ != DecodeError::none) return error_;
    return at_ == bytes_.size() ? DecodeError::none : DecodeError::trailing;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  DecodeError error_ = DecodeError::none;
};

std::uint32_t unzigzag(std::uint32_t value) {
  return (value & 1U) != 0 ? ~(value >> 1U) : value >> 1U;
}

// Narrow indices wrap around.
void store(std::byte* to, std::uint64_t stride, std::uint32_t index) {
  for (unsigned i = 0; i < stride; ++i) to[i] = static_cast<std::byte>(index >> i * 8);
}

// The last 16 pushed values.
template <typename T>
class Recent {
 public:
  void push(T value) { values_[count_++ % values_.size()] = value; }
  /// The value pushed `back` pushes before the last one, or an error.
  T at(unsigned back, Data& data) const {
    if (back < count_) return values_[(count_ - 1 - back) % values_.size()];
    data.set(DecodeError::unwritten);
    return {};
  }

 private:
  std::array<T, 16> values_{};
  std::uint64_t count_ = 0;
};

struct Edge {
  std::uint32_t a = 0, b = 0;
};
struct Triangle {
  std::uint32_t a = 0, b = 0, c = 0;
};

class TriangleDecoder {
 public:
  TriangleDecoder(Data& data, std::span<const std::byte> table) : data_(data), table_(table) {}

  Triangle next(unsigned code) {
    const unsigned edge = code >> 4U;
    if (edge < 0xfU) return beside_edge(edges_.at(edge, data_), code & 0xfU);
    if (code < 0xfeU) return free(from_table(code & 0xfU));
    const unsigned corners = data_.byte();
    if (corners == 0) next_ = 0;
    return free({code == 0xffU, corners >> 4U, corners & 0xfU});
  }

 private:
  // The codes of the corners of a free triangle: 0 is the next new vertex, 15 a number in the data,
  // others are recent vertices.
  struct Corners {
    bool first_is_number;
    unsigned second, third;
  };

  Corners from_table(unsigned entry) const {
    const auto corners = std::to_integer<unsigned>(table_[entry]);
    return {false, corners >> 4U, corners & 0xfU};
  }

  Triangle beside_edge(const Edge& edge, unsigned how) {
    Triangle triangle{edge.a, edge.b, 0};
    if (how == 0) {
      triangle.c = next_++;
    } else if (how < 0xdU) {
      triangle.c = vertices_.at(how, data_);
    } else {
      triangle.c = last_ = how == 0xdU ? last_ - 1 : how == 0xeU ? last_ + 1 : number();
    }
    push_edges(triangle);
    if (how == 0 || how >= 0xdU) vertices_.push(triangle.c);
    return triangle;
  }

  Triangle free(const Corners& corners) {
    Triangle triangle;
    triangle.a = corners.first_is_number ? number() : next_++;
    triangle.b = corner(corners.second);
    triangle.c = corner(corners.third);
    edges_.push({triangle.b, triangle.a});
    push_edges(triangle);
    vertices_.push(triangle.a);
    if (corners.second == 0 || corners.second == 0xfU) vertices_.push(triangle.b);
    if (corners.third == 0 || corners.third == 0xfU) vertices_.push(triangle.c);
    return triangle;
  }

  std::uint32_t corner(unsigned how) {
    if (how == 0) return next_++;
    return how < 0xfU ? vertices_.at(how - 1, data_) : number();
  }

  std::uint32_t number() { return last_ += unzigzag(data_.number()); }

  void push_edges(const Triangle& triangle) {
    edges_.push({triangle.c, triangle.b});
    edges_.push({triangle.a, triangle.c});
  }

  Data& data_;
  std::span<const std::byte> table_;
  Recent<Edge> edges_;
  Recent<std::uint32_t> vertices_;
  std::uint32_t next_ = 0;
  std::uint32_t last_ = 0;
};

constexpr std::size_t kTable = 16;

bool is_sound(std::span<const std::byte> table) {
  for (const std::byte entry : table) {
    const auto value = std::to_integer<unsigned>(entry);
    if (value >> 4U == 0xfU || (value & 0xfU) == 0xfU) return false;
  }
  return table[kTable - 2] == std::byte{0} && table[kTable - 1] == std::byte{0};
}

}  // namespace

DecodeError decode_triangles(std::span<const std::byte> stream, const Layout& layout,
                             std::span<std::byte> elements) {
  const auto codes = static_cast<std::size_t>(layout.count / 3);
  const auto table = stream.last(kTable);
  if (!is_sound(table)) return DecodeError::table;
  Data data(stream.subspan(1 + codes, stream.size() - 1 - codes - kTable));
  TriangleDecoder decoder(data, table);
  std::byte* to = elements.data();
  for (const std::byte code : stream.subspan(1, codes)) {
    const Triangle triangle = decoder.next(std::to_integer<unsigned>(code));
    if (data.error() != DecodeError::none) return data.error();
    for (const std::uint32_t index : {triangle.a, triangle.b, triangle.c}) {
      store(to, layout.stride, index);
      to += layout.stride;
    }
  }
  return data.finish();
}

DecodeError decode_indices(std::span<const std::byte> stream, const Layout& layout,
                           std::span<std::byte> elements) {
  constexpr std::size_t kPadding = 4;
  Data data(stream.subspan(1, stream.size() - 1 - kPadding));
  std::array<std::uint32_t, 2> last{};
  for (std::uint64_t i = 0; i < layout.count; ++i) {
    const std::uint32_t value = data.number();
    if (data.error() != DecodeError::none) return data.error();
    std::uint32_t& index = last[value & 1U];
    index += unzigzag(value >> 1U);
    store(elements.data() + i * layout.stride, layout.stride, index);
  }
  return data.finish();
}

}  // namespace gltfx::model::meshopt
