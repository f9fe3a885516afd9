// SPDX-License-Identifier: Apache-2.0
#include "codec/control.hpp"

#include "codec/fields.hpp"

namespace gltfx::codec {
namespace {

constexpr std::uint32_t kControlMagic = 0x314C5847;  // "GXL1": the last character is the version

}  // namespace

std::vector<std::byte> write_control(const Control& control) {
  FieldWriter out;
  out.number(kControlMagic);
  out.name(control.kind);
  out.number(control.value);
  return out.take();
}

std::optional<Control> read_control(std::span<const std::byte> frame) {
  FieldReader in(frame);
  in.require(in.number<std::uint32_t>() == kControlMagic);
  Control control;
  control.kind = in.name(Control::Kind::ended);
  control.value = in.number<std::uint64_t>();
  return in.complete() ? std::optional(control) : std::nullopt;
}

}  // namespace gltfx::codec
