// The images of a frame by name: the choices of --show and --aov, as values (EXR) and as display images (PNG).
#pragma once

#include "base/image_file.h"
#include "device/frame.h"
#include "renderer/frame.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

enum class ShowProperty : uint8_t {
    ordinary = 0,
    ownSize = 1,      ///< its size differs from the frame's
    countsSteps = 2,  ///< needs trace_screen.count_steps
    radiance = 4,     ///< its values are radiance
    countsHits = 8,   ///< needs trace_screen.count_hits
};

constexpr ShowProperty operator|(ShowProperty a, ShowProperty b) {
    return static_cast<ShowProperty>(static_cast<uint8_t>(a) | static_cast<uint8_t>(b));
}

/// The pixel at which the values of a show are computed.
struct ShownPixel {
    const ViewParams& view;      ///< of the frame, perhaps without subpixel jitter
    const ViewParams& rendered;  ///< with the frame's jitter, and the last frame's camera
    vec2 uv;                     ///< of the pixel's centre
};

struct Show {
    std::string_view name;
    std::string_view description;  ///< meaning of the values, units and range
    /// Its images on the device; read back in this order.
    std::vector<gpu::Image> (*images)(const FrameImages&);
    /// Values from the decoded images (four channels each) at one pixel, into as many as `channels`.
    void (*values)(std::span<const vec4> texels, const ShownPixel& at, float* out);
    std::vector<std::string> channels;
    /// From values to display RGB in 0..1 (already encoded). nullptr: uses the tone-mapped display image.
    vec3 (*picture)(const float* values);
    ShowProperty property = ShowProperty::ordinary;

    [[nodiscard]] bool is(ShowProperty wanted) const {
        return (static_cast<uint8_t>(property) & static_cast<uint8_t>(wanted)) != 0;
    }
};

std::span<const Show> shows();

/// Throws UsageError with the closest name.
const Show& findShow(std::string_view name);

/// Read-backs of the images of a show; fetch them after the frame is done.
struct ShowReadback {
    const Show* show = nullptr;
    std::vector<gpu::Image> images;
    std::vector<gpu::Readback> copies;
    float scale = 1.0F;     ///< of the values
    ViewParams rendered{};  ///< as the frame was rendered
};

/// Throws Error for an image that the frame's settings do not produce.
ShowReadback requestShow(gpu::Frame& f, const FrameImages& images, const Show& show);
FloatImage fetchValues(const gpu::Frame& f, const ShowReadback& readback, const ViewParams& view);
/// The same at one pixel, one value per channel. Not for shows of a size of their own.
std::vector<float> fetchValue(const gpu::Frame& f, const ShowReadback& readback, const ViewParams& view, uvec2 pixel);

/// The display image of a show other than `final`.
Bitmap makePicture(const Show& show, const FloatImage& values);
/// The tone-mapped display image as it is; alpha: with its fourth channel.
Bitmap fetchDisplay(const gpu::Frame& f, gpu::Readback readback, uvec2 size, bool alpha = false);

}  // namespace reflet
