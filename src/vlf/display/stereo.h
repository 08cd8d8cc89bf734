#pragma once
// Pairs of pictures for two eyes.

#include "vlf/image/image.h"
#include "vlf/scene/scene.h"

#include <optional>

namespace vlf {

/// Two eyes that look in parallel, their pictures shifted so that they meet at `convergence`: what
/// lies there appears in the plane of the screen, what is nearer before it. The eyes are never
/// turned towards each other, which would put points apart vertically too.
struct EyePair {
    float separation = 0.064f;         ///< metres, >= 0
    std::optional<float> convergence;  ///< metres, > 0; none: the pictures meet at infinity
};

enum class Eye { left, right };

/// The camera of one eye; `camera` is halfway between the two. Throws InputError if a number is out
/// of range.
Camera cameraOf(Eye eye, const Camera& camera, const EyePair& eyes);

/// How many pixels further to the right the left eye sees a point `depth` metres away, in pictures
/// of `height` pixels: negative beyond the convergence distance.
float disparity(const Camera& camera, const EyePair& eyes, float depth, int height);

/// Both in one picture twice as wide. Precondition for this and the next: the sizes are equal.
Image sideBySide(const Image& left, const Image& right);

/// For glasses of red before the left eye and cyan before the right: the colours whose parts seen
/// through the filters differ least from the pictures. In and out are display-linear colours in
/// [0, 1]. [E. Dubois, A projection method to generate anaglyph stereo images, ICASSP 2001]
Image anaglyph(const Image& left, const Image& right);

}  // namespace vlf
