// SPDX-License-Identifier: Apache-2.0
#include "rules/suppressions.hpp"

#include <algorithm>
#include <deque>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/suggestion.hpp"
#include "base/text.hpp"
#include "rules/collector.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kOwn = "gltfx";

/// Walks all values of a document and calls back at each `extras.gltfx`, with the pointer of the
/// object that has the extras.
class Walk {
 public:
  explicit Walk(const json::Document& document) : document_(document) {}

  template <class Visit>
  void run(const Visit& visit) {
    const json::KeyId own = document_.key_id(kOwn);
    extras_ = document_.key_id("extras");
    if (own == json::kNoKey || extras_ == json::kNoKey) return;
    for (json::NodeId id = 0; id < document_.node_count(); ++id) {
      while (!frames_.empty() && id >= frames_.back().end) frames_.pop_back();
      const json::Node& node = document_.node(id);
      if (node.kind == json::Kind::key) {
        if (node.next == own && in_extras()) visit(id + 1, host());
        continue;
      }
      enter(id);
    }
  }

 private:
  struct Frame {
    json::NodeId end;
    json::NodeId key;     ///< kNoNode: an element, or the root
    std::uint64_t index;  ///< of an element
    std::uint64_t next = 0;
    bool array = false;
  };

  void enter(json::NodeId id) {
    Frame frame{document_.next(id), json::kNoNode, 0};
    if (!frames_.empty()) {
      Frame& above = frames_.back();
      if (above.array) {
        frame.index = above.next++;
      } else {
        frame.key = id - 1;
      }
    }
    frame.array = document_.kind(id) == json::Kind::array;
    if (frame.array || document_.is_object(id)) frames_.push_back(frame);
  }

  bool in_extras() const {
    if (frames_.size() < 2 || frames_.back().key == json::kNoNode) return false;
    return document_.node(frames_.back().key).next == extras_;
  }

  // Pointer of the object around the extras.
  std::string host() const {
    std::string pointer;
    for (std::size_t i = 1; i + 1 < frames_.size(); ++i) {
      const Frame& frame = frames_[i];
      if (frame.key == json::kNoNode) {
        append_pointer_step(pointer, std::to_string(frame.index));
      } else {
        append_pointer_step(pointer, document_.string(frame.key));
      }
    }
    return pointer;
  }

  const json::Document& document_;
  json::KeyId extras_ = json::kNoKey;
  std::vector<Frame> frames_;
};

// Calls `use` with the path of a pointer.
template <class Use>
void with_path(std::string_view pointer, const Use& use) {
  const auto steps = split_pointer(pointer);
  std::deque<Path> path(1);
  if (steps) {
    for (const std::string& step : *steps) {
      const bool index = step.find_first_not_of("0123456789") == std::string::npos &&
                         !step.empty() && step.size() < 10;
      if (index) {
        path.emplace_back(path.back(), std::uint64_t{std::stoull(step)});
      } else {
        path.emplace_back(path.back(), std::string_view(step));
      }
    }
    use(path.back());
  }
}

std::string nearest_code(std::string_view word, const OwnRules* own) {
  std::vector<std::string_view> codes;
  for (const RuleDescription& rule : rules(own)) codes.push_back(rule.code);
  return did_you_mean(word, codes);
}

// Whether a rule only runs with pixels or limits, and so may have no finding in other runs.
bool may_be_silent(Code code, const ValidateOptions& options) {
  const RuleDescription& rule = description(options, code);
  if (rule.code.starts_with("BUDGET_")) return true;
  return rule.pixels && pixel_level(options) == PixelLevel::headers;
}

}  // namespace

std::uint64_t Suppressions::Entry::total() const {
  return std::accumulate(hits.begin(), hits.end(), std::uint64_t{0});
}

Suppressions::Suppressions(const json::Document& document, const OwnRules* own)
    : document_(&document), own_(own) {
  Walk(document).run([this](json::NodeId wish, const std::string& host) { read(wish, host); });
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].code) by_code_[*entries_[i].code].emplace(entries_[i].host, i);
  }
}

void Suppressions::read(json::NodeId wish, const std::string& host) {
  const std::string own = host + "/extras/gltfx";
  const json::NodeId list = document_->find(wish, "ignore");
  if (list == json::kNoNode || document_->kind(list) != json::Kind::array) {
    Entry entry{host, own, wish, {}, {}};
    entry.problem = "'gltfx' has no array 'ignore'";
    entries_.push_back(std::move(entry));
    return;
  }
  std::uint64_t index = 0;
  for (const json::NodeId item : document_->elements(list)) {
    read_entry(item, host, fmt::format("{}/ignore/{}", own, index++));
  }
}

void Suppressions::read_entry(json::NodeId item, const std::string& host, std::string place) {
  Entry entry{host, std::move(place), item, {}, {}};
  const json::NodeId code = document_->find(item, "code");
  const json::NodeId reason = document_->find(item, "reason");
  entry.has_reason =
      reason != json::kNoNode && document_->is_string(reason) && !document_->string(reason).empty();
  if (code == json::kNoNode || !document_->is_string(code)) {
    entry.problem = "the entry has no string 'code'";
  } else if (const auto known = code_of(document_->string(code), own_)) {
    entry.code = known;
  } else {
    const std::string word = document_->string(code);
    entry.problem = fmt::format("unknown rule {}{}", gltfx::quoted(word), nearest_code(word, own_));
  }
  entries_.push_back(std::move(entry));
}

bool Suppressions::covers(Code code, const Path& path, std::size_t phase, std::uint64_t count) {
  const auto places = by_code_.find(code);
  if (places == by_code_.end()) return false;
  std::string pointer = path.pointer();
  while (true) {
    if (const auto found = places->second.find(pointer); found != places->second.end()) {
      entries_[found->second].hits[phase] += count;
      return true;
    }
    if (pointer.empty()) return false;
    pointer.erase(pointer.rfind('/'));
  }
}

std::uint64_t Suppressions::total() const {
  std::uint64_t sum = 0;
  for (const Entry& entry : entries_) sum += entry.total();
  return sum;
}

void Suppressions::report(const ValidateOptions& options, Sink& sink) const {
  for (const Entry& entry : entries_) report_entry(entry, options, sink);
}

void Suppressions::report_entry(const Entry& entry, const ValidateOptions& options,
                                Sink& sink) const {
  const auto say = [&](Code code, std::string message, std::string help) {
    with_path(entry.place, [&](const Path& path) {
      sink.report(
          path,
          {code, std::move(message), std::move(help), first_character(*document_, entry.node), {}});
    });
  };
  if (!entry.problem.empty()) {
    return say(Code::SUPPRESSION_INVALID,
               fmt::format("The suppression has no effect: {}{}", entry.problem,
                           entry.problem.back() == '?' ? "" : "."),
               R"(write {"ignore": [{"code": "UNUSED_OBJECT", "reason": "..."}]})");
  }
  if (!entry.has_reason) {
    say(Code::SUPPRESSION_WITHOUT_REASON,
        fmt::format("The suppression of {} has no reason.", description(options, *entry.code).code),
        "add a 'reason'");
  }
  if (entry.total() == 0 && is_enabled(options, *entry.code) &&
      !may_be_silent(*entry.code, options)) {
    say(Code::SUPPRESSION_UNUSED,
        fmt::format("The suppression of {} has no effect: there is no such finding here.",
                    description(options, *entry.code).code),
        "remove the suppression");
  }
}

}  // namespace gltfx::validate
