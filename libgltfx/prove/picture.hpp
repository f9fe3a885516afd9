// SPDX-License-Identifier: Apache-2.0
/// How far apart two pictures are.
///
/// There are two kinds of question, and so of measures. Whether a change is seen at all, of small
/// pictures with noise: means over squares, in which noise averages out, against the noise that
/// other seeds show (PictureProof). How much two pictures differ, of any two files: PSNR and SSIM,
/// which other programs print, too, but for which no bound follows from the noise.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "preview/picture.hpp"
#include "render/framebuffer.hpp"

namespace gltfx::prove {

/// Pictures of one asset, to tell whether another one looks the same.
class PictureProof {
 public:
  /// `drawn` and `again` show one view and differ in nothing but the seed. Both sides are multiples
  /// of 8 pixels; bytes, of at least three channels.
  void add(preview::Picture drawn, const preview::Picture& again);
  std::size_t size() const { return pictures_.size(); }
  /// How pictures of the same views, with the seed of `drawn`, differ beyond the noise, a sentence
  /// without stop; empty: they do not. Precondition: as many as were added.
  std::string find_difference(const std::vector<preview::Picture>& now) const;

 private:
  std::vector<preview::Picture> pictures_;
  double noise_ = 0;  ///< the greatest difference of two seeds
};

/// The greatest difference between means over squares of 8 by 8 pixels, in steps of 255.
double square_difference(const preview::Picture& a, const preview::Picture& b);

/// The mean square of the difference of bytes, over pixels in which either buffer shows something.
/// Precondition: pictures and buffers of one size and number of channels; the buffers have alpha.
double mean_square_difference(const preview::Picture& a, const preview::Picture& b,
                              const render::Framebuffer& buffer_a,
                              const render::Framebuffer& buffer_b);

/// The mean structural similarity of the same pixels, at most 1, which the same pictures have: of
/// luma, in Gaussian windows of 11 by 11 pixels that end with the picture (Z. Wang, A. Bovik,
/// H. Sheikh and E. Simoncelli, Image Quality Assessment: From Error Visibility to Structural
/// Similarity, IEEE Transactions on Image Processing 13, 2004). 1 where neither shows anything.
/// Precondition: as above.
double structural_similarity(const preview::Picture& a, const preview::Picture& b,
                             const render::Framebuffer& buffer_a,
                             const render::Framebuffer& buffer_b);

/// The difference by pixel: grey, plus four times the difference.
preview::Picture difference(const preview::Picture& a, const preview::Picture& b);

}  // namespace gltfx::prove
