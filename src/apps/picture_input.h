// Pictures from the command line: FILE, or FILE.exr:LAYER.
#pragma once

#include "base/image_file.h"
#include "compare/compare.h"

#include <span>
#include <string>
#include <vector>

namespace reflet {

/// A picture of the command line before it is read.
struct PictureName {
    std::string text;  ///< as typed, for messages
    std::string file;
    std::string layer;  ///< of an EXR file; "" is the unnamed one
    ImageKind kind = ImageKind::linear;
    bool exr = false;
};

/// The kind follows from the name's ending: .exr and .hdr are linear, .png, .jpg and .jpeg display pictures. A colon
/// splits only after .exr, and not where a file of the whole name exists. Throws UsageError for other endings and for
/// layers of files that have none.
PictureName parsePictureName(const std::string& text);

/// The picture as `compareImages` wants it: channels R, G, B where they are there, otherwise all without alpha (A).
/// Layer "final" is the unnamed one unless a layer is called so. 8-bit values become 0..1. Throws Error, for a missing
/// layer with those that are there.
FloatImage readPicture(const PictureName& name);

/// "Y", "RGB", either with "A": 0..1.
FloatImage toFloat(const Bitmap& bitmap);

/// Per pixel whether the mean of the channels, without alpha, is above 0.5. Throws Error, also for a file that is not
/// of the size of `picture`.
std::vector<bool> readMask(const PictureName& name, const FloatImage& picture);

/// Per pixel whether every one of these EXR files knows something there: layer `confidence` above 0 in any channel, or
/// where there is no such layer, `depth` above 0. Throws Error for a file that is no EXR file, has neither layer or is
/// not of the size of `picture`.
std::vector<bool> readHitMask(std::span<const PictureName> names, const FloatImage& picture);

}  // namespace reflet
