// Scattering at boundaries of glass.
#include "reference/glass.h"

#include "reference/microfacet.h"

namespace reflet {

namespace {

vec3 flipped(const vec3& l) {
    return {l.x, l.y, -l.z};
}

}  // namespace

float boundaryReflectance(float cosine, float eta, float f0, float f90) {
    float outside = cosine;
    if (eta < 1.0F) {  // Schlick's angle is the one on the side of the smaller index
        const float rest = 1.0F - (1.0F - square(cosine)) / square(eta);
        if (rest <= 0.0F) {
            return 1.0F;
        }
        outside = std::sqrt(rest);
    }
    return f0 + (f90 - f0) * schlick(outside);
}

std::optional<vec3> refracted(const vec3& v, const vec3& h, float eta) {
    const float cosine = glm::dot(v, h);
    const float rest = 1.0F - (1.0F - square(cosine)) / square(eta);
    if (rest <= 0.0F) {
        return std::nullopt;
    }
    return glm::normalize((cosine / eta - std::sqrt(rest)) * h - v / eta);
}

GlassLobe::GlassLobe(const Boundary& boundary, const vec3& view, float alpha, float f0, float f90)
    : kind_(boundary.kind), view_(view), alpha_(alpha), eta_(boundary.far / boundary.near), f0_(f0), f90_(f90) {
    const bool refracts = kind_ == Boundary::Kind::outer || kind_ == Boundary::Kind::inner;
    straight_ = kind_ == Boundary::Kind::none || (refracts && std::abs(eta_ - 1.0F) < 1e-3F);
    smooth_ = alpha < mirrorAlpha;
}

float GlassLobe::reflectance(const vec3& h) const {
    return kind_ == Boundary::Kind::inner ? boundaryReflectance(glm::dot(view_, h), eta_, f0_, f90_) : 0.0F;
}

float GlassLobe::reflectedPdf(const vec3& l) const {
    const vec3 h = glm::normalize(view_ + l);
    const float cosine = glm::dot(view_, h);
    return h.z > 0.0F ? visibleNormalPdf(view_, h, alpha_) / (4.0F * std::max(cosine, 1e-6F)) : 0.0F;
}

float GlassLobe::transmittedPdf(const vec3& l) const {
    if (kind_ == Boundary::Kind::thin) {
        return reflectedPdf(flipped(l));
    }
    vec3 h = view_ + eta_ * l;
    const float length = glm::length(h);
    if (!(length > 1e-6F)) {
        return 0.0F;
    }
    h = h / (h.z < 0.0F ? -length : length);
    const float near = glm::dot(view_, h);
    const float far = glm::dot(l, h);
    if (near <= 0.0F || far >= 0.0F) {
        return 0.0F;
    }
    const float jacobian = square(eta_) * -far / std::max(square(near + eta_ * far), 1e-12F);
    return (1.0F - reflectance(h)) * visibleNormalPdf(view_, h, alpha_) * jacobian;
}

// Both directions that end up as this one: itself, and the one that the surface mirrors to it.
float GlassLobe::pdf(const vec3& direction) const {
    if (delta() || direction.z == 0.0F) {
        return 0.0F;
    }
    if (direction.z < 0.0F) {
        return transmittedPdf(direction) + transmittedPdf(flipped(direction));
    }
    if (kind_ != Boundary::Kind::inner) {
        return 0.0F;
    }
    const auto weighted = [&](const vec3& l) { return reflectance(glm::normalize(view_ + l)) * reflectedPdf(l); };
    return weighted(direction) + weighted(flipped(direction));
}

GlassLobe::Sample GlassLobe::sample(float choice, const vec2& u) const {
    const vec3 normal(0, 0, 1);
    const vec3 h = smooth_ || straight_ ? normal : sampleVisibleNormal(view_, alpha_, u);
    const vec3 mirrored = 2.0F * glm::dot(view_, h) * h - view_;
    const bool reflects = choice < reflectance(h);
    vec3 l = mirrored;
    if (!reflects) {
        if (straight_) {
            l = -view_;
        } else if (kind_ == Boundary::Kind::thin) {
            l = flipped(mirrored);
        } else {
            l = refracted(view_, h, eta_).value_or(mirrored);
        }
    }
    if ((l.z > 0.0F) != reflects) {
        l.z = -l.z;
    }
    return {l, pdf(l)};
}

void Media::enter(const Medium& medium) {
    if (count_ < stack_.size()) {
        stack_[count_++] = medium;
    }
}

void Media::leave(uint32_t instance) {
    for (size_t i = count_; i > 0; --i) {
        if (stack_[i - 1].instance == instance) {
            std::copy(stack_.begin() + static_cast<ptrdiff_t>(i), stack_.begin() + static_cast<ptrdiff_t>(count_),
                      stack_.begin() + static_cast<ptrdiff_t>(i - 1));
            --count_;
            return;
        }
    }
}

void Media::disperse(uint32_t channel) {
    for (size_t i = 0; i < count_; ++i) {
        stack_[i].ior = stack_[i].iorOf(channel);
    }
}

vec3 Media::transmittance(float distance) const {
    return count_ > 0 ? glm::exp(-stack_[count_ - 1].extinction * distance) : vec3(1.0F);
}

Boundary Media::boundary(const Medium& volume, bool front) const {
    if (front) {
        return {inside() ? Boundary::Kind::inner : Boundary::Kind::outer, ior(), volume.ior};
    }
    Media left = *this;
    left.leave(volume.instance);
    const bool known = left.count_ < count_;
    if (known && stack_[count_ - 1].instance != volume.instance) {
        return {Boundary::Kind::none, ior(), ior()};
    }
    // A ray that came through a hole of the mesh has not entered it.
    return {Boundary::Kind::inner, known ? ior() : volume.ior, left.ior()};
}

}  // namespace reflet
