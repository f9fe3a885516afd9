// SPDX-License-Identifier: Apache-2.0
/// The parser itself; `json/parse.hpp` is what others call.
#pragma once

#include <string>
#include <vector>

#include "json/parse.hpp"
#include "json/syntax_errors.hpp"

namespace gltfx::json {

/// Reads one text, once. Every reading function takes the place where its token begins and returns
/// the place after it, or null after an error that ends the parse.
class Parser {
 public:
  Parser(SharedText text, const Limits& limits);
  Parsed run();

 private:
  /// A container that is open.
  struct Frame {
    NodeId node;
    KeyId key;           ///< of the member being read; in an array that of the array
    std::uint32_t slot;  ///< index into next_keys_ for the name that comes next
    bool is_object;
    std::uint32_t elements = 0;  ///< of an array that is not one of numbers
  };
  /// Where a name was seen last, to find repeats.
  struct Stamp {
    NodeId object = kNoNode;
    NodeId key = kNoNode;
  };

  bool read();
  const char* byte_order_mark(const char* p);
  const char* root(const char* p);
  const char* value(const char* p);
  const char* member(const char* p);
  const char* element(const char* p);
  const char* name(const char* p);
  const char* name_as_guessed(const char* p);
  const char* string(const char* p, Kind kind);
  const char* string_with_escapes(const char* quote, const char* p);
  const char* number(const char* p);
  const char* checked_number(const char* p);
  const char* literal(const char* p, std::string_view word, Kind kind);
  const char* object(const char* p);
  const char* array(const char* p);
  const char* number_array(NodeId array, const char* p);
  void expand_number_array(NodeId array, const char* end);
  void open(NodeId node, bool is_object);
  const char* close(const char* p);

  NodeId add(Kind kind, const char* begin, const char* end);
  void reserve_more(const char* p);
  KeyId intern(NodeId key);

  const char* separator(const char* p, char closing);
  bool can_follow_without_comma(const char* p) const;
  bool is_fresh() const { return nodes_.size() == frames_.back().node + std::size_t{1}; }
  const char* bad_value(const char* p);
  const char* unexpected(const char* p, Expected expected);
  const char* fail(ParseError error);
  const char* too_deep(const char* bracket);
  void warn(SyntaxError error, Span span, std::string_view detail, Span other = {});
  void end_members(NodeId object);
  void warn_if_infinite(Span number);

  std::uint32_t offset(const char* p) const { return static_cast<std::uint32_t>(p - begin_); }
  Span span(const char* from, const char* to) const { return {offset(from), offset(to)}; }
  std::string_view text() const { return *document_.text_; }

  Limits limits_;
  Document document_;
  NodeArray& nodes_;
  KeyTable& keys_;
  const char* begin_;
  const char* end_;
  std::vector<Frame> frames_;
  std::vector<KeyId> next_keys_;  ///< by Frame::slot: the last name at that place
  std::vector<Stamp> stamps_;     ///< by KeyId
  std::vector<ParseError> errors_;
  std::uint64_t unrecorded_ = 0;
};

}  // namespace gltfx::json
