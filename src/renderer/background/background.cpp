// Records the background, and lays it under images of the reference.
#include "renderer/background/background.h"

#include "base/error.h"
#include "effects/tonemap/tone_map_image.h"
#include "lighting/picture.h"
#include "renderer/blend/blend.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr VkFormat radianceFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

// Radiance divided by the coverage, 0 where that is 0.
gpu::Image straightRadiance(gpu::PassList& f, gpu::Image premultiplied, gpu::Image coverage) {
    const gpu::Image radiance = f.image("background.straight", radianceFormat, premultiplied.size);
    f.compute("straight", "straight.comp")
        .read("premultiplied", premultiplied)
        .read("coverage", coverage)
        .write("radiance", radiance)
        .params(StraightParams{radiance.size})
        .dispatch(radiance.size);
    return radiance;
}

gpu::Image overBackground(gpu::PassList& f, gpu::Image display, gpu::Image coverage, const Background& background) {
    const gpu::Image over = f.image("background.display", VK_FORMAT_R8G8B8A8_UNORM, display.size);
    f.compute("underlay", "underlay.comp")
        .constant("transparent", background.mode == Background::Mode::transparent ? 1U : 0U)
        .read("display", display)
        .read("coverage", coverage)
        .write("displayOver", over)
        .params(UnderlayParams{background.color, over.size})
        .dispatch(over.size);
    return over;
}

}  // namespace

lighting::Light withBackground(gpu::PassList& f, const FrameBackground& background, const ViewParams& view,
                               const lighting::Light& light) {
    if (!background.environment) {
        return light;
    }
    const uvec2 size = light.depth.size;
    lighting::Light out = light;
    out.direct = f.image("background.direct", radianceFormat, size);
    out.lit = f.image("background.lit", radianceFormat, size);
    const gpu::Image covered = f.image("background.coverage", radianceFormat, size);
    gpu::ComputePass pass = f.compute("background", "background.comp");
    bindEnvironment(pass, *background.environment);
    pass.read("depth", light.depth)
        .read("direct", light.direct)
        .read("lit", light.lit)
        .write("directOver", out.direct)
        .write("litOver", out.lit)
        .write("coverage", covered)
        .params(BackgroundParams{view})
        .dispatch(size);
    if (!background.shown.needsCoverage()) {
        return out;
    }
    const auto scope = f.scope("coverage");
    out.coverage = covered;
    out.translucent.clear();
    for (const gpu::Image& translucent : light.translucent) {
        const gpu::Image behind = out.coverage;
        out.coverage = f.image("coverage.blended", radianceFormat, size);
        coverOver(f, translucent, behind, out.coverage);
    }
    return out;
}

gpu::Image displayOver(gpu::PassList& f, const FrameBackground& background, const LightingSettings& settings,
                       const lighting::Light& light, gpu::Image exposure) {
    if (!light.coverage) {
        return lighting::display(f, settings, light.lit, exposure);
    }
    const gpu::Image radiance = straightRadiance(f, light.lit, light.coverage);
    return overBackground(f, lighting::display(f, settings, radiance, exposure), light.coverage, background.shown);
}

FloatImage straightRadiance(const FloatImage& premultiplied, const FloatImage& coverage, const Background& background) {
    if (!background.needsCoverage()) {
        return premultiplied;
    }
    REFLET_CHECK(premultiplied.channels.size() == 3 && premultiplied.data.size() == 3 * coverage.data.size(),
                 "{} values, coverage of {}", premultiplied.data.size(), coverage.data.size());
    FloatImage radiance = premultiplied;
    for (size_t i = 0; i < radiance.data.size(); ++i) {
        const float covered = coverage.data[i / 3];
        radiance.data[i] = covered > 0.0F ? radiance.data[i] / covered : 0.0F;
    }
    return radiance;
}

Bitmap overBackground(const Bitmap& display, const FloatImage& coverage, const Background& background) {
    if (!background.needsCoverage()) {
        return display;
    }
    REFLET_CHECK(display.channels == 3 && display.data.size() == 3 * coverage.data.size(), "{} bytes, coverage of {}",
                 display.data.size(), coverage.data.size());
    const bool transparent = background.mode == Background::Mode::transparent;
    Bitmap over{display.width, display.height, transparent ? 4U : 3U, {}};
    over.data.reserve(coverage.data.size() * over.channels);
    for (size_t i = 0; i < coverage.data.size(); ++i) {
        const float covered = std::clamp(coverage.data[i], 0.0F, 1.0F);
        for (int channel = 0; channel < 3; ++channel) {
            const uint8_t value = display.data[3 * i + static_cast<size_t>(channel)];
            const float mixed = glm::mix(background.color[channel] * 255.0F, static_cast<float>(value), covered);
            over.data.push_back(transparent ? value : static_cast<uint8_t>(std::lround(mixed)));
        }
        if (transparent) {
            over.data.push_back(static_cast<uint8_t>(std::lround(covered * 255.0F)));
        }
    }
    return over;
}

Bitmap displayedOver(const FloatImage& premultiplied, const FloatImage& coverage, const Background& background,
                     const TonemapSettings& settings) {
    const FloatImage straight = straightRadiance(premultiplied, coverage, background);
    return overBackground(toneMapped(straight, settings), coverage, background);
}

}  // namespace reflet
