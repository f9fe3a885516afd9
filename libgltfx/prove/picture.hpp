// SPDX-License-Identifier: Apache-2.0
/// Measures the difference of two pictures.
///
/// There are three questions with different measures. Whether a change is visible, in small
/// pictures with noise: means over squares, in which noise averages out, compared with the noise
/// between other seeds (PictureProof). Where two pictures with the same random numbers differ:
/// there, an unchanged surface has no noise at all, unless the numbers went elsewhere
/// (SquareDifference). How much two pictures of any files differ: PSNR and SSIM, which other
/// programs also print, but for which the noise gives no bound.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "preview/picture.hpp"
#include "render/framebuffer.hpp"

namespace gltfx::prove {

/// Pictures of one asset, for checking that another asset looks the same.
class PictureProof {
 public:
  /// `drawn` and `again` show the same view and differ only in the seed. Both sides are multiples
  /// of 8 pixels; the pictures have bytes and at least three channels.
  void add(preview::Picture drawn, const preview::Picture& again);
  std::size_t size() const { return pictures_.size(); }
  /// How pictures of the same views, with the seed of `drawn`, differ beyond the noise, as a
  /// sentence without a full stop; empty: they do not differ. Precondition: as many pictures as
  /// were added.
  std::string find_difference(const std::vector<preview::Picture>& now) const;

 private:
  std::vector<preview::Picture> pictures_;
  double noise_ = 0;  ///< the greatest difference between two seeds
};

/// The greatest difference between means over squares of 8 by 8 pixels, in steps of 255. Pixels
/// beside the last whole square do not count.
double square_difference(const preview::Picture& a, const preview::Picture& b);

/// The square of 8 by 8 pixels in which two pictures differ most beyond their noise.
struct SquareDifference {
  double distance = 0;  ///< of the means of the square, in steps of 255
  double limit = 1;     ///< up to which it says nothing
  bool visible() const { return distance > limit; }
};

/// For pictures of one view with the same seed, whose limit is one step: rounding.
SquareDifference greatest_difference(const preview::Picture& before, const preview::Picture& after);

/// For scenes in which the order of lights and triangles decides which random number goes where.
/// `again` is `before` with another seed. Around squares whose noisy pixels are equal, the same
/// numbers were used, and the limit is one step; elsewhere three times the noise is added to it.
SquareDifference greatest_difference(const preview::Picture& before, const preview::Picture& after,
                                     const preview::Picture& again);

/// The mean square of the difference of bytes, over pixels that are covered in one of the buffers.
/// Precondition: pictures and buffers of the same size and number of channels; the buffers have
/// alpha.
double mean_square_difference(const preview::Picture& a, const preview::Picture& b,
                              const render::Framebuffer& buffer_a,
                              const render::Framebuffer& buffer_b);

/// The mean structural similarity of the same pixels, 1 for equal pictures and less for others: of
/// luma, in Gaussian windows of 11 by 11 pixels that are cut at the edges of the picture (Z. Wang,
/// A. Bovik, H. Sheikh and E. Simoncelli, Image Quality Assessment: From Error Visibility to
/// Structural Similarity, IEEE Transactions on Image Processing 13, 2004). 1 if no pixel is
/// covered. Precondition: as above.
double structural_similarity(const preview::Picture& a, const preview::Picture& b,
                             const render::Framebuffer& buffer_a,
                             const render::Framebuffer& buffer_b);

/// The difference by pixel: grey, plus four times the difference.
preview::Picture difference(const preview::Picture& a, const preview::Picture& b);

/// For people: `b` pale and without colors, what differs orange.
preview::Picture marked_difference(const preview::Picture& a, const preview::Picture& b);

}  // namespace gltfx::prove
