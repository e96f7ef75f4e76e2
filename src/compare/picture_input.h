// Reads images that are named on the command line: FILE, or FILE.exr:LAYER.
#pragma once

#include "base/image_file.h"
#include "compare/compare.h"

#include <span>
#include <string>
#include <vector>

namespace reflet {

/// An image named on the command line, not yet read.
struct PictureName {
    std::string text;  ///< as typed, for messages
    std::string file;
    std::string layer;  ///< of an EXR file; "" is the unnamed one
    ImageKind kind = ImageKind::linear;
    bool exr = false;
};

/// The kind follows from the name's ending: .exr and .hdr are linear, .png, .jpg and .jpeg display-encoded. A
/// colon splits only after .exr, and not if a file of the whole name exists. Throws UsageError for other endings and
/// for layers of formats without layers.
PictureName parsePictureName(const std::string& text);

/// The image as `compareImages` expects it: channels R, G, B if present, otherwise all but alpha (A). Layer "final" is
/// the unnamed one unless a layer has that name. 8-bit values become 0..1. Throws Error; for a missing layer it lists
/// the existing ones.
FloatImage readPicture(const PictureName& name);

/// "Y", "RGB", either with "A": 0..1.
FloatImage toFloat(const Bitmap& bitmap);

/// Per pixel whether the mean of the channels, without alpha, is above 0.5. Throws Error, also if the size differs
/// from that of `picture`.
std::vector<bool> readMask(const PictureName& name, const FloatImage& picture);

/// Per pixel whether every one of these EXR files has data there: layer `confidence` above 0 in any channel, or,
/// without that layer, `depth` above 0. Throws Error for a file that is not EXR, has neither layer or differs in size
/// from `picture`.
std::vector<bool> readHitMask(std::span<const PictureName> names, const FloatImage& picture);

}  // namespace reflet
