// The images of a frame by name: what --show and --aov can ask for, as values (EXR) and as pictures (PNG).
#pragma once

#include "base/image_file.h"
#include "gpu/frame.h"
#include "render/frame.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

struct Show {
    std::string_view name;
    std::string_view description;  ///< what the values are, units and range
    /// Its images on the device; read back in this order.
    std::vector<gpu::Image> (*images)(const FrameImages&);
    /// Values from the decoded images (four channels each) at one pixel, into as many as `channels`.
    void (*values)(std::span<const vec4> texels, const ViewParams& view, float* out);
    std::vector<std::string> channels;
    /// From values to display RGB in 0..1 (already encoded). nullptr: the tone-mapped display image is the picture.
    vec3 (*picture)(const float* values);
};

std::span<const Show> shows();

/// Throws UsageError naming the nearest.
const Show& findShow(std::string_view name);

/// Whether its images have another size than the picture.
bool hasOwnSize(const Show& show);

/// Whether it needs trace_screen.count_steps.
bool countsSteps(const Show& show);

/// Read-backs of what a show needs; fetch after the frame is done.
struct ShowReadback {
    const Show* show = nullptr;
    std::vector<gpu::Image> images;
    std::vector<gpu::Readback> copies;
};

/// Throws Error for an image that the frame has not made with its settings.
ShowReadback requestShow(gpu::Frame& f, const FrameImages& images, const Show& show);
FloatImage fetchValues(const gpu::Frame& f, const ShowReadback& readback, const ViewParams& view);
/// The same at one pixel of the picture, which is not of its own size: one value a channel.
std::vector<float> fetchValue(const gpu::Frame& f, const ShowReadback& readback, const ViewParams& view, uvec2 pixel);

/// The picture of a show other than `final`.
Bitmap makePicture(const Show& show, const FloatImage& values);
/// The tone-mapped display image as it is.
Bitmap fetchDisplay(const gpu::Frame& f, gpu::Readback readback, uvec2 size);

}  // namespace reflet
