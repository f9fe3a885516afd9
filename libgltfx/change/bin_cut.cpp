// SPDX-License-Identifier: Apache-2.0
#include "change/bin_cut.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace gltfx::change {
namespace {

class BinCutter {
 public:
  BinCutter(const json::Document& document, const std::set<std::uint64_t>& gone_views,
            std::uint64_t references, json::Editor& editor)
      : document_(document), gone_views_(gone_views), references_(references), editor_(editor) {}

  // Whole words that only removed views use, with their padding.
  std::vector<ByteRange> run(std::uint64_t bin_size) {
    const auto views = views_of_bin();
    if (!views) return {};
    const std::vector<std::uint64_t> next = next_begins(*views);
    std::uint64_t kept = 0;  // end of all kept views and cuts so far
    for (std::size_t i = 0; i < views->size(); ++i) {
      const View& view = (*views)[i];
      std::uint64_t end = view.bytes.end;
      if (view.gone) {
        const std::uint64_t begin = std::max(view.bytes.begin, kept);
        end = std::min({(end + 3) / 4 * 4, next[i], bin_size});
        if (end < begin + 4) continue;
        end = begin + (end - begin) / 4 * 4;
        cut_.push_back({begin, end});
      }
      kept = std::max(kept, end);
    }
    shorten_buffer();
    if (!cut_.empty()) move_views(*views);
    return std::move(cut_);
  }

 private:
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

  // Nothing if anything but plain buffer views refers to the buffer.
  std::optional<std::vector<View>> views_of_bin() const {
    const json::NodeId list_of_views = list("bufferViews");
    if (list_of_views == json::kNoNode) return std::nullopt;
    if (document_.kind(list_of_views) != json::Kind::array) return std::nullopt;
    const std::vector<json::NodeId> buffers = buffers_of_document();
    std::vector<View> views;
    std::uint64_t index = 0, references = 0;
    for (const json::NodeId view : document_.elements(list_of_views)) {
      const bool gone = gone_views_.count(index++) != 0;
      const auto buffer = number(view, "buffer");
      const std::uint64_t length = number(view, "byteLength").value_or(0);
      if (!buffer || *buffer >= buffers.size() || length == 0) return std::nullopt;
      if (!document_.is_object(buffers[*buffer])) return std::nullopt;
      if (document_.find(view, "extensions") != json::kNoNode) return std::nullopt;
      references += *buffer == 0 ? 1U : 0U;
      const std::uint64_t begin = number(view, "byteOffset").value_or(0);
      if (*buffer == 0) views.push_back({view, {begin, begin + length}, gone});
    }
    if (references_ != references) return std::nullopt;
    std::stable_sort(views.begin(), views.end(),
                     [](const View& a, const View& b) { return a.bytes.begin < b.bytes.begin; });
    return views;
  }

  // Start of the next kept view, by view.
  static std::vector<std::uint64_t> next_begins(const std::vector<View>& views) {
    std::vector<std::uint64_t> begins(views.size());
    std::uint64_t next = UINT64_MAX;
    for (std::size_t i = views.size(); i > 0; --i) {
      begins[i - 1] = next;
      if (!views[i - 1].gone) next = views[i - 1].bytes.begin;
    }
    return begins;
  }

  // A buffer keeps at least a byte: otherwise nothing is cut.
  void shorten_buffer() {
    const json::NodeId buffer = buffers_of_document().front();
    const std::uint64_t old = number(buffer, "byteLength").value_or(0);
    std::uint64_t left = old;
    for (const ByteRange& range : cut_) {
      left -= std::min(range.end, old) - std::min(range.begin, old);
    }
    if (left == 0) cut_.clear();
    if (left == 0 || left == old) return;
    editor_.replace_scalar(document_.find(buffer, "byteLength"), std::to_string(left));
  }

  void move_views(const std::vector<View>& views) {
    std::uint64_t gone = 0;
    auto cut = cut_.begin();
    for (const View& view : views) {
      for (; cut != cut_.end() && cut->end <= view.bytes.begin; ++cut) {
        gone += cut->end - cut->begin;
      }
      if (view.gone || gone == 0) continue;
      editor_.replace_scalar(document_.find(view.node, "byteOffset"),
                             std::to_string(view.bytes.begin - gone));
    }
  }

  json::NodeId list(std::string_view name) const { return document_.find(document_.root(), name); }

  const json::Document& document_;
  const std::set<std::uint64_t>& gone_views_;
  const std::uint64_t references_;  // to the buffer
  json::Editor& editor_;
  std::vector<ByteRange> cut_;
};

}  // namespace

std::vector<ByteRange> cut_bin(const json::Document& document,
                               const std::set<std::uint64_t>& gone_views, std::uint64_t references,
                               std::uint64_t size, json::Editor& editor) {
  if (gone_views.empty()) return {};
  return BinCutter(document, gone_views, references, editor).run(size);
}

}  // namespace gltfx::change
