// Sampling of lights.
#include "reference/lights.h"

#include "base/color.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

// Irradiance of a lamp on a surface at p that faces it, by KHR_lights_punctual.
LightSample lampAt(const Lamp& lamp, const vec3& p) {
    LightSample s;
    if (lamp.type == Lamp::Type::directional) {
        s.toLight = -lamp.direction;
        s.light = lamp.intensity;
        return s;
    }
    const vec3 toLamp = lamp.position - p;
    s.distance = std::max(glm::length(toLamp), 1e-4F);
    s.toLight = toLamp / s.distance;
    s.light = lamp.intensity / (s.distance * s.distance);
    if (lamp.range > 0.0F) {
        const float square = s.distance * s.distance / (lamp.range * lamp.range);
        s.light *= std::clamp(1.0F - square * square, 0.0F, 1.0F);
    }
    if (lamp.type == Lamp::Type::spot) {
        const float inner = std::cos(lamp.innerAngle);
        const float outer = std::cos(lamp.outerAngle);
        const float cosine = -glm::dot(s.toLight, lamp.direction);
        const float cone = std::clamp((cosine - outer) / std::max(inner - outer, 1e-4F), 0.0F, 1.0F);
        s.light *= cone * cone;
    }
    return s;
}

vec2 uniformBarycentric(const vec2& u) {
    const float root = std::sqrt(u.x);
    return {root * (1.0F - u.y), root * u.y};
}

}  // namespace

Distribution::Distribution(const std::vector<double>& weights) : sums_(weights.size()) {
    for (size_t i = 0; i < weights.size(); ++i) {
        total_ += weights[i];
        sums_[i] = total_;
    }
}

size_t Distribution::draw(float& u) const {
    const double at = u * total_;
    auto found = std::upper_bound(sums_.begin(), sums_.end(), at);
    if (found == sums_.end()) {  // u · total was rounded up to the total
        found = std::lower_bound(sums_.begin(), sums_.end(), total_);
    }
    const double before = found == sums_.begin() ? 0.0 : *(found - 1);
    u = std::min(static_cast<float>((at - before) / (*found - before)), 0x1.fffffep-1F);
    return static_cast<size_t>(found - sums_.begin());
}

Lights::Lights(const RayScene& rays, const View& view)
    : rays_(rays),
      sunFrame_(frameAround(-glm::normalize(view.sun.direction))),
      sunIrradiance_(view.sun.irradiance),
      sunSine_(std::sin(0.5F * view.sun.angularDiameter)),
      lamps_(rays.scene().lamps),
      environment_(view.environment) {
    for (Lamp& lamp : lamps_) {
        if (lamp.type != Lamp::Type::directional) {
            lamp.radius = view.lampRadius.value_or(lamp.radius);
        }
    }
    for (const uint32_t off : view.lampsOff) {
        if (off < lamps_.size()) {
            lamps_[off].intensity = vec3(0.0F);
        }
    }
    collectTriangles();
    prepareEnvironment();
}

void Lights::collectTriangles() {
    const Scene& scene = rays_.scene();
    std::vector<TriangleLight> lights;
    emissiveIndex_.resize(scene.instances.size());
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Material& material = rays_.material(i);
        const float strength = luminance(material.unlit ? vec3(material.baseColor) : material.emissive);
        if (!(strength > 0.0F)) {
            continue;
        }
        const auto count = static_cast<uint32_t>(scene.meshes[scene.instances[i].mesh].indices.size() / 3);
        for (uint32_t k = 0; k < count; ++k) {
            const Triangle t = rays_.triangle(i, k);
            const vec3 across = glm::cross(t.b - t.a, t.c - t.a);
            const float area = 0.5F * glm::length(across);
            emissiveIndex_[i].push_back(static_cast<uint32_t>(emissive_.size()));
            emissive_.push_back({i, k, area});
            const vec3 outward = rays_.mirrored(i) ? -across : across;
            lights.push_back({t.a, t.b, t.c, area > 0.0F ? outward / (2.0F * area) : vec3(0.0F), material.doubleSided,
                              area * strength});
        }
    }
    tree_ = LightTree(lights);
}

LightSample Lights::drawSun(const vec2& u) const {
    // Uniform in the disk's projection on the plane that faces it, so that all samples have the same irradiance.
    const float radius = sunSine_ * std::sqrt(u.x);
    const float z = std::sqrt(1.0F - radius * radius);
    LightSample s;
    s.toLight = sunFrame_ * vec3(radius * std::cos(2.0F * pi * u.y), radius * std::sin(2.0F * pi * u.y), z);
    s.light = sunIrradiance_ / z;
    return s;
}

LightSample Lights::drawLamp(const SurfacePoint& point, float choice, const vec2& u) const {
    const auto strength = [&](const LightSample& s) {
        return glm::dot(s.toLight, point.geometricNormal) > 0.0F || point.diffuseTransmissionShare > 0.0F
                   ? luminance(s.light)
                   : 0.0F;
    };
    float total = 0.0F;
    for (const Lamp& lamp : lamps_) {
        total += strength(lampAt(lamp, point.position));
    }
    float left = choice * total;
    LightSample chosen;
    float radius = 0.0F;
    for (const Lamp& lamp : lamps_) {
        const LightSample s = lampAt(lamp, point.position);
        const float mine = strength(s);
        if (mine > 0.0F) {
            chosen = s;
            chosen.light *= total / mine;
            radius = lamp.radius;
            if (left < mine) {
                break;
            }
        }
        left -= mine;
    }
    const float r = radius * std::sqrt(u.x);
    chosen.aside = frameAround(chosen.toLight) * vec3(r * std::cos(2.0F * pi * u.y), r * std::sin(2.0F * pi * u.y), 0);
    chosen.clearance = lampClearance(radius);
    return chosen;
}

LightSample Lights::drawEmitter(const SurfacePoint& point, float choice, const vec2& u) const {
    if (choice < environmentChance_) {
        return drawEnvironment(choice / environmentChance_, u);
    }
    return drawTriangle(point, (choice - environmentChance_) / (1.0F - environmentChance_), u);
}

LightSample Lights::drawTriangle(const SurfacePoint& point, float choice, const vec2& u) const {
    LightSample s;
    const auto chosen = tree_.draw(receiver(point), choice);
    if (!chosen) {
        return s;
    }
    const EmissiveTriangle& emissive = emissive_[chosen->light];
    const Triangle t = rays_.triangle(emissive.instance, emissive.triangle);
    const vec2 at = uniformBarycentric(u);
    const vec3 place = t.a * (1.0F - at.x - at.y) + t.b * at.x + t.c * at.y;
    const vec3 toLight = place - point.position;
    const float distance = glm::length(toLight);
    if (!(distance > point.clearance)) {
        return s;
    }
    s.hit = {distance, emissive.instance, emissive.triangle, at};
    const SurfacePoint emitter = surfaceAt(rays_, s.hit, toLight);
    s.onSurface = true;
    s.distance = distance;
    s.toLight = toLight / distance;
    s.pdf = trianglePdf(point.position, emitter, chosen->probability);
    s.light = s.pdf > 0.0F ? emitter.emission * (coverageAt(rays_, s.hit) / s.pdf) : vec3(0.0F);
    return s;
}

float Lights::trianglePdf(const vec3& from, const SurfacePoint& emitter, float chance) const {
    const float area = emissive_[emissiveIndex_[emitter.hit.instance][emitter.hit.triangle]].area;
    const vec3 offset = emitter.position - from;
    const float cosine = glm::dot(emitter.geometricNormal, emitter.toOrigin);
    if (!(cosine > 1e-6F) || !(area > 0.0F)) {
        return 0.0F;
    }
    return (1.0F - environmentChance_) * chance / area * glm::dot(offset, offset) / cosine;
}

float Lights::emitterPdf(const LightReceiver& from, const SurfacePoint& emitter) const {
    const std::vector<uint32_t>& index = emissiveIndex_[emitter.hit.instance];
    if (index.empty()) {
        return 0.0F;
    }
    return trianglePdf(from.position, emitter, tree_.probability(from, index[emitter.hit.triangle]));
}

LightReceiver Lights::receiver(const SurfacePoint& point) {
    const bool throughIt = point.transmission > 0.0F || point.diffuseTransmissionShare > 0.0F;
    return {point.position, throughIt ? vec3(0.0F) : point.geometricNormal};
}

}  // namespace reflet
