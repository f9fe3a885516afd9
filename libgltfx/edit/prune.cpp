// SPDX-License-Identifier: Apache-2.0
#include "edit/prune.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "base/text.hpp"
#include "edit/name_list.hpp"
#include "edit/pointers.hpp"
#include "edit/removal.hpp"
#include "json/writer.hpp"

namespace gltfx::edit {
namespace {

using Indices = std::set<std::uint64_t>;

/// Positions below an index that are taken out, counted once for all.
class Shift {
 public:
  explicit Shift(const Indices& gone) : gone_(gone.begin(), gone.end()) {}
  std::uint64_t of(std::uint64_t index) const {
    const auto at = std::lower_bound(gone_.begin(), gone_.end(), index);
    return index - static_cast<std::uint64_t>(at - gone_.begin());
  }

 private:
  std::vector<std::uint64_t> gone_;
};

// Names by which people note down indices of their own.
bool sounds_like_an_index(std::string_view name) {
  std::string lower(name);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* word : {"texture", "image", "bufferview"}) {
    if (lower.find(word) != std::string::npos) return true;
  }
  return false;
}

// A member of some extras with such a name and a number; empty: none.
std::string index_in_extras(const json::Document& document) {
  const json::KeyId extras = document.key_id("extras");
  if (extras == json::kNoKey) return {};
  json::NodeId end = 0;  // of the extras that are being looked at
  for (json::NodeId id = 0; id < document.node_count(); ++id) {
    const json::Node& node = document.node(id);
    if (node.kind != json::Kind::key) continue;
    if (node.next == extras) end = std::max(end, document.next(id + 1));
    if (id >= end || !document.is_number(id + 1)) continue;
    if (sounds_like_an_index(document.key(node.next))) return document.pointer_of(id + 1);
  }
  return {};
}

class Pruner {
 public:
  Pruner(const json::Document& document, const References& references, const Orphans& orphans)
      : document_(document), references_(references), orphans_(orphans), editor_(document) {}

  Result<Pruned> run(std::optional<std::uint64_t> bin_size) {
    if (const std::string obstacle = find_obstacle(); !obstacle.empty()) return Error{obstacle};
    if (bin_size) cut_bytes(*bin_size);
    for (const auto& [array, gone] : orphans_) {
      if (gone.empty()) continue;
      remove(array, gone);
      const Shift shift(gone);
      for (const Reference& reference : references_.to(array)) move(reference, shift);
      move_pointers(array, shift);
    }
    remove_names();
    pruned_.edits = editor_.take();
    return std::move(pruned_);
  }

 private:
  std::string find_obstacle() {
    if (!references_.unknown_extension().empty()) {
      return fmt::format("{} is unknown and may contain indices",
                         gltfx::quoted(references_.unknown_extension()));
    }
    const std::string extras = index_in_extras(document_);
    if (!extras.empty()) return fmt::format("{} may be an index", printable(extras));
    for (const PointerUse& use : pointers_.all()) {
      const auto gone = orphans_.find(use.steps[0]);
      if (gone == orphans_.end() || gone->second.empty() || !Pointers::is_template(use)) continue;
      return "the target of a pointer is set at run time";
    }
    return {};
  }

  json::NodeId list(const std::string& array) const {
    return document_.find(document_.root(), array);
  }

  void remove(const std::string& array, const Indices& gone) {
    const json::NodeId nodes = list(array);
    std::vector<json::NodeId> elements;
    std::uint64_t index = 0;
    for (const json::NodeId element : document_.elements(nodes)) {
      if (gone.count(index++) != 0) elements.push_back(element);
    }
    removed_.insert(removed_.end(), elements.begin(), elements.end());
    if (gone.size() == document_.array_size(nodes)) {
      return editor_.remove(document_.root(), nodes - 1);
    }
    for (const json::NodeId element : elements) editor_.remove(nodes, element);
  }

  void remove_names() {
    const auto names = extensions_taken_out(document_, removed_);
    std::set<std::string> gone;
    for (const char* member : {"extensionsUsed", "extensionsRequired"}) {
      NameList list(document_, member);
      gone.merge(list.remove_all(names));
      list.apply(editor_);
    }
    pruned_.names.assign(gone.begin(), gone.end());
  }

  void move(const Reference& reference, const Shift& shift) {
    const std::uint64_t now = shift.of(reference.index);
    if (now != reference.index) editor_.replace_text(reference.span, std::to_string(now));
  }

  void move_pointers(const std::string& array, const Shift& shift) {
    for (const PointerUse& use : pointers_.all()) {
      if (use.steps[0] != array) continue;
      std::uint64_t index = 0;
      const std::string& step = use.steps[1];
      const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
      if (error != std::errc() || end != step.data() + step.size()) continue;
      std::string pointer;
      for (std::size_t i = 0; i < use.steps.size(); ++i) {
        append_pointer_step(pointer, i == 1 ? std::to_string(shift.of(index)) : use.steps[i]);
      }
      std::string json;
      json::append_string(json, pointer);
      editor_.replace_scalar(use.node, std::move(json));
    }
  }

  /// A buffer view in buffer 0.
  struct View {
    json::NodeId node;
    ByteRange bytes;
    bool gone;
  };

  std::optional<std::uint64_t> number(json::NodeId object, std::string_view member) const {
    const json::NodeId value = document_.find(object, member);
    return value == json::kNoNode ? std::nullopt : document_.unsigned_integer(value);
  }

  std::vector<json::NodeId> buffers_of_document() const {
    std::vector<json::NodeId> buffers;
    const json::NodeId nodes = list("buffers");
    if (nodes == json::kNoNode || document_.kind(nodes) != json::Kind::array) return buffers;
    for (const json::NodeId buffer : document_.elements(nodes)) buffers.push_back(buffer);
    return buffers;
  }

  // Nothing where something beside plain buffer views refers to the buffer.
  std::optional<std::vector<View>> views_of_bin() const {
    const auto found = orphans_.find("bufferViews");
    if (found == orphans_.end() || found->second.empty()) return std::nullopt;
    const json::NodeId list_of_views = list("bufferViews");
    if (document_.kind(list_of_views) != json::Kind::array) return std::nullopt;
    const std::vector<json::NodeId> buffers = buffers_of_document();
    std::vector<View> views;
    std::uint64_t index = 0, references = 0;
    for (const json::NodeId view : document_.elements(list_of_views)) {
      const bool gone = found->second.count(index++) != 0;
      const auto buffer = number(view, "buffer");
      const std::uint64_t length = number(view, "byteLength").value_or(0);
      if (!buffer || *buffer >= buffers.size() || length == 0) return std::nullopt;
      if (!document_.is_object(buffers[*buffer])) return std::nullopt;
      if (document_.find(view, "extensions") != json::kNoNode) return std::nullopt;
      references += *buffer == 0 ? 1U : 0U;
      const std::uint64_t begin = number(view, "byteOffset").value_or(0);
      if (*buffer == 0) views.push_back({view, {begin, begin + length}, gone});
    }
    const auto& to_buffers = references_.to("buffers");
    const auto to_bin = std::count_if(to_buffers.begin(), to_buffers.end(),
                                      [](const Reference& each) { return each.index == 0; });
    if (static_cast<std::uint64_t>(to_bin) != references) return std::nullopt;
    std::stable_sort(views.begin(), views.end(),
                     [](const View& a, const View& b) { return a.bytes.begin < b.bytes.begin; });
    return views;
  }

  // Where the next view that stays begins, by view.
  static std::vector<std::uint64_t> next_begins(const std::vector<View>& views) {
    std::vector<std::uint64_t> begins(views.size());
    std::uint64_t next = UINT64_MAX;
    for (std::size_t i = views.size(); i > 0; --i) {
      begins[i - 1] = next;
      if (!views[i - 1].gone) next = views[i - 1].bytes.begin;
    }
    return begins;
  }

  // Whole words of what only views that go lie in, with the bytes that filled them up.
  void cut_bytes(std::uint64_t bin_size) {
    const auto views = views_of_bin();
    if (!views) return;
    const std::vector<std::uint64_t> next = next_begins(*views);
    std::uint64_t kept = 0;  // end of all views so far that stay, and of what was cut
    for (std::size_t i = 0; i < views->size(); ++i) {
      const View& view = (*views)[i];
      std::uint64_t end = view.bytes.end;
      if (view.gone) {
        const std::uint64_t begin = std::max(view.bytes.begin, kept);
        end = std::min({(end + 3) / 4 * 4, next[i], bin_size});
        if (end < begin + 4) continue;
        end = begin + (end - begin) / 4 * 4;
        pruned_.cut.push_back({begin, end});
      }
      kept = std::max(kept, end);
    }
    shorten_buffer();
    if (!pruned_.cut.empty()) move_views(*views);
  }

  // A buffer keeps at least a byte: else nothing is cut.
  void shorten_buffer() {
    const json::NodeId buffer = buffers_of_document().front();
    const std::uint64_t old = number(buffer, "byteLength").value_or(0);
    std::uint64_t left = old;
    for (const ByteRange& range : pruned_.cut) {
      left -= std::min(range.end, old) - std::min(range.begin, old);
    }
    if (left == 0) pruned_.cut.clear();
    if (left == 0 || left == old) return;
    editor_.replace_scalar(document_.find(buffer, "byteLength"), std::to_string(left));
  }

  void move_views(const std::vector<View>& views) {
    std::uint64_t gone = 0;
    auto cut = pruned_.cut.begin();
    for (const View& view : views) {
      for (; cut != pruned_.cut.end() && cut->end <= view.bytes.begin; ++cut) {
        gone += cut->end - cut->begin;
      }
      if (view.gone || gone == 0) continue;
      editor_.replace_scalar(document_.find(view.node, "byteOffset"),
                             std::to_string(view.bytes.begin - gone));
    }
  }

  const json::Document& document_;
  const References& references_;
  const Orphans& orphans_;
  const Pointers pointers_{document_};
  json::Editor editor_;
  std::vector<json::NodeId> removed_;
  Pruned pruned_;
};

}  // namespace

Result<Pruned> prune(const json::Document& document, const References& references,
                     const Orphans& orphans, std::optional<std::uint64_t> bin_size) {
  return Pruner(document, references, orphans).run(bin_size);
}

}  // namespace gltfx::edit
