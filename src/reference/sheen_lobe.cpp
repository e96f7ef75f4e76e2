// Evaluation and sampling of a sheen.
#include "reference/sheen_lobe.h"

#include "reference/albedo_table.h"
#include "reference/microfacet.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr float leastRoughness = 0.07F;  // narrower lobes are seen at the silhouette alone

float alphaOf(float roughness) {
    return square(std::max(roughness, leastRoughness));
}

// Smith's Lambda for the distribution below, fitted by the authors for alpha 0 and 1, with their smooth ends.
float lambda(float cosine, float alpha) {
    const float t = square(1.0F - alpha);
    const auto between = [&](float rough, float smooth) { return rough + t * (smooth - rough); };
    const auto curve = [&](float x) {
        return between(21.5473F, 25.3245F) /
                   (1.0F + between(3.82987F, 3.32435F) * std::pow(x, between(0.19823F, 0.16801F))) +
               between(-1.97760F, -1.27393F) * x + between(-4.32054F, -4.85967F);
    };
    return std::exp(cosine < 0.5F ? curve(cosine) : 2.0F * curve(0.5F) - curve(1.0F - cosine));
}

// BRDF of a white sheen; l, v: of the frame of the surface.
float brdf(const vec3& v, const vec3& l, float alpha) {
    const vec3 h = glm::normalize(v + l);
    const float sine = std::sqrt(std::max(1.0F - h.z * h.z, 0.0F));
    const float density = (2.0F + 1.0F / alpha) * std::pow(sine, 1.0F / alpha) / (2.0F * pi);
    const float masking = 1.0F / (1.0F + lambda(v.z, alpha) + lambda(l.z, alpha));
    return density * masking / (4.0F * std::max(v.z * l.z, 1e-6F));
}

vec3 onHemisphere(const vec2& u) {
    const float radius = std::sqrt(std::max(1.0F - u.x * u.x, 0.0F));
    return {radius * std::cos(2.0F * pi * u.y), radius * std::sin(2.0F * pi * u.y), u.x};
}

vec2 integrate(float cosine, float roughness) {
    constexpr int steps = 48;  // along each axis
    const float z = std::max(cosine, 1e-3F);
    const vec3 v(std::sqrt(1.0F - z * z), 0.0F, z);
    float sum = 0.0F;
    for (int i = 0; i < steps * steps; ++i) {
        const vec3 l = onHemisphere((vec2(i % steps, i / steps) + 0.5F) / static_cast<float>(steps));
        sum += brdf(v, l, alphaOf(roughness)) * l.z;
    }
    return {std::min(sum / (SheenLobe::pdf * steps * steps), 1.0F), 0.0F};
}

}  // namespace

float sheenAlbedo(float cosine, float roughness) {
    static const AlbedoTable table(integrate);
    return table.at(cosine, roughness).x;
}

SheenLobe::SheenLobe(const mat3& frame, const vec3& view, const vec3& color, float roughness)
    : frame_(frame),
      view_(view),
      color_(color),
      alpha_(alphaOf(roughness)),
      albedo_(std::max({color.x, color.y, color.z}) * sheenAlbedo(view.z, roughness)) {}

vec3 SheenLobe::reflect(const vec3& toLight) const {
    const vec3 l = toLight * frame_;
    return l.z > 0.0F ? color_ * (brdf(view_, l, alpha_) * l.z) : vec3(0.0F);
}

vec3 SheenLobe::sample(const vec2& u) const {
    return frame_ * onHemisphere(u);
}

}  // namespace reflet
