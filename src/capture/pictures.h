// Writes the images of one frame that --show and --aov select, as PNG and EXR.
#pragma once

#include "base/image_camera.h"
#include "capture/show.h"
#include "device/frame.h"
#include "renderer/frame.h"
#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

bool isExr(const std::string& file);

/// Adds coverage ("Y") as the alpha of premultiplied colours.
FloatImage withAlpha(const FloatImage& colors, const FloatImage& coverage);

/// Reads back coverage: the share of each pixel that surfaces cover.
struct CoverageReadback {
    gpu::Readback copy;
    VkFormat format = VK_FORMAT_UNDEFINED;
    uvec2 size{0};

    /// "Y", 0 to 1. After the frame is done.
    [[nodiscard]] FloatImage fetch(const gpu::Frame& f) const;
};

/// None where the background is the environment, which needs no coverage.
std::optional<CoverageReadback> requestCoverage(gpu::Frame& f, const FrameImages& images);

class Pictures {
public:
    /// Throws UsageError for an unknown name, or for images that cannot be in one file.
    Pictures(const std::string& show, const std::vector<std::string>& aovs);

    /// Enables the settings that these images need: trace_screen.count_steps, composite.layers.
    void prepare(Settings& settings) const;
    /// Whether the image of that name is among them.
    [[nodiscard]] bool contains(std::string_view show) const;

    /// Records read-backs of the images of a frame; `rays`: also of those that rayStatistics needs.
    void request(gpu::Frame& f, const FrameImages& images, bool rays);

    /// Stops of automatic exposure, without the correction; none where there is none. After the frame is done.
    [[nodiscard]] std::optional<float> autoExposure(const gpu::Frame& f) const;

    /// Of the rays of each lobe: mean depth samples, and the fraction of screen-space hits. After the frame is done.
    [[nodiscard]] nlohmann::ordered_json rayStatistics(const gpu::Frame& f, const ViewParams& view) const;

    /// The content of a .png file, after the frame is done.
    [[nodiscard]] Bitmap bitmap(const gpu::Frame& f, const ViewParams& view) const;

    /// Writes a .png or .exr file after the frame is done. view: posed. Throws Error.
    void write(const std::string& file, const gpu::Frame& f, const View& view, uvec2 size) const;

private:
    [[nodiscard]] FloatImage valuesOf(const Show& show, const gpu::Frame& f, const ViewParams& view) const;
    void writeExrFile(const std::string& file, const gpu::Frame& f, const ViewParams& view,
                      const ImageCamera& camera) const;

    const Show* main_ = nullptr;
    std::vector<const Show*> aovs_;
    std::map<const Show*, ShowReadback> readbacks_;
    gpu::Readback display_;
    std::optional<CoverageReadback> coverage_;
    bool transparent_ = false;
    std::optional<gpu::Readback> exposure_;
};

}  // namespace reflet
