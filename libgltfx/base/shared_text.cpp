// SPDX-License-Identifier: Apache-2.0
#include "base/shared_text.hpp"

#include <new>
#include <utility>

#include "base/pages.hpp"

namespace gltfx {
namespace {

template <typename Owner>
struct Held {
  explicit Held(Owner taken, std::size_t size) : owner(std::move(taken)), text(get(owner), size) {}
  static const char* get(const std::string& owner) { return owner.data(); }
  template <typename Pointer>
  static const char* get(const Pointer& owner) {
    return owner.get();
  }
  Owner owner;
  std::string_view text;
};

template <typename Owner>
SharedText hold(Owner owner, std::size_t size) {
  const auto held = std::make_shared<const Held<Owner>>(std::move(owner), size);
  return {held, &held->text};
}

}  // namespace

SharedText share_text(std::string text) {
  const std::size_t size = text.size();
  return hold(std::move(text), size);
}

void TextRoom::Free::operator()(char* memory) const noexcept { free_pages(memory, bytes); }

TextRoom::TextRoom(std::size_t size) : size_(size) {
  if (size >= PTRDIFF_MAX) return;
  bytes_ = {static_cast<char*>(allocate_pages(size + 1)), Free{size + 1}};
  bytes_.get()[size] = '\0';
}

SharedText TextRoom::share() && { return hold(std::move(bytes_), size_); }

}  // namespace gltfx
