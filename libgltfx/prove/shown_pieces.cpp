// SPDX-License-Identifier: Apache-2.0
#include "prove/shown_pieces.hpp"

#include "prove/flat_normals.hpp"
#include "prove/hash_sum.hpp"

namespace gltfx::prove {
namespace {

const std::vector<double> kNoJoints;

Hash128 sum_of(const std::vector<ShownPiece*>& pieces) {
  Hash128 all;
  for (const ShownPiece* piece : pieces) {
    if (piece->sum != Hash128{}) add_to_sum(all, piece->sum);
  }
  return all;
}

}  // namespace

bool ShownGroup::equal() const { return sum_of(ours) == sum_of(theirs); }

Soup soup_of(const SurfacePiece& piece, bool with_normals) {
  Soup soup = read_soup(piece.content->side(), piece.primitive,
                        piece.joints != nullptr ? *piece.joints : kNoJoints);
  if (with_normals && soup.find(model::SemanticKind::normal) == nullptr) add_flat_normals(soup);
  place_soup(soup, piece.place, piece.turn.value_or(piece.place));
  return soup;
}

ShownPiece show_piece(const SurfacePiece& piece) {
  ShownPiece shown;
  shown.piece = &piece;
  const bool in_place = piece.place == model::Affine{};
  if (in_place && piece.joints == nullptr && piece.known != nullptr) {
    shown.sum = piece.known->sum;
    shown.readable = piece.known->readable;
    return shown;
  }
  const Soup soup = soup_of(piece);
  shown.sum = hash_soup(soup);
  shown.readable = soup.readable;
  return shown;
}

}  // namespace gltfx::prove
