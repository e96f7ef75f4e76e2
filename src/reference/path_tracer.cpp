// Traces one path.
#include "reference/path_tracer.h"

#include "base/color.h"
#include "reference/bsdf.h"
#include "reference/through_glass.h"
#include "scene/background.h"
#include "scene/environment.h"
#include "scene/volumes_around.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr uint32_t rouletteStart = 4;  // bounces before Russian roulette

// Dimensions of the sampler: one pair for the position in the pixel, then these for each vertex of the path.
enum Purpose : uint32_t { forSun, forLampAndLobe, forEmitter, forEmitterChoice, forScattering, forLampDisk, purposes };

constexpr uint32_t pairForAmbient = 0xA0000000;  // beyond those of any path
constexpr uint32_t pairForLens = 0xA0000001;
constexpr uint32_t pairForChannel = 0xA0000002;

uint32_t pairFor(uint32_t vertex, Purpose purpose) {
    return 1 + vertex * purposes + purpose;
}

}  // namespace

// A shadow ray to a point on a lamp's disk, which ends where the lamp's clearance begins. Its direction is not
// normalized, but reaches to that point.
Ray rayToLamp(const vec3& origin, const vec3& center, const LightSample& lamp) {
    Ray ray{origin, center + lamp.aside - origin};
    const float length = glm::length(ray.direction);
    const float square = glm::dot(lamp.aside, lamp.aside);
    const float inward = square / length;  // from the ray's closest point to the centre to its end
    const float rest = inward * inward + lamp.clearance * lamp.clearance - square;
    ray.far = 1.0F - (inward + std::sqrt(std::max(rest, 0.0F))) / length;
    return ray;
}

// State of a path: its vertex, and the throughput from there to the camera, separately for each lobe of the first
// surface.
struct PathTracer::Walk {
    SurfacePoint point;
    uint32_t vertex = 0;              ///< number of surfaces before this one
    uint32_t bounces = 0;             ///< of these, those that are no boundary of glass which the path went through
    bool triedMirrors = false;        ///< from the surface before this one: see SunMirrors
    Media media;                      ///< on the side of the vertex that the ray comes from
    std::optional<uint32_t> channel;  ///< the only one that is left after glass that disperses light
    vec3 refractable{1.0F};           ///< factor on what the vertex refracts: 3 in the channel chosen there, or 1
    Reflection throughput;
    const PixelSampler& random;
    PathSample out;

    void addIndirect(const vec3& radiance) {
        out.indirectDiffuse += throughput.diffuse * radiance;
        out.indirectSpecular += throughput.specular * radiance;
    }
    void attenuate(const vec3& share) {
        throughput.diffuse *= share;
        throughput.specular *= share;
    }
    // The channel that glass which disperses light refracts.
    [[nodiscard]] uint32_t chosenChannel() const {
        return std::min(static_cast<uint32_t>(3.0F * random.pair(pairForChannel).x), 2U);
    }
    // Glass that disperses light refracts one channel of three, with thrice the weight.
    void disperse() {
        refractable = vec3(1.0F);
        if (!(point.transmission > 0.0F) || !point.bounded || !(point.medium.dispersion > 0.0F)) {
            return;
        }
        const uint32_t one = channel.value_or(chosenChannel());
        if (!channel) {
            refractable = vec3(one == 0 ? 3 : 0, one == 1 ? 3 : 0, one == 2 ? 3 : 0);
        }
        point.medium.ior = point.medium.iorOf(one);
    }
    // After scattering toward s.
    void keepChannel(const Scattered& s) {
        if (s.throughGlass && refractable != vec3(1.0F)) {
            attenuate(refractable);
            channel = refractable.x > 0.0F ? 0 : refractable.y > 0.0F ? 1 : 2;
        }
    }
    [[nodiscard]] vec2 pair(Purpose purpose) const { return random.pair(pairFor(vertex, purpose)); }
    // Counts the ray.
    [[nodiscard]] Ray counted(Ray ray) {
        ray.random = random.bits(out.rays++);
        return ray;
    }
};

PathTracer::PathTracer(const RayScene& rays, const View& view, uvec2 size, const ReferenceOptions& options)
    : rays_(rays),
      camera_(view.camera, size),
      lights_(rays, view),
      mirrors_(rays, -glm::normalize(view.sun.direction)),
      options_(options),
      glass_(!options.lambertOnly && std::ranges::any_of(rays.scene().materials, [](const Material& m) {
          return m.transmission.factor > 0.0F;
      })) {
    const auto blurred =
        needsBlurredImage(view) ? std::make_shared<FloatImage>(blurredImage(*view.environment.image)) : nullptr;
    behind_ = environmentBehind(view, blurred);
    if (glass_) {
        for (const uint32_t instance : VolumeFinder{}.around(rays.scene(), nullptr, view.camera)) {
            media_.enter(mediumOf(rays, instance));
        }
    }
}

std::optional<SurfacePoint> PathTracer::firstSurface(const vec2& place) const {
    return firstSurface(camera_.through(place));
}

std::optional<SurfacePoint> PathTracer::firstSurface(const Ray& ray) const {
    const auto hit = rays_.intersect(ray, media_.inside() ? RayKind::inside : RayKind::camera);
    return hit ? std::optional(surfaceAt(rays_, *hit, ray.direction)) : std::nullopt;
}

PathSample PathTracer::trace(const vec2& place, const PixelSampler& random) const {
    Walk walk{.point = {}, .media = media_, .channel = {}, .throughput = {}, .random = random, .out = {}};
    const bool lens = camera_.hasLens() && !options_.pinhole;
    const Ray ray = walk.counted(lens ? camera_.throughLens(place, random.pair(pairForLens)) : camera_.through(place));
    const auto first = firstSurface(ray);
    if (!first) {
        walk.out.direct = radianceFrom(behind_, ray.direction);
        walk.out.background = true;
        return walk.out;
    }
    if (media_.inside()) {
        walk.media.disperse(walk.chosenChannel());
    }
    walk.point = *first;
    walk.out.albedo = first->baseColor;
    walk.out.direct = first->emission;
    if (options_.ambientOcclusion) {
        walk.out.ambientVisibility = ambientVisibility(walk);
    }
    for (;; ++walk.vertex) {
        walk.disperse();
        const Boundary boundary = walk.point.transmission > 0.0F ? boundaryAt(walk.point, walk.media) : Boundary{};
        const Bsdf bsdf(walk.point, options_, boundary);
        addLamps(walk, bsdf);
        const bool spent = walk.bounces >= options_.bounces;
        if (spent && !(walk.point.transmission > 0.0F)) {
            break;
        }
        walk.triedMirrors = !spent && lights_.hasSun() && mirrors_.startsFrom(walk.point);
        if (walk.triedMirrors) {
            addSunInMirrors(walk, bsdf);
        }
        if (!spent) {
            addEmitters(walk, bsdf);
        }
        if (!step(walk, bsdf, spent)) {
            break;
        }
    }
    // All that is found comes through what is in front of the first surface.
    walk.out.attenuate(media_.transmittance(first->hit.distance * glm::length(ray.direction)));
    return walk.out;
}

vec3 PathTracer::lit(Walk& walk, const SurfacePoint& point, const LightSample& light) const {
    const vec3 origin = point.rayOrigin(light.toLight);
    Ray ray = walk.counted({origin, light.toLight});
    if (light.onSurface) {  // ends just off the emissive surface
        const vec3 place = point.position + light.toLight * light.distance;
        ray.direction = place - origin;
        ray.far = 1.0F - 1e-4F;
    } else if (std::isfinite(light.distance)) {
        const uint32_t random = ray.random;
        ray = rayToLamp(origin, point.position + light.toLight * light.distance, light);
        ray.random = random;
    } else if (light.aside != vec3(0.0F)) {  // a directional lamp: a tangent
        ray.direction = glm::normalize(light.toLight + light.aside);
    }
    if (ray.far <= 0.0F) {
        return vec3(1.0F);
    }
    // Scattered rays find the light of emissive surfaces and of the environment behind glass.
    if (glass_ && light.pdf == 0.0F) {
        return straightTransmittance(rays_, ray, RayKind::light, walk.media);
    }
    return rays_.occluded(ray, RayKind::light) ? vec3(0.0F) : vec3(1.0F);
}

// Next-event estimation of sun and lamps, which scattered rays cannot hit.
void PathTracer::addLamps(Walk& walk, const Bsdf& bsdf) const {
    const bool first = walk.vertex == 0;
    vec3 sum(0.0F);
    if (lights_.hasSun()) {
        const LightSample sun = lights_.drawSun(walk.pair(forSun));
        const Reflection toOrigin = bsdf.reflectLamp(sun.toLight);
        const bool known = walk.triedMirrors && mirrors_.isOnAny(walk.point);
        const vec3 reflected = (known ? toOrigin.diffuse : toOrigin.sum()) * sun.light;
        const bool faces = glm::dot(sun.toLight, walk.point.geometricNormal) > 0.0F;
        const bool needed = (faces && first) || reflected != vec3(0.0F);
        const vec3 visible = needed ? lit(walk, walk.point, sun) : vec3(0.0F);
        sum += reflected * visible;
        if (first) {
            walk.out.sunVisibility = luminance(visible);
        }
    }
    if (lights_.hasLamps()) {
        const LightSample lamp = lights_.drawLamp(walk.point, walk.pair(forLampAndLobe).x, walk.pair(forLampDisk));
        const vec3 reflected = bsdf.reflectLamp(lamp.toLight).sum() * lamp.light;
        if (reflected != vec3(0.0F)) {
            sum += options_.lampShadows ? reflected * lit(walk, walk.point, lamp) : reflected;
        }
    }
    if (first) {
        walk.out.direct += sum;
    } else {
        walk.addIndirect(sum);
    }
}

// The sun over each flat mirror, in place of what paths that hit the mirror by chance would find.
void PathTracer::addSunInMirrors(Walk& walk, const Bsdf& bsdf) const {
    const LightSample sun = lights_.drawSun(walk.pair(forSun));
    for (const vec4& plane : mirrors_.planes()) {
        const vec3 n(plane);
        const vec3 toMirror = glm::reflect(sun.toLight, n);
        const Reflection r = bsdf.reflectLamp(toMirror);
        if (glm::dot(plane, vec4(walk.point.position, 1.0F)) <= walk.point.clearance || glm::dot(toMirror, n) >= 0.0F ||
            r.sum() == vec3(0.0F)) {
            continue;
        }
        const auto hit = rays_.intersect(walk.counted({walk.point.rayOrigin(toMirror), toMirror}), RayKind::light);
        if (!hit) {
            continue;
        }
        const SurfacePoint mirror = surfaceAt(rays_, *hit, toMirror);
        if (!SunMirrors::isOn(plane, mirror) || (options_.visibleOnly && !cameraSees(walk, mirror))) {
            continue;
        }
        const vec3 light = sun.light * lit(walk, mirror, sun) * Bsdf(mirror, options_).specularAlbedo() *
                           walk.media.transmittance(hit->distance);
        if (walk.vertex == 0) {
            walk.out.indirectDiffuse += r.diffuse * light;
            walk.out.indirectSpecular += r.specular * light;
        } else {
            walk.addIndirect(r.sum() * light);
        }
    }
}

// Next-event estimation of emissive surfaces and the environment, with MIS weights against BSDF sampling.
void PathTracer::addEmitters(Walk& walk, const Bsdf& bsdf) const {
    if (!lights_.hasSampledEmitters()) {
        return;
    }
    const LightSample s = lights_.drawEmitter(walk.point, walk.pair(forEmitterChoice).x, walk.pair(forEmitter));
    if (!(s.pdf > 0.0F) || s.light == vec3(0.0F)) {
        return;
    }
    Reflection r = bsdf.reflect(s.toLight);
    if (r.sum() == vec3(0.0F) || lit(walk, walk.point, s) == vec3(0.0F)) {
        return;
    }
    if (options_.visibleOnly && s.onSurface && !cameraSees(walk, surfaceAt(rays_, s.hit, s.toLight))) {
        return;
    }
    const vec3 light = s.light * walk.refractable * (s.pdf / (s.pdf + bsdf.pdf(s.toLight)));
    if (walk.vertex == 0) {
        walk.out.indirectDiffuse += r.diffuse * light;
        walk.out.indirectSpecular += r.specular * light;
    } else {
        walk.addIndirect(r.sum() * light);
    }
}

bool PathTracer::step(Walk& walk, const Bsdf& bsdf, bool spent) const {
    Scattered s = bsdf.scatter(walk.pair(forLampAndLobe).y, walk.pair(forScattering));
    if (spent) {
        if (!s.throughGlass) {
            return false;
        }
        s.pdf = 0.0F;  // no light was sampled that would share the weight
    }
    walk.bounces += s.throughGlass ? 0 : 1;
    if (walk.vertex == 0) {
        walk.throughput = s.weight;
    } else {
        walk.attenuate(s.weight.sum());
    }
    walk.keepChannel(s);
    if (walk.vertex >= rouletteStart) {
        const vec3 share = walk.throughput.sum();
        const float survival = std::min(std::max({share.x, share.y, share.z}), 0.95F);
        if (walk.pair(forEmitterChoice).y >= survival) {
            return false;
        }
        walk.attenuate(vec3(1.0F / survival));
    }
    if (walk.throughput.sum() == vec3(0.0F)) {
        return false;
    }
    if (s.crosses) {
        cross(walk.media, walk.point);
    }
    const LightReceiver from = Lights::receiver(walk.point);
    const auto hit = rays_.intersect(walk.counted({walk.point.rayOrigin(s.direction), s.direction}), RayKind::light);
    const auto weight = [&](float otherPdf) { return s.pdf > 0.0F ? s.pdf / (s.pdf + otherPdf) : 1.0F; };
    if (!hit) {
        walk.addIndirect(lights_.environment(s.direction) * weight(lights_.environmentPdf(s.direction)));
        return false;
    }
    walk.attenuate(walk.media.transmittance(hit->distance));
    walk.point = surfaceAt(rays_, *hit, s.direction);
    const bool onGlass = glass_ && walk.point.transmission > 0.0F;  // its back faces lead on to what is seen
    if (options_.visibleOnly && !onGlass && !cameraSees(walk, walk.point)) {
        return false;
    }
    if (walk.point.emission != vec3(0.0F)) {
        walk.addIndirect(walk.point.emission * weight(lights_.emitterPdf(from, walk.point)));
    }
    return true;
}

// How open a random direction is, cosine-distributed around the shading normal, as the renderer's rays.
float PathTracer::ambientVisibility(Walk& walk) const {
    const SurfacePoint& point = walk.point;
    const vec2 u = walk.random.pair(pairForAmbient);
    const float radius = std::sqrt(u.x);
    const float turn = 2.0F * pi * u.y;
    const vec3 direction =
        frameAround(point.normal) * vec3(radius * std::cos(turn), radius * std::sin(turn), std::sqrt(1.0F - u.x));
    if (glm::dot(direction, point.geometricNormal) <= 0.0F) {
        return 1.0F;  // below the surface, which a smooth or mapped normal does not know: as open as right above it
    }
    Ray ray = walk.counted({point.rayOrigin(direction), direction});
    ray.far = options_.aoRadius;
    const auto hit = rays_.intersect(ray, RayKind::light);
    if (!hit || (options_.visibleOnly && !cameraSees(walk, surfaceAt(rays_, *hit, direction)))) {
        return 1.0F;
    }
    const float fade = options_.aoFalloff * options_.aoRadius;
    return fade > 0.0F ? 1.0F - std::min((options_.aoRadius - hit->distance) / fade, 1.0F) : 0.0F;
}

bool PathTracer::cameraSees(Walk& walk, const SurfacePoint& point) const {
    if (!point.front && !rays_.material(point.hit.instance).doubleSided) {
        return false;  // a back face that the camera does not draw
    }
    auto back = camera_.backFrom(point.position);
    if (!back || glm::dot(back->direction, point.geometricNormal) <= 0.0F) {
        return false;
    }
    back->origin = point.rayOrigin(back->direction);
    const Ray ray = walk.counted(*back);
    return glass_ ? straightTransmittance(rays_, ray, RayKind::camera, {}) != vec3(0.0F)
                  : !rays_.occluded(ray, RayKind::camera);
}

}  // namespace reflet
