// Evaluation and sampling of a GGX layer.
#include "reference/specular_lobe.h"

namespace reflet {

vec3 viewIn(const mat3& frame, const vec3& toViewer) {
    constexpr float leastCosine = 1e-4F;
    const vec3 v = toViewer * frame;  // the frame's transpose
    return glm::normalize(vec3(v.x, v.y, std::max(v.z, leastCosine)));
}

SpecularLobe::SpecularLobe(const mat3& frame, const vec3& view, const vec2& alpha, const Reflectance& reflectance,
                           const vec3& albedo, const LobeAlbedo& table)
    : frame_(frame),
      view_(view),
      alpha_(alpha),
      reflectance_(reflectance),
      compensation_(albedo / glm::max(reflectance.f0 * table.scale + reflectance.f90 * table.bias, 1e-4F)) {}

vec3 SpecularLobe::reflect(const vec3& toLight, float leastAlpha) const {
    const vec2 alpha = glm::max(alpha_, leastAlpha);
    const vec3 l = toLight * frame_;
    if (l.z <= 0.0F || std::max(alpha.x, alpha.y) < mirrorAlpha) {
        return vec3(0.0F);
    }
    const vec3 h = glm::normalize(view_ + l);
    const float masking = 1.0F / (1.0F + smithLambda(view_, alpha) + smithLambda(l, alpha));
    return fresnel(glm::dot(view_, h)) * compensation_ * (ggxDensity(h, alpha) * masking / (4.0F * view_.z));
}

float SpecularLobe::pdf(const vec3& direction) const {
    const vec3 l = direction * frame_;
    if (l.z <= 0.0F || mirror()) {
        return 0.0F;
    }
    const vec3 h = glm::normalize(view_ + l);
    return ggxDensity(h, alpha_) / ((1.0F + smithLambda(view_, alpha_)) * 4.0F * view_.z);
}

vec3 SpecularLobe::sample(const vec2& u) const {
    const vec3 h = mirror() ? vec3(0, 0, 1) : sampleVisibleNormal(view_, alpha_, u);
    return frame_ * (2.0F * glm::dot(view_, h) * h - view_);
}

vec3 SpecularLobe::mirrorShare() const {
    return fresnel(view_.z) * compensation_;
}

}  // namespace reflet
