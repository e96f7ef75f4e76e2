// Importance sampling of the environment image by its texels.
#include "base/color.h"
#include "reference/lights.h"
#include "scene/environment.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

// Cosine of the angle to +Y at the upper edge of a row.
double edgeCosine(size_t row, size_t height) {
    return std::cos(glm::pi<double>() * static_cast<double>(row) / static_cast<double>(height));
}

double texelSolidAngle(const FloatImage& image, size_t row) {
    return 2.0 * glm::pi<double>() / image.width * (edgeCosine(row, image.height) - edgeCosine(row + 1, image.height));
}

}  // namespace

void Lights::prepareEnvironment() {
    if (!environment_.image) {
        return;  // constant: BSDF sampling suffices
    }
    const FloatImage& image = *environment_.image;
    std::vector<double> weights(size_t(image.width) * image.height);
    for (size_t row = 0; row < image.height; ++row) {
        const double solidAngle = texelSolidAngle(image, row);
        for (size_t i = row * image.width; i < (row + 1) * image.width; ++i) {
            weights[i] = solidAngle * luminance({image.data[3 * i], image.data[3 * i + 1], image.data[3 * i + 2]});
        }
    }
    texels_ = Distribution(weights);
    environmentChance_ = texels_.empty() || environment_.intensity == 0.0F ? 0.0F : tree_.empty() ? 1.0F : 0.5F;
}

LightSample Lights::drawEnvironment(float choice, const vec2& u) const {
    const FloatImage& image = *environment_.image;
    const size_t texel = texels_.draw(choice);
    const size_t row = texel / image.width;
    const double cosine = glm::mix(edgeCosine(row, image.height), edgeCosine(row + 1, image.height), double(u.y));
    const vec2 uv((static_cast<float>(texel % image.width) + u.x) / static_cast<float>(image.width),
                  std::acos(std::clamp(cosine, -1.0, 1.0)) / glm::pi<double>());
    LightSample s;
    s.toLight = environmentDirection(uv, environment_.rotation);
    s.pdf = environmentPdf(s.toLight);
    s.light = s.pdf > 0.0F ? environment(s.toLight) / s.pdf : vec3(0.0F);
    return s;
}

vec3 Lights::environment(const vec3& direction) const {
    return radianceFrom(environment_, direction);
}

float Lights::environmentPdf(const vec3& direction) const {
    if (environmentChance_ == 0.0F) {
        return 0.0F;
    }
    const FloatImage& image = *environment_.image;
    const vec2 uv = environmentUv(direction, environment_.rotation);
    const auto column = std::min(static_cast<size_t>(uv.x * static_cast<float>(image.width)), size_t(image.width) - 1);
    const auto row = std::min(static_cast<size_t>(uv.y * static_cast<float>(image.height)), size_t(image.height) - 1);
    return environmentChance_ * texels_.chance(row * image.width + column) /
           static_cast<float>(texelSolidAngle(image, row));
}

}  // namespace reflet
