// Compiles the shader's tone mapping as C++ and runs it on an image.
#include "effects/tonemap/tone_map_image.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

// GLSL built-ins. All headers that the file includes must be included above.
namespace glsl {
using namespace glm;
#include "effects/tonemap/display_color.glsl"
}  // namespace glsl

vec3 pixelRadiance(const float* values, float most) {
    vec3 c(0.0F);
    for (int channel = 0; channel < 3; ++channel) {
        c[channel] = std::isnan(values[channel]) ? 0.0F : std::clamp(values[channel], -most, most);
    }
    return c;
}

}  // namespace

Bitmap toneMapped(const FloatImage& radiance, const TonemapSettings& settings) {
    REFLET_CHECK(radiance.channels.size() == 3, "{} channels", radiance.channels.size());
    Bitmap bitmap{radiance.width, radiance.height, 3, {}};
    bitmap.data.reserve(radiance.data.size());
    const float most = largestHalf * std::exp2(std::max(-settings.exposure, 0.0F));
    for (size_t i = 0; i < radiance.data.size(); i += 3) {
        const vec3 shown = glsl::displayColor(pixelRadiance(&radiance.data[i], most),
                                              static_cast<uint32_t>(settings.curve), settings.exposure);
        for (int channel = 0; channel < 3; ++channel) {
            bitmap.data.push_back(static_cast<uint8_t>(std::lround(shown[channel] * 255.0F)));
        }
    }
    return bitmap;
}

}  // namespace reflet
