// SPDX-License-Identifier: Apache-2.0
// Stores elements of accessors in forms that every engine reads (glTF 2.0 section 3.6.2).
#include "model/elements.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "change/name_list.hpp"
#include "model/skin.hpp"
#include "report/wording.hpp"
#include "steps/accessor_bounds.hpp"
#include "steps/json_edits.hpp"
#include "steps/step_data.hpp"
#include "steps/storage.hpp"
#include "steps/view_pool.hpp"

namespace gltfx::steps {
namespace {

using model::ComponentType;
using model::SemanticKind;
using target::Repair;

// The feature of accessors without data.
constexpr std::string_view kZeros = "accessor.zeros";

/// The uses of one accessor, and its new form.
struct Form {
  std::uint64_t uses = 0;  ///< that are known
  model::ViewTarget target = model::ViewTarget::none;
  bool floats = false;
  bool unit = false;    ///< the first three components are a direction
  bool wide = false;    ///< indices of 16 bits
  bool plain = false;   ///< stored, not sparse, and in a view of its own
  bool packed = false;  ///< its elements may be in a bitstream
};

/// New elements of one accessor.
struct Stored {
  std::string bytes;
  std::uint64_t view = 0;  ///< number in the pool
  model::Format format;
};

class ElementStep {
 public:
  explicit ElementStep(const StepInput& input)
      : data_(input),
        plain_(input.repairs.features(Repair::plain_accessors)),
        forms_(data_.views.accessors.size()),
        editor_(data_.document),
        buffer_(input.asset),
        additions_(data_.document),
        pool_(data_, buffer_, additions_, editor_) {}

  Result<StepOutcome> run() {
    find_uses();
    for (std::uint32_t i = 0; i < forms_.size(); ++i) consider(i);
    if (stored_.empty()) return std::move(outcome_);
    free_views();
    for (auto& [index, stored] : stored_) place(index, stored);
    pool_.settle(edited_, outcome_);
    for (const auto& [index, stored] : stored_) declare(index, stored);
    drop_extensions();
    outcome_.change.edits = editor_.take();
    outcome_.change.additions = std::move(additions_);
    buffer_.add_to(outcome_.change);
    outcome_.row.what = report::counted(stored_.size(), "accessor");
    return std::move(outcome_);
  }

 private:
  bool has(Repair repair) const { return data_.input.repairs.has(repair); }
  const model::Accessor& accessor(std::uint32_t index) const {
    return data_.views.accessors[index];
  }

  void find_uses() {
    for (const model::Mesh& mesh : data_.views.meshes) {
      for (const model::Primitive& primitive : mesh.primitives) {
        if (primitive.node != json::kNoNode) find_uses(primitive);
      }
    }
    for (const model::Animation& animation : data_.views.animations) {
      for (const model::AnimationSampler& sampler : animation.samplers) {
        if (sampler.input) ++forms_[*sampler.input].uses;
        if (sampler.output) ++forms_[*sampler.output].uses;
      }
      for (const model::AnimationChannel& channel : animation.channels) {
        if (!channel.sampler || !animation.samplers[*channel.sampler].output) continue;
        Form& form = forms_[*animation.samplers[*channel.sampler].output];
        form.floats |=
            (channel.path == model::AnimationPath::rotation && has(Repair::float_rotations)) ||
            (channel.path == model::AnimationPath::weights && has(Repair::float_morph_weights));
      }
    }
    if (plain_.size() == plain_.count(kZeros)) return;
    for (std::uint32_t i = 0; i < forms_.size(); ++i) {
      if (accessor(i).node != json::kNoNode && accessor(i).sparse != json::kNoNode) {
        forms_[i].plain = true;
      }
    }
  }

  void find_uses(const model::Primitive& primitive) {
    const bool extended = data_.document.find(primitive.node, "extensions") != json::kNoNode;
    for (const model::Attribute& attribute : primitive.attributes) {
      note_attribute(attribute, false, extended);
    }
    for (const json::NodeId target : primitive.targets) {
      for (const model::Attribute& each : model::read_attributes(data_.asset, target)) {
        note_attribute(each, true, extended);
      }
    }
    if (!primitive.indices) return;
    Form& form = forms_[*primitive.indices];
    ++form.uses;
    form.target = model::ViewTarget::indices;
    form.wide |= has(Repair::wide_indices) &&
                 accessor(*primitive.indices).format.component == ComponentType::uint8;
  }

  void note_attribute(const model::Attribute& attribute, bool of_target, bool extended) {
    if (!attribute.accessor) return;
    const model::Accessor& described = accessor(*attribute.accessor);
    Form& form = forms_[*attribute.accessor];
    ++form.uses;
    form.target = model::ViewTarget::vertices;
    if (becomes_floats(attribute.semantic.kind, described.format, of_target)) {
      form.floats = true;
      const bool direction = attribute.semantic.kind == SemanticKind::normal ||
                             attribute.semantic.kind == SemanticKind::tangent;
      form.unit |= direction && !of_target;
    }
    const model::BufferView* view = data_.views.view_of(described);
    // Elements of a compressed primitive come from its extension.
    const bool nothing = view == nullptr && described.sparse == json::kNoNode;
    form.packed |= nothing && extended;
    form.plain |= nothing && !extended && plain_.contains(kZeros);
    form.plain |= view != nullptr && has(Repair::separate_views) &&
                  view->byte_stride.value_or(0) > model::element_size(described.format);
  }

  bool becomes_floats(SemanticKind kind, const model::Format& format, bool of_target) const {
    const bool core =
        !of_target && format.normalized &&
        (format.component == ComponentType::uint8 || format.component == ComponentType::uint16);
    switch (kind) {
      case SemanticKind::position:
      case SemanticKind::normal:
      case SemanticKind::tangent:
        return has(Repair::float_attributes);
      case SemanticKind::texcoord:
        return has(core ? Repair::float_texcoords : Repair::float_attributes);
      case SemanticKind::color:
        return has(Repair::float_colors);
      case SemanticKind::weights:
        return has(Repair::float_weights);
      default:
        return false;
    }
  }

  void consider(std::uint32_t index) {
    Form& form = forms_[index];
    const model::Accessor& described = accessor(index);
    form.floats = form.floats && model::is_integer(described.format.component);
    if (!form.floats && !form.wide && !form.plain) return;
    std::string why = find_obstacle(index);
    Stored stored;
    if (why.empty()) why = read(index, stored);
    if (why.empty()) {
      stored_.emplace(index, std::move(stored));
    } else {
      outcome_.row.refused.push_back({data_.pointer(described.node), std::move(why)});
    }
  }

  std::string find_obstacle(std::uint32_t index) const {
    const Form& form = forms_[index];
    const model::Accessor& described = accessor(index);
    if (data_.document.find(described.node, "extensions") != json::kNoNode) {
      return "it has an extension";
    }
    if (form.packed) return "its elements may be in a bitstream";
    const model::Format& format = described.format;
    if (!format.known() || !described.count || !model::is_core_component(format.component)) {
      return "its members cannot be read";
    }
    const std::size_t size =
        std::size_t{model::component_count(format.type)} * model::component_size(format.component);
    if (size != model::element_size(format)) return "it has matrices with padded columns";
    const bool other_type = form.floats || form.wide;
    const std::uint64_t users = data_.graph.users(described.node).size();
    if (other_type && users != form.uses) return "it is used by an extension, too";
    const bool both = form.target == model::ViewTarget::indices && form.floats;
    return both ? "it has indices, too" : std::string();
  }

  // Why there are no elements; empty: `stored` has them.
  std::string read(std::uint32_t index, Stored& stored) {
    const Form& form = forms_[index];
    const model::Accessor& described = accessor(index);
    stored.format = described.format;
    if (form.floats) stored.format = {described.format.type, ComponentType::float32, false};
    if (form.wide) stored.format.component = ComponentType::uint16;
    const std::uint64_t size = model::element_size(stored.format);
    // Zeros and most elements of sparse accessors have no bytes that limit their number.
    if (!data_.budget.take(checked_mul(*described.count, size))) {
      return "its elements would take too much memory";
    }
    stored.bytes.assign(static_cast<std::size_t>(*described.count * size), '\0');
    const auto elements = model::AccessorData::open(data_.asset, data_.views, data_.resources,
                                                    described, model::Malformed::unusable);
    if (!elements) {
      const bool zeros = !described.buffer_view && described.sparse == json::kNoNode &&
                         data_.document.find(described.node, "bufferView") == json::kNoNode;
      return zeros ? std::string() : "its data cannot be read";
    }
    if (form.floats) {
      write_floats(*elements, stored.bytes);
      if (form.unit) normalize(stored);
    } else if (form.wide) {
      write_wide(*elements, stored.bytes);
    } else {
      std::uint64_t next = 0;
      elements->read(reinterpret_cast<std::byte*>(stored.bytes.data()), 0,
                     static_cast<std::size_t>(elements->count()), next);
    }
    return {};
  }

  static void write_floats(const model::AccessorData& from, std::string& bytes) {
    const std::size_t components = from.components();
    model::for_each_component(
        from, static_cast<std::size_t>(from.count()),
        [&](std::size_t element, unsigned component, float value) {
          std::memcpy(bytes.data() + (element * components + component) * sizeof(float), &value,
                      sizeof(float));
        });
  }

  static void write_wide(const model::AccessorData& from, std::string& bytes) {
    model::for_each_component(from, static_cast<std::size_t>(from.count()),
                              [&](std::size_t element, unsigned, float value) {
                                bytes[2 * element] = static_cast<char>(value);
                              });
  }

  // Floats must have length 1, integers only about that (section 3.7.2.1).
  void normalize(Stored& stored) {
    const std::size_t stride = model::element_size(stored.format);
    for (std::size_t at = 0; at + stride <= stored.bytes.size(); at += stride) {
      std::array<float, 3> vector{};
      std::memcpy(vector.data(), stored.bytes.data() + at, sizeof(vector));
      const model::Vector3 wide{static_cast<double>(vector[0]), static_cast<double>(vector[1]),
                                static_cast<double>(vector[2])};
      const double length = std::sqrt(model::dot(wide, wide));
      if (!(length > 0)) continue;
      for (std::size_t k = 0; k < 3; ++k) vector[k] = static_cast<float>(wide[k] / length);
      std::memcpy(stored.bytes.data() + at, vector.data(), sizeof(vector));
    }
    outcome_.freedom.unit_vectors = true;
  }

  void free_views() {
    std::map<std::uint32_t, std::size_t> lost;  // uses, by view
    const auto lose = [&](const std::optional<std::uint32_t>& view, json::NodeId object) {
      if (!view) return;
      ++lost[*view];
      edited_.insert(data_.document.find(object, "bufferView"));
    };
    for (const auto& [index, stored] : stored_) {
      lose(accessor(index).buffer_view, accessor(index).node);
      const auto sparse = model::read_sparse(data_.asset, accessor(index));
      if (!sparse) continue;
      lose(sparse->indices.buffer_view, sparse->indices.node);
      lose(sparse->values.buffer_view, sparse->values.node);
    }
    for (const auto& [view, uses] : lost) {
      const json::NodeId node = data_.views.buffer_views[view].node;
      const bool extended = data_.document.find(node, "extensions") != json::kNoNode;
      if (uses == data_.graph.users(node).size() && !extended) pool_.free(view);
    }
  }

  void place(std::uint32_t index, Stored& stored) {
    const model::ViewTarget target = forms_[index].target;
    const std::size_t size = model::element_size(stored.format);
    const std::size_t stride = target == model::ViewTarget::vertices
                                   ? static_cast<std::size_t>(aligned(size, kVertexAlignment))
                                   : size;
    std::string bytes = stored.bytes;
    if (stride != size) {
      bytes.assign(stored.bytes.size() / size * stride, '\0');
      for (std::size_t i = 0; i * size < stored.bytes.size(); ++i) {
        stored.bytes.copy(bytes.data() + i * stride, size, i * size);
      }
    }
    stored.view = pool_.add(container::Bytes::from_string(std::move(bytes)),
                            stride == size ? 0 : stride, target);
  }

  void declare(std::uint32_t index, const Stored& stored) {
    const model::Accessor& described = accessor(index);
    const json::Document& document = data_.document;
    set_number(document, editor_, described.node, "bufferView", pool_.position(stored.view));
    remove_member(document, editor_, described.node, "byteOffset");
    remove_member(document, editor_, described.node, "sparse");
    if (stored.format == described.format) return;
    set_number(document, editor_, described.node, "componentType",
               static_cast<unsigned>(stored.format.component));
    remove_member(document, editor_, described.node, "normalized");
    model::Accessor other = described;
    other.format = stored.format;
    mend_bounds(document, editor_, other, stored.bytes);
  }

  // Without integers, nothing needs the extension that allows them.
  void drop_extensions() {
    if (!outcome_.row.refused.empty()) return;
    for (const char* member : {"extensionsUsed", "extensionsRequired"}) {
      change::NameList names(data_.document, member);
      for (const auto& [name, only_required] :
           data_.input.repairs.features(Repair::float_attributes)) {
        names.remove(name);
      }
      names.apply(editor_);
    }
  }

  const StepData data_;
  const std::map<std::string, bool, std::less<>> plain_;  ///< features
  std::vector<Form> forms_;                               ///< by accessor
  json::Editor editor_;
  NewBuffer buffer_;
  change::Additions additions_;
  ViewPool pool_;
  std::map<std::uint32_t, Stored> stored_;  ///< by accessor
  std::set<json::NodeId> edited_;           ///< replaced and removed indices of views
  StepOutcome outcome_;
};

}  // namespace

StepDescription elements_step();
StepDescription elements_step() {
  return {"elements",
          "stores sparse, implied, interleaved or integer elements as a target reads them",
          "all values, and indices of accessors",
          "lengths of normals and tangents other than 1",
          [](const ConvertOptions&) { return false; },
          [](const StepInput& input) { return ElementStep(input).run(); },
          {Repair::float_attributes, Repair::float_texcoords, Repair::float_colors,
           Repair::float_weights, Repair::float_rotations, Repair::float_morph_weights,
           Repair::plain_accessors, Repair::separate_views, Repair::wide_indices}};
}

}  // namespace gltfx::steps
