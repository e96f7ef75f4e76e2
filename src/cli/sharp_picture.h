// Sharp pictures with depth, from files, for commands that run one effect on them.
#pragma once

#include "base/image_file.h"
#include "device/frame.h"
#include "effects/tonemap/tonemap.h"
#include "effects/view.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace reflet {

struct SharpPicture {
    FloatImage radiance;
    FloatImage depth;  ///< metres along the view axis; 0: infinitely far
};

/// Adds --picture and -o.
void addSharpPictureOptions(CLI::App& command, std::string& picture, std::vector<std::string>& outputs);

/// The unnamed layer and `depth` of an EXR file. Throws UsageError for another file, and Error without these layers.
SharpPicture readSharp(const std::string& file);

/// As effects read them: RGBA32F, and reversed depth of the view, R32F.
struct SharpImages {
    gpu::Image radiance;
    gpu::Image depth;
};
SharpImages uploadSharp(gpu::Frame& f, const SharpPicture& sharp, const ViewParams& view);

/// "R" "G" "B" of the texels.
FloatImage colorImage(const std::vector<vec4>& texels, uvec2 size);

/// Writes and tells the files: EXR with the depth, PNG tone mapped.
void writeEffect(const std::vector<std::string>& files, const FloatImage& image, const SharpPicture& sharp,
                 const TonemapSettings& tonemap);

}  // namespace reflet
