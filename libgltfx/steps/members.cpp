// SPDX-License-Identifier: Apache-2.0
// Writes members that may be absent: the media types of images (glTF 2.0 section 3.6.1.1), the
// inverse bind matrices of skins (3.7.3.1).
#include <array>
#include <cstring>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "image/header.hpp"
#include "model/asset_bytes.hpp"
#include "model/skin.hpp"
#include "report/wording.hpp"
#include "steps/json_edits.hpp"
#include "steps/new_buffer.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {
namespace {

using model::RootArray;
using target::Repair;

class MemberStep {
 public:
  explicit MemberStep(const StepInput& input)
      : input_(input),
        document_(input.asset.document()),
        elements_(document_),
        editor_(document_),
        buffer_(input.asset),
        additions_(document_) {}

  Result<StepOutcome> run() {
    if (input_.repairs.has(Repair::media_types)) name_media_types();
    if (input_.repairs.has(Repair::inverse_bind_matrices)) write_matrices();
    outcome_.freedom.new_objects = skins_ > 0;
    outcome_.change.edits = editor_.take();
    outcome_.change.additions = std::move(additions_);
    buffer_.add_to(outcome_.change);
    if (images_ > 0) add_what(fmt::format("mimeType of {}", report::counted(images_, "image")));
    if (skins_ > 0) add_what(fmt::format("matrices of {}", report::counted(skins_, "skin")));
    return std::move(outcome_);
  }

 private:
  void add_what(const std::string& text) {
    std::string& what = outcome_.row.what;
    what += what.empty() ? text : ", " + text;
  }

  void name_media_types() {
    model::AssetBytes bytes(elements_, input_.asset.container(), input_.asset.resolver());
    const auto& images = elements_.elements(RootArray::images);
    for (std::uint32_t i = 0; i < images.size(); ++i) {
      if (images[i] == json::kNoNode) continue;
      if (document_.find(images[i], "mimeType") != json::kNoNode) continue;
      if (bytes.image_storage(i) != model::Storage::file) continue;
      const auto file = bytes.image(i);
      if (!file) continue;
      const image::Sniffed sniffed = image::sniff(file->view());
      if (!sniffed.known) continue;
      editor_.append_member(images[i], "mimeType",
                            fmt::format("\"{}\"", image::media_type(sniffed.format)));
      ++images_;
    }
  }

  void write_matrices() {
    for (const json::NodeId object : elements_.elements(RootArray::skins)) {
      if (object == json::kNoNode) continue;
      const model::Skin skin = model::read_skin(elements_, object);
      if (skin.inverse_bind_matrices_value != json::kNoNode || skin.joint_count == 0) continue;
      const auto [found, is_new] = matrices_.try_emplace(skin.joint_count, 0);
      if (is_new) found->second = add_matrices(skin.joint_count);
      editor_.append_member(object, "inverseBindMatrices", std::to_string(found->second));
      ++skins_;
    }
  }

  // The default: an identity matrix for each joint.
  std::uint64_t add_matrices(std::uint64_t count) {
    constexpr std::array<float, 16> kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::string bytes(static_cast<std::size_t>(count) * sizeof(kIdentity), '\0');
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(kIdentity)) {
      std::memcpy(bytes.data() + at, kIdentity.data(), sizeof(kIdentity));
    }
    const std::size_t length = bytes.size();
    const std::uint64_t offset = buffer_.add(std::move(bytes));
    const std::uint64_t view = additions_.add_element(
        "bufferViews", view_json({buffer_.index(), offset, length, 0, model::ViewTarget::none}));
    return additions_.add_element(
        "accessors",
        fmt::format(R"({{"bufferView":{},"componentType":5126,"count":{},"type":"MAT4"}})", view,
                    count));
  }

  const StepInput& input_;
  const json::Document& document_;
  const model::Asset elements_;
  json::Editor editor_;
  NewBuffer buffer_;
  change::Additions additions_;
  std::map<std::uint64_t, std::uint64_t> matrices_;  ///< accessors, by number of joints
  StepOutcome outcome_;
  std::uint64_t images_ = 0, skins_ = 0;
};

}  // namespace

StepDescription members_step();
StepDescription members_step() {
  return {"members",
          "writes the media types of images and the matrices of skins for a target",
          "everything",
          "nothing",
          [](const ConvertOptions&) { return false; },
          [](const StepInput& input) { return MemberStep(input).run(); },
          {Repair::media_types, Repair::inverse_bind_matrices}};
}

}  // namespace gltfx::steps
